// SPDX-License-Identifier: MIT
#include "tests/runtime/languageserver/editor.h"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

namespace {

using lsys::tests::Editor;
using Json = nlohmann::json;

constexpr const char* kShown = "/p/shown.lsys";

} // namespace

TEST_CASE("names have token types by their kind") {
    Editor editor(Json::object());
    // The character of two UTF-16 units shifts the tokens after it.
    editor.open(kShown, "#n = 1;\n/* \xF0\x9F\x8C\xB2 */ #define k 2;\n#w : A(k);\n"
                        "#p : A(x) : x > sin(k) : F(x);\n");
    const Json data =
        editor.request("textDocument/semanticTokens/full", Editor::in(kShown)).at("data");
    const Json& types =
        editor.answer.at("capabilities").at("semanticTokensProvider").at("legend").at("tokenTypes");
    std::vector<std::string> tokens; // line:character+length type
    int line = 0;
    int character = 0;
    REQUIRE(data.size() % 5 == 0);
    for (std::size_t i = 0; i < data.size(); i += 5) {
        character =
            data[i].get<int>() == 0 ? character + data[i + 1].get<int>() : data[i + 1].get<int>();
        line += data[i].get<int>();
        tokens.push_back(std::to_string(line) + ":" + std::to_string(character) + "+" +
                         data[i + 2].dump() + " " +
                         types.at(data[i + 3].get<std::size_t>()).get<std::string>());
    }
    CHECK(tokens == std::vector<std::string>{
                        "0:0+2 keyword", "1:9+7 keyword", "1:17+1 variable", "2:0+2 keyword",
                        "2:5+1 class", "2:7+1 variable", "3:1+1 method", "3:5+1 class",
                        "3:7+1 parameter", "3:12+1 parameter", "3:16+3 function", "3:20+1 variable",
                        "3:25+1 class", "3:27+1 parameter"});
}

TEST_CASE("statements and comments of several lines are folded") {
    Editor editor(Json::object());
    editor.open(kShown,
                "/* a\n b */\n#n = 1; /* c */\n#w : F\n  F /* d\n */\n  F;\n#define k 1;\n");
    const Json ranges = editor.request("textDocument/foldingRange", Editor::in(kShown));
    REQUIRE(ranges.size() == 2);
    CHECK(ranges[0] == Json{{"startLine", 0}, {"endLine", 1}, {"kind", "comment"}});
    CHECK(ranges[1] == Json{{"startLine", 3}, {"endLine", 6}});
}

TEST_CASE("colours of materials are shown and written") {
    Editor editor(Json::object());
    editor.open(kShown, "#material 3 roughness 0.5 colour 0.25 0.5 1;\n#material 4 colour 2 0 0;\n"
                        "#material 5 picture \"a.png\";\n#material 6 color 0 (1/2) 0;\n");
    const Json colours = editor.request("textDocument/documentColor", Editor::in(kShown));
    REQUIRE(colours.size() == 1); // not the one out of range, nor the one with an expression
    CHECK(colours[0].at("range") == Editor::range(0, 33, 43));
    CHECK(colours[0].at("color") ==
          Json{{"red", 0.25}, {"green", 0.5}, {"blue", 1.0}, {"alpha", 1}});
    Json params = Editor::in(kShown);
    params["color"] = {{"red", 0.12345}, {"green", 0}, {"blue", 1}, {"alpha", 1}};
    params["range"] = Editor::range(0, 33, 43);
    const Json texts = editor.request("textDocument/colorPresentation", params);
    REQUIRE(texts.size() == 1);
    CHECK(texts[0].at("label") == "0.123 0 1");

    editor.change(kShown, "#w : '(0.5, 0.25, 1) F '(3) '(k, 0, 0);\n#p : A : * : '(1, 0, 0);\n");
    const Json modules = editor.request("textDocument/documentColor", Editor::in(kShown));
    REQUIRE(modules.size() == 2);
    CHECK(modules[0].at("range") == Editor::range(0, 7, 19));
    params["range"] = Editor::range(0, 7, 19);
    CHECK(editor.request("textDocument/colorPresentation", params)[0].at("label") == "0.123, 0, 1");
}
