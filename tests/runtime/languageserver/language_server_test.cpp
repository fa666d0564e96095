// SPDX-License-Identifier: MIT
#include "runtime/languageserver/language_server.h"
#include "tests/runtime/languageserver/editor.h"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

namespace {

using lsys::tests::codes;
using lsys::tests::Editor;
using Json = nlohmann::json;

constexpr const char* kTree = "/p/tree.lsys";
const Json kNoFeatures = Json::object();

/// The bodies that a server sends for the given ones.
std::vector<Json> answers(lsys::LanguageServer& server, const std::vector<std::string>& bodies) {
    std::vector<lsys::ReadMessage> messages;
    for (const std::string& body : bodies) {
        messages.push_back({body, {}});
    }
    std::vector<Json> all;
    for (const std::string& answer : server.receive(messages)) {
        all.push_back(Json::parse(answer));
    }
    return all;
}

int code_of(const Json& response) {
    return response.at("error").at("code").get<int>();
}

Json actions_in(Editor& editor, const char* path, const Json& range, const Json& context) {
    return editor.request(
        "textDocument/codeAction",
        {{"textDocument", {{"uri", Editor::uri(path)}}}, {"range", range}, {"context", context}});
}

} // namespace

TEST_CASE("requests in the wrong order are refused") {
    lsys::LanguageServer server{{}};
    const std::string shutdown = R"({"jsonrpc":"2.0","id":1,"method":"shutdown"})";
    const std::string initialize =
        R"({"jsonrpc":"2.0","id":2,"method":"initialize","params":{"capabilities":{}}})";
    CHECK(code_of(answers(server, {shutdown}).at(0)) == -32002);
    CHECK(answers(server, {R"({"jsonrpc":"2.0","method":"textDocument/didOpen","params":{}})"})
              .empty());
    CHECK(answers(server, {initialize}).at(0).contains("result"));
    CHECK(code_of(answers(server, {initialize}).at(0)) == -32600);
    CHECK(answers(server, {shutdown}).at(0).at("result").is_null());
    CHECK(code_of(answers(server, {shutdown}).at(0)) == -32600);
    CHECK(server.exit_status() == 1);
    CHECK(answers(server, {R"({"jsonrpc":"2.0","method":"exit"})", shutdown}).empty());
    CHECK(server.has_exited());
    CHECK(server.exit_status() == 0);
}

TEST_CASE("exit without shutdown has status 1") {
    lsys::LanguageServer server{{}};
    CHECK(answers(server, {R"({"jsonrpc":"2.0","method":"exit"})"}).empty());
    CHECK(server.has_exited());
    CHECK(server.exit_status() == 1);
}

