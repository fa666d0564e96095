// SPDX-License-Identifier: MIT
#include "tests/runtime/languageserver/editor.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

namespace {

using lsys::tests::Editor;
using Json = nlohmann::json;

constexpr const char* kPath = "/p/tree.lsys";

/// The hints of a document as `line:character label`.
std::vector<std::string> hints(Editor& editor, const Json& range) {
    Json params = Editor::in(kPath);
    params["range"] = range;
    std::vector<std::string> all;
    for (const Json& hint : editor.request("textDocument/inlayHint", params)) {
        all.push_back(hint.at("position").at("line").dump() + ":" +
                      hint.at("position").at("character").dump() + " " +
                      hint.at("label").get<std::string>());
    }
    return all;
}

/// The lenses of a document as `line:character title`.
std::vector<std::string> lenses(Editor& editor) {
    std::vector<std::string> all;
    for (const Json& lens : editor.request("textDocument/codeLens", Editor::in(kPath))) {
        const Json& start = lens.at("range").at("start");
        all.push_back(start.at("line").dump() + ":" + start.at("character").dump() + " " +
                      lens.at("command").at("title").get<std::string>());
    }
    std::sort(all.begin(), all.end());
    return all;
}

const Json kAll = {{"start", {{"line", 0}, {"character", 0}}},
                   {"end", {{"line", 1000}, {"character", 0}}}};

} // namespace

TEST_CASE("hints name arguments, draws, ages and numbers of parameters") {
    Editor editor(Json::object());
    editor.open(kPath, "#n = 5;\n"                                                  // 0
                       "#define k {1, 2};\n"                                        // 1
                       "#function mean(a, b) (a + b)/2;\n"                          // 2
                       "#w : A(1, k);\n"                                            // 3
                       "#p : A(size, w) : * ~ 0.5 : F({0, 1}) A(size*2, w) B;\n"    // 4
                       "#q : A(size, w) : * ~ 0.5 : A(mean(size, 3), w) F(1, 2);\n" // 5
                       "#r : B : * : B(3);\n"                                       // 6
                       "#s : B(x) : * : F(normal(x, 1));\n");                       // 7
    CHECK(hints(editor, kAll) ==
          std::vector<std::string>{"1:16 draw 0",     "3:7 size:",    "3:10 w:",
                                   "4:2 from age 0",  "4:25 draw 0",  "4:36 draw 1",
                                   "4:40 size:",      "4:52 /0",      "5:2 from age 0",
                                   "5:25 draw 0",     "5:30 size:",   "5:35 a:",
                                   "5:41 b:",         "5:50 length:", "5:53 spring constant:",
                                   "6:2 from age 1",  "6:6 /0",       "6:14 /1",
                                   "7:2 from age 2",  "7:6 /1",       "7:25 mean:",
                                   "7:28 deviation:", "7:30 draw 0"});
    CHECK(hints(editor, Editor::range(6, 0, 10)) ==
          std::vector<std::string>{"6:2 from age 1", "6:6 /0"});
    // With an error the hints that need no whole grammar stay.
    editor.change(kPath, "#n = 5;\n#w : A(1, zz);\n#p : A(size, w) : * : F;\n");
    CHECK(hints(editor, kAll) == std::vector<std::string>{"1:7 size:", "1:10 w:"});
}

TEST_CASE("lenses show the predicted length and how often names are used") {
    Editor editor(Json::object(), {{"/p/part.lsys", "#r : L : * : F(k);\n"}});
    editor.open(kPath, "#n = 6;\n#define k 2;\n#define unused 1;\n#object L LEAF;\n"
                       "#include \"part.lsys\";\n#w : A;\n#p : A : * : A A L;\n");
    CHECK(lenses(editor) == std::vector<std::string>{"0:0 generation 6: 127 modules",
                                                     "1:8 used once", "2:8 not used",
                                                     "3:8 used once", "6:5 used 3 times"});
    editor.change(kPath, "#n = 2;\n#w : A;\n#p : A : * ~ 0.5 : F;\n#q : A : * ~ 0.5 : A A;\n");
    CHECK(lenses(editor)[0] == "0:0 generation 2: 1 to 4 modules, 2 expected");
    editor.change(kPath, "#n = 2;\n#w : (;\n"); // errors: nothing is predicted
    CHECK(lenses(editor).empty());
}