TEST_CASE("messages that are no requests get errors, and the server goes on") {
    Editor editor(kNoFeatures);
    lsys::LanguageServer& server = editor.server();
    CHECK(code_of(answers(server, {"{"}).at(0)) == -32700);
    CHECK(code_of(answers(server, {"\xFF"}).at(0)) == -32700);
    for (const char* body : {"[]", "3", "null", R"({"jsonrpc":"2.0","id":7})", R"({"method":4})"}) {
        CAPTURE(body);
        CHECK(code_of(answers(server, {body}).at(0)) == -32600);
    }
    CHECK(code_of(answers(server, {R"({"id":[1],"method":"shutdown"})"}).at(0)) == -32600);
    CHECK(answers(server, {R"({"jsonrpc":"2.0","id":7,"result":null})"}).empty());
    CHECK(answers(server, {R"({"jsonrpc":"2.0","method":"$/unknown"})"}).empty());
    CHECK(editor.error_code("$/unknown", Json::object()) == -32601);
    CHECK(editor.error_code("textDocument/unknown", Json::object()) == -32601);
    CHECK(editor.error_code("textDocument/definition", nullptr) == -32602);
    CHECK(editor.error_code("textDocument/definition", Editor::at("/p/closed.lsys", 0, 0)) ==
          -32602);
    editor.notify("textDocument/didChange", {{"textDocument", 3}}); // ignored
    CHECK(editor.request("workspace/symbol", {{"query", ""}}).empty());
    // Deep nesting exhausts neither the stack nor the memory.
    const auto nested = [](std::size_t depth) {
        return std::string(depth, '[') + std::string(depth, ']');
    };
    CHECK(code_of(answers(server, {nested(1000)}).at(0)) == -32600);
    CHECK(code_of(answers(server, {nested(200'000)}).at(0)) == -32700);
}

TEST_CASE("a document that is too large gets a message, and the server goes on") {
    Editor editor(kNoFeatures, {},
                  [](lsys::LanguageServerHost& host) { host.max_document_bytes = 1000; });
    const std::string small = "#n = 1;\n#w : F(1);\n";
    editor.open(kTree, small + std::string(1000, ' '));
    const Json& found = editor.diagnostics.at(Editor::uri(kTree));
    REQUIRE(found.size() == 1);
    CHECK(found[0].at("message").get<std::string>().starts_with("a grammar of more than 1000 B"));
    CHECK(editor.request("textDocument/hover", Editor::at(kTree, 1, 5)).is_null());
    editor.change(kTree, small);
    CHECK(editor.diagnostics.at(Editor::uri(kTree)).empty());
}

TEST_CASE("a document that takes too long gets a message, and the server goes on") {
    Editor editor(kNoFeatures, {}, [](lsys::LanguageServerHost& host) { host.max_seconds = 0.01; });
    std::string text = "#n = 1;\n#function f0(x) x + 1;\n"; // f16 expands to 65,536 additions
    for (int i = 1; i <= 16; ++i) {
        const std::string earlier = "f" + std::to_string(i - 1) + "(x)";
        text += "#function f" + std::to_string(i) + "(x) " + earlier + " + " + earlier + ";\n";
    }
    text += "#w : F(1);\n";
    for (int i = 0; i < 30; ++i) {
        text += "#p" + std::to_string(i) + " : A" + std::to_string(i) + "(x) : * : F(f16(x));\n";
    }
    editor.open(kTree, text);
    const Json& found = editor.diagnostics.at(Editor::uri(kTree));
    REQUIRE(found.size() == 1);
    CHECK(found[0].at("message") ==
          "this takes longer than 0.01 s, the limit of the language server");
    // On a busy machine even a small document takes longer than 0.01 s now and then.
    for (int tries = 0; tries < 1000 && !found.empty(); ++tries) {
        editor.change(kTree, "#n = 1;\n#w : F(1);\n");
    }
    CHECK(editor.diagnostics.at(Editor::uri(kTree)).empty());
}

TEST_CASE("a cancelled request is not run") {
    Editor editor(kNoFeatures);
    editor.send_all(
        {{{"jsonrpc", "2.0"},
          {"id", 70},
          {"method", "workspace/symbol"},
          {"params", {{"query", ""}}}},
         {{"jsonrpc", "2.0"},
          {"id", 71},
          {"method", "workspace/symbol"},
          {"params", {{"query", ""}}}},
         {{"jsonrpc", "2.0"}, {"method", "$/cancelRequest"}, {"params", {{"id", 70}}}}});
    CHECK(code_of(editor.responses.at(70)) == -32800);
    CHECK(editor.responses.at(71).contains("result"));
}

TEST_CASE("diagnostics are published for open documents and withdrawn at their end") {
    Editor editor(Json{{"textDocument", {{"publishDiagnostics", {{"relatedInformation", true}}}}}});
    editor.open(kTree, "#n = 1;\n#w : A;\n#p : A : * : F(x);\n");
    const Json& found = editor.diagnostics.at(Editor::uri(kTree));
    REQUIRE(codes(found) == std::vector<std::string>{"unknown-name"});
    CHECK(found[0].at("range") == Editor::range(2, 15, 16));
    CHECK(found[0].at("severity") == 1);
    CHECK(found[0].at("source") == "lsc");
    editor.change(kTree, "#n = 1;\n#w : A;\n#p : A : * : F(1);\n");
    CHECK(editor.diagnostics.at(Editor::uri(kTree)).empty());
    editor.change(kTree, "#n = 1;\n#define y 1;\n#w : A;\n#p : A : * : F(1);\n");
    const Json& unused = editor.diagnostics.at(Editor::uri(kTree));
    REQUIRE(codes(unused) == std::vector<std::string>{"unused-constant"});
    CHECK(unused[0].at("severity") == 2);
    CHECK(unused[0].at("tags") == Json::array({1}));
    editor.change(kTree, "#n = 1;\n#w : A;\n#p : A : x < 1 : F(1);\n");
    CHECK_FALSE(editor.diagnostics.at(Editor::uri(kTree)).empty());
    editor.notify("textDocument/didClose", Editor::in(kTree));
    CHECK(editor.diagnostics.at(Editor::uri(kTree)).empty());
}

TEST_CASE("labels become related information") {
    Editor editor(Json{{"textDocument", {{"publishDiagnostics", {{"relatedInformation", true}}}}}});
    editor.open(kTree, "#n = 1;\n#w : A;\n#p : A : * : F;\n#p : A : * : F F;\n");
    const Json& found = editor.diagnostics.at(Editor::uri(kTree));
    REQUIRE_FALSE(found.empty());
    const Json& related = found[0].at("relatedInformation");
    CHECK(related[0].at("location").at("uri") == Editor::uri(kTree));
    CHECK(related[0].at("location").at("range").at("start").at("line") == 2);
}

TEST_CASE("several changes that arrive together are checked once") {
    Editor editor(kNoFeatures);
    editor.open(kTree, "#w : F;");
    const int before = editor.publish_count;
    std::vector<Json> changes;
    for (int i = 2; i < 12; ++i) {
        changes.push_back(
            {{"jsonrpc", "2.0"},
             {"method", "textDocument/didChange"},
             {"params",
              {{"textDocument", {{"uri", Editor::uri(kTree)}, {"version", i}}},
               {"contentChanges", Json::array({Json{{"text", "#n = 1; #w : F;"}}})}}}});
    }
    editor.send_all(changes);
    CHECK(editor.publish_count == before + 1);
}

TEST_CASE("a hover that arrives with a change does not keep the diagnostics back") {
    Editor editor(kNoFeatures);
    editor.open(kTree, "#n = 1;\n#w : F(zz);\n");
    editor.send_all(
        {{{"jsonrpc", "2.0"},
          {"method", "textDocument/didChange"},
          {"params",
           {{"textDocument", {{"uri", Editor::uri(kTree)}, {"version", 2}}},
            {"contentChanges", Json::array({Json{{"text", "#n = 1;\n#w : F(1);\n"}}})}}}},
         {{"jsonrpc", "2.0"},
          {"id", 80},
          {"method", "textDocument/hover"},
          {"params", Editor::at(kTree, 1, 5)}}});
    CHECK(editor.diagnostics.at(Editor::uri(kTree)).empty());
}

TEST_CASE("diagnostics are pulled by editors that can") {
    Editor editor(Json{{"textDocument", {{"diagnostic", Json::object()}}}});
    editor.open(kTree, "#n = 1;\n#w : F(zz);\n");
    CHECK(editor.publish_count == 0);
    const Json report = editor.request("textDocument/diagnostic", Editor::in(kTree));
    CHECK(report.at("kind") == "full");
    CHECK_FALSE(report.at("items").empty());
}

TEST_CASE("included files are read from the editor first") {
    Editor editor(kNoFeatures, {{"/p/part.lsys", "#p : A : * : F;\n"}});
    editor.open(kTree, "#n = 1;\n#include \"part.lsys\";\n#w : A;\n");
    CHECK(editor.diagnostics.at(Editor::uri(kTree)).empty());
    // A mistake in the open text of the part is shown at the `#include` of the other document.
    editor.open("/p/part.lsys", "#p : A : * : F(x);\n");
    const Json& found = editor.diagnostics.at(Editor::uri(kTree));
    REQUIRE(codes(found) == std::vector<std::string>{"unknown-name"});
    CHECK(found[0].at("range") == Editor::range(1, 9, 20));
    CHECK(found[0].at("message").get<std::string>().find("in `/p/part.lsys`") == 0);
    editor.change("/p/part.lsys", "#p : A : * : F(1);\n");
    CHECK(editor.diagnostics.at(Editor::uri(kTree)).empty());
    CHECK(editor.diagnostics.at("file:///p/part.lsys").empty()); // a part needs no axiom
}

TEST_CASE("a grammar that would not fit into memory is checked at once") {
    Editor editor(kNoFeatures);
    editor.open(kTree, "#n = 4294967294;\n#w : A;\n#p : A : * : A A A A A A A A;\n");
    CHECK(editor.diagnostics.contains(Editor::uri(kTree)));
}

TEST_CASE("grammars of other programs are checked") {
    Editor editor(kNoFeatures);
    editor.notify("textDocument/didOpen", {{"textDocument",
                                            {{"uri", "file:///p/curve.l"},
                                             {"languageId", "fractint"},
                                             {"version", 1},
                                             {"text", "Koch {\n Angle 6\n Axiom F--F--F\n"
                                                      " F=F+F--F+F(\n}\n"}}}});
    CHECK(editor.diagnostics.contains("file:///p/curve.l"));
    CHECK(editor.error_code("textDocument/formatting", Editor::in("/p/curve.l")) == -32803);
}

TEST_CASE("fixes are code actions, certain ones preferred") {
    Editor editor(kNoFeatures);
    const std::string text = "#n = 6;\n#w : A(8);\n#grow : A(x) : x > 1 : F(x) A(x - 2);\n"
                             "#stop : A(x) : x < 1 : F(1);\n";
    editor.open(kTree, text);
    const Json actions =
        actions_in(editor, kTree, Editor::range(3, 15, 16), {{"diagnostics", Json::array()}});
    REQUIRE(actions.size() == 2); // two repairs, of which the author chooses
    for (const Json& action : actions) {
        CHECK(action.at("kind") == "quickfix");
        CHECK_FALSE(action.contains("isPreferred"));
        CHECK(action.at("diagnostics")[0].at("code") == "condition-gap");
    }
    CHECK(Editor::applied(text, actions[0].at("edit").at("changes").at(Editor::uri(kTree)))
              .find("x <= 1") != std::string::npos);
    CHECK(actions_in(editor, kTree, Editor::range(0, 0, 1), {{"diagnostics", Json::array()}})
              .empty());

    const std::string broken = "#n = 1\n#w : F;\n";
    editor.change(kTree, broken);
    const Json certain =
        actions_in(editor, kTree, Editor::range(0, 0, 6),
                   {{"diagnostics", Json::array()}, {"only", Json::array({"quickfix"})}});
    REQUIRE(certain.size() == 1);
    CHECK(certain[0].at("isPreferred") == true);
    CHECK(Editor::applied(broken, certain[0].at("edit").at("changes").at(Editor::uri(kTree))) ==
          "#n = 1;\n#w : F;\n");
}

TEST_CASE("documents are formatted as by lsc fmt") {
    Editor editor(kNoFeatures);
    const std::string text = "#n=1;\r\n#w:A   F;\r\n#p:A:*:F;\r\n";
    editor.open(kTree, text);
    const Json edits = editor.request("textDocument/formatting", Editor::in(kTree));
    REQUIRE(edits.size() == 1);
    const std::string formatted = Editor::applied(text, edits);
    CHECK(formatted == "#n = 1;\r\n#w : A F;\r\n#p : A : * : F;\r\n");
    editor.change(kTree, formatted);
    CHECK(editor.request("textDocument/formatting", Editor::in(kTree)).empty());
    editor.change(kTree, "#w : (;");
    CHECK(editor.error_code("textDocument/formatting", Editor::in(kTree)) == -32803);
}

TEST_CASE("the outline lists statements with names") {
    const std::string text = "#n = 1;\n#define k 2;\n#function f(x) x;\n#object L LEAF;\n"
                             "#w : A;\n#p : A : * : F(f(k)) L;\n";
    Editor nested(Json{
        {"textDocument", {{"documentSymbol", {{"hierarchicalDocumentSymbolSupport", true}}}}}});
    nested.open(kTree, text);
    std::vector<std::string> names;
    const Json symbols = nested.request("textDocument/documentSymbol", Editor::in(kTree));
    for (const Json& symbol : symbols) {
        names.push_back(symbol.at("name").get<std::string>());
    }
    CHECK(names == std::vector<std::string>{"k", "f", "L", "w", "p"});
    CHECK(symbols[0].at("selectionRange") == Editor::range(1, 8, 9));
    CHECK(symbols[0].at("range") == Editor::range(1, 0, 12));

    Editor flat(kNoFeatures, {{"/p/other.lsys", "#define Kappa 1;\n"}});
    flat.open(kTree, text);
    CHECK(flat.request("textDocument/documentSymbol", Editor::in(kTree))[0].contains("location"));
    const Json found = flat.request("workspace/symbol", {{"query", "K"}});
    REQUIRE(found.size() == 2);
    CHECK(found[0].at("location").at("uri") == "file:///p/other.lsys");
    CHECK(found[1].at("name") == "k");
}

TEST_CASE("positions are in UTF-16 or in bytes, as the editor can") {
    // The comment has a character of two UTF-16 units and four bytes.
    const std::string text = "/* \xF0\x9F\x8C\xB2 */ #n = 1; #w : F(zz);\n";
    Editor utf16(kNoFeatures);
    CHECK(utf16.answer.at("capabilities").at("positionEncoding") == "utf-16");
    utf16.open(kTree, text);
    CHECK(utf16.diagnostics.at(Editor::uri(kTree))[0].at("range") == Editor::range(0, 24, 26));
    Editor utf8(Json{{"general", {{"positionEncodings", Json::array({"utf-16", "utf-8"})}}}});
    CHECK(utf8.answer.at("capabilities").at("positionEncoding") == "utf-8");
    utf8.open(kTree, text);
    CHECK(utf8.diagnostics.at(Editor::uri(kTree))[0].at("range") == Editor::range(0, 26, 28));
    // An edit after the character.
    utf16.notify("textDocument/didChange",
                 {{"textDocument", {{"uri", Editor::uri(kTree)}, {"version", 2}}},
                  {"contentChanges",
                   Json::array({Json{{"range", Editor::range(0, 24, 26)}, {"text", "1"}}})}});
    CHECK(utf16.diagnostics.at(Editor::uri(kTree)).empty());
}