TEST_CASE("lengths of grammars that explode are predicted at once") {
    Editor editor(Json::object());
    editor.open(kPath, "#n = 4294967294;\n#w : A(0);\n"
                       "#p : A(x) : x < 1000000 : A(x + 1) B(x);\n"
                       "#q : B(x) : x > 3 : F(x) B(x - 1);\n"
                       "#r : B(x) : x <= 3 : F(x) B(x + 0.37) A(x*1.001);\n");
    const auto begin = std::chrono::steady_clock::now();
    CHECK_FALSE(lenses(editor).empty());
    CHECK_FALSE(hints(editor, kAll).empty());
    CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds(20));
    editor.change(kPath, "#n = 300;\n#w : A;\n#p : A : * : A A;\n");
    CHECK(lenses(editor)[0].find("0:0 generation 300: 2^300 modules") == 0);
}

TEST_CASE("hovers show values, lengths and colours") {
    Editor editor(Json::object());
    editor.open(kPath, "#n = 3;\n#define k 2 * 3;\n#w : A;\n#p : A : * : A F(k);\n"
                       "#material 3 colour 1 0.5 0;\n");
    const auto hover = [&](int line, int character) {
        return editor.request("textDocument/hover", Editor::at(kPath, line, character))
            .at("contents")
            .at("value")
            .get<std::string>();
    };
    CHECK(hover(3, 17).find("value: 6") != std::string::npos);
    CHECK(hover(0, 1).find("generation 3: 4 modules") != std::string::npos);
    CHECK(hover(4, 2).find("colour 3: `#ff8000`") != std::string::npos);
}

TEST_CASE("messages link to their explanations") {
    Editor editor(Json::object());
    editor.open(kPath, "#n = 1;\n#w : F(zz);\n");
    CHECK(editor.diagnostics.at(Editor::uri(kPath))[0].at("codeDescription").at("href") ==
          "doc:unknown-name");
}

TEST_CASE("a range, and the statement that a semicolon ends, get the layout of the document") {
    Editor editor(Json::object());
    const std::string text = "#n=1;\n#w:A   F;\n#p:A:*:F;\n";
    editor.open(kPath, text);
    Json params = Editor::in(kPath);
    params["options"] = {{"tabSize", 4}, {"insertSpaces", true}};
    const Json all = Editor::applied(text, editor.request("textDocument/formatting", params));
    CHECK(all == "#n = 1;\n#w : A F;\n#p : A : * : F;\n");
    params["range"] = Editor::range(1, 0, 9);
    CHECK(Editor::applied(text, editor.request("textDocument/rangeFormatting", params)) ==
          "#n=1;\n#w : A F;\n#p:A:*:F;\n");
    params["position"] = Editor::position(2, 9);
    params["ch"] = ";";
    CHECK(Editor::applied(text, editor.request("textDocument/onTypeFormatting", params)) ==
          "#n=1;\n#w:A   F;\n#p : A : * : F;\n");
    // A `;` in a comment, and one while another statement is unfinished, change nothing.
    editor.change(kPath, text + "// a;\n");
    params["position"] = Editor::position(3, 5);
    CHECK(editor.request("textDocument/onTypeFormatting", params).empty());
    editor.change(kPath, text + "#q : A : (\n");
    params["position"] = Editor::position(2, 9);
    CHECK(editor.request("textDocument/onTypeFormatting", params).empty());
    CHECK(editor.error_code("textDocument/rangeFormatting", params) == -32803);
}

TEST_CASE("completion has documentation, and placeholders for editors that take them") {
    const std::string text = "#n = 1;\n#function half(x, y) x/y;\n#w : A(1, 2);\n"
                             "#p : A(length, width) : * : ";
    const auto item = [&](Editor& editor, const char* label, int line, int character) {
        for (Json& each :
             editor.request("textDocument/completion", Editor::at(kPath, line, character))) {
            if (each.at("label") == label) {
                return each;
            }
        }
        return Json();
    };
    Editor plain(Json::object());
    plain.open(kPath, text);
    CHECK(item(plain, "A", 3, 28).at("textEdit").at("newText") == "A");
    CHECK(item(plain, "A", 3, 28).at("detail") == "A(length, width)");
    CHECK(item(plain, "F", 3, 28)
              .at("documentation")
              .at("value")
              .get<std::string>()
              .find("turtle command") != std::string::npos);
    Editor snippets(
        Json{{"textDocument", {{"completion", {{"completionItem", {{"snippetSupport", true}}}}}}}});
    snippets.open(kPath, text);
    CHECK(item(snippets, "A", 3, 28).at("textEdit").at("newText") == "A(${1:length}, ${2:width})");
    CHECK(item(snippets, "A", 3, 28).at("insertTextFormat") == 2);
    snippets.change(kPath, text + "F(");
    CHECK(item(snippets, "half", 3, 30).at("textEdit").at("newText") == "half(${1:x}, ${2:y})");
}

TEST_CASE("names in grammars of other programs are found, shown and renamed") {
    Editor editor(Json::object());
    const char* path = "/p/bush.l";
    const std::string text = "Lsystem: 1\n"                         // 0
                             "derivation length: 3\n"               // 1
                             "Axiom: A(1)\n"                        // 2
                             "A(x) : x > 0 --> F(x)[+(30)A(x-1)]\n" // 3
                             "endlsystem\n";                        // 4
    editor.notify(
        "textDocument/didOpen",
        {{"textDocument",
          {{"uri", Editor::uri(path)}, {"languageId", "cpfg"}, {"version", 1}, {"text", text}}}});
    const Json definition = editor.request("textDocument/definition", Editor::at(path, 2, 7));
    REQUIRE(definition.size() == 1);
    CHECK(definition[0].at("range") == Editor::range(3, 0, 1));
    Json params = Editor::at(path, 3, 2);
    params["context"] = {{"includeDeclaration", true}};
    CHECK(editor.request("textDocument/references", params).size() == 4);
    CHECK(editor.request("textDocument/hover", Editor::at(path, 3, 17))
              .at("contents")
              .at("value")
              .get<std::string>()
              .find("turtle command forward") != std::string::npos);
    params["newName"] = "age";
    CHECK(
        Editor::applied(
            text, editor.request("textDocument/rename", params).at("changes").at(Editor::uri(path)))
            .find("A(age) : age > 0 --> F(age)[+(30)A(age-1)]") != std::string::npos);
    CHECK_FALSE(editor.request("textDocument/documentSymbol", Editor::in(path)).empty());
    CHECK_FALSE(
        editor.request("textDocument/semanticTokens/full", Editor::in(path)).at("data").empty());
    CHECK_FALSE(editor.request("textDocument/completion", Editor::at(path, 3, 0)).empty());
}

TEST_CASE("changes of files are reported by editors that can") {
    Editor editor(Json{{"workspace", {{"didChangeWatchedFiles", {{"dynamicRegistration", true}}}}}},
                  {{"/p/part.lsys", "#p : A : * : F;\n"}});
    REQUIRE(editor.others.size() == 1);
    CHECK(editor.others[0].at("method") == "client/registerCapability");
    editor.send({{"jsonrpc", "2.0"}, {"id", "watch"}, {"result", nullptr}});
    CHECK(editor.others.size() == 1);
    editor.open(kPath, "#n = 1;\n#include \"part.lsys\";\n#w : A;\n");
    CHECK(editor.diagnostics.at(Editor::uri(kPath)).empty());
    editor.files()["/p/part.lsys"] = "#p : A : * : F(x);\n";
    editor.notify("workspace/didChangeWatchedFiles", {{"changes", Json::array()}});
    CHECK_FALSE(editor.diagnostics.at(Editor::uri(kPath)).empty());
}
