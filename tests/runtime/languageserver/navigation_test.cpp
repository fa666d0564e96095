// SPDX-License-Identifier: MIT
#include "tests/runtime/languageserver/editor.h"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

namespace {

using lsys::tests::Editor;
using Json = nlohmann::json;

constexpr const char* kMain = "/p/main.lsys";
constexpr const char* kPart = "/p/part.lsys";
const std::string kMainText = "#n = 2;\n"                                        // 0
                              "#define k 2;\n"                                   // 1
                              "#include \"part.lsys\";\n"                        // 2
                              "#w : A(k) L;\n"                                   // 3
                              "#p : A(x) : x > k : let y = x/2 : F(y) A(y) L;\n" // 4
                              "#q : A(x) : x <= k : F(half(x)) L;\n";            // 5
const std::string kPartText = "#function half(x) x/k;\n"                         // 0
                              "#object L LEAF;\n"                                // 1
                              "#r : L : * : L;\n";                               // 2

struct Project : Editor {
    Project() : Editor(Json::object(), {{kMain, kMainText}, {kPart, kPartText}}) {
        open(kMain, kMainText);
    }
    std::vector<std::string> references(const char* path, int line, int character) {
        Json params = at(path, line, character);
        params["context"] = {{"includeDeclaration", true}};
        std::vector<std::string> found;
        for (const Json& place : request("textDocument/references", params)) {
            const Json& start = place.at("range").at("start");
            found.push_back(place.at("uri").get<std::string>().substr(10) + ":" +
                            start.at("line").dump() + ":" + start.at("character").dump());
        }
        return found;
    }
    Json rename_params(const char* path, int line, int character, const char* name) {
        Json params = at(path, line, character);
        params["newName"] = name;
        return params;
    }
};

using Places = std::vector<std::string>;

} // namespace

TEST_CASE("references of a name are found in all files of a grammar") {
    Project project;
    CHECK(project.references(kMain, 1, 8) == Places{"main.lsys:1:8", "main.lsys:3:7",
                                                    "main.lsys:4:16", "main.lsys:5:17",
                                                    "part.lsys:0:20"});
    CHECK(project.references(kMain, 5, 24) == Places{"main.lsys:5:23", "part.lsys:0:10"});
    CHECK(project.references(kMain, 3, 10) == Places{"main.lsys:3:10", "main.lsys:4:44",
                                                     "main.lsys:5:32", "part.lsys:1:8",
                                                     "part.lsys:2:5", "part.lsys:2:13"});
    // A formal and a local value belong to their production.
    CHECK(project.references(kMain, 4, 7) ==
          Places{"main.lsys:4:7", "main.lsys:4:12", "main.lsys:4:28"});
    CHECK(project.references(kMain, 4, 24) ==
          Places{"main.lsys:4:24", "main.lsys:4:36", "main.lsys:4:41"});
    CHECK(project.references(kMain, 0, 1).empty());
    // The end of a name is on the name.
    CHECK(project.references(kMain, 1, 9).size() == 5);
}

TEST_CASE("the included file finds the names of the grammar that includes it") {
    Project project;
    project.open(kPart, kPartText);
    CHECK(project.references(kPart, 0, 20).size() == 5);
    const Json definition = project.request("textDocument/definition", Editor::at(kPart, 0, 20));
    REQUIRE(definition.size() == 1);
    CHECK(definition[0].at("uri") == Editor::uri(kMain));
    CHECK(definition[0].at("range") == Editor::range(1, 8, 9));
}

TEST_CASE("definitions: a module has its productions, an include its file") {
    Project project;
    CHECK(project.request("textDocument/definition", Editor::at(kMain, 3, 5)).size() == 2);
    const Json file = project.request("textDocument/definition", Editor::at(kMain, 2, 12));
    REQUIRE(file.size() == 1);
    CHECK(file[0].at("uri") == Editor::uri(kPart));
    const Json marks = project.request("textDocument/documentHighlight", Editor::at(kMain, 1, 8));
    REQUIRE(marks.size() == 4);
    CHECK(marks[0].at("kind") == 3);
    CHECK(marks[1].at("kind") == 2);
}

TEST_CASE("a rename changes all files") {
    Project project;
    const Json changes =
        project.request("textDocument/rename", project.rename_params(kMain, 1, 8, "ratio"))
            .at("changes");
    REQUIRE(changes.size() == 2);
    const std::string main = Editor::applied(kMainText, changes.at(Editor::uri(kMain)));
    const std::string part = Editor::applied(kPartText, changes.at(Editor::uri(kPart)));
    CHECK(part == "#function half(x) x/ratio;\n#object L LEAF;\n#r : L : * : L;\n");
    CHECK(main.find("#define ratio 2;") != std::string::npos);
    CHECK(main.find("A(ratio)") != std::string::npos);
    project.change(kMain, main);
    project.open(kPart, part);
    CHECK(project.diagnostics.at(Editor::uri(kMain)).empty());
}

TEST_CASE("formals, modules, functions and productions are renamed") {
    Project project;
    const auto renamed = [&](int line, int character, const char* name) {
        const Json edit = project.request("textDocument/rename",
                                          project.rename_params(kMain, line, character, name));
        return Editor::applied(kMainText, edit.at("changes").at(Editor::uri(kMain)));
    };
    CHECK(renamed(4, 7, "size").find("A(size) : size > k : let y = size/2 : F(y)") !=
          std::string::npos);
    CHECK(renamed(3, 5, "Bud").find("#w : Bud(k) L;") != std::string::npos);
    CHECK(renamed(5, 24, "smaller").find("F(smaller(x))") != std::string::npos);
    CHECK(renamed(4, 1, "grow").find("#grow : A(x)") != std::string::npos);
    CHECK(renamed(4, 24, "z").find("let z = x/2 : F(z) A(z) L") != std::string::npos);
    CHECK(project.request("textDocument/rename", project.rename_params(kMain, 4, 24, "y"))
              .at("changes")
              .empty());
}

TEST_CASE("renames that are invalid or change the meaning are refused") {
    Project project;
    const auto refusal = [&](int line, int character, const char* name) {
        return project.error_text("textDocument/rename",
                                  project.rename_params(kMain, line, character, name));
    };
    CHECK(refusal(1, 8, "2k").find("is not a name") != std::string::npos);
    CHECK(refusal(1, 8, "").find("is not a name") != std::string::npos);
    CHECK(refusal(1, 8, "x").find("another meaning") != std::string::npos); // formals hide it
    CHECK(refusal(4, 7, "k").find("another meaning") != std::string::npos);
    CHECK(refusal(4, 7, "y").find("exists already") != std::string::npos);
    CHECK(refusal(4, 1, "q").find("exists already") != std::string::npos);
    CHECK(refusal(4, 1, "w").find("another meaning") != std::string::npos); // an axiom
    CHECK(refusal(3, 5, "L").find("exists already") != std::string::npos);
    CHECK(refusal(3, 5, "F").find("command of the turtle") != std::string::npos);
    CHECK(refusal(4, 35, "G").find("command of the turtle") != std::string::npos);
    CHECK(refusal(0, 0, "G").find("no name") != std::string::npos);
    CHECK(project.error_code("textDocument/prepareRename", Editor::at(kMain, 4, 35)) == -32803);
    CHECK(project.request("textDocument/prepareRename", Editor::at(kMain, 0, 0)).is_null());
    const Json prepared = project.request("textDocument/prepareRename", Editor::at(kMain, 1, 8));
    CHECK(prepared.at("placeholder") == "k");
    CHECK(prepared.at("range") == Editor::range(1, 8, 9));
}

TEST_CASE("modules that are written as one name are found, and not renamed") {
    Project project;
    const std::string text = "#n = 1;\n#w : AAB;\n#p : A : * : F;\n#q : B : * : F;\n";
    project.open("/p/joined.lsys", text);
    CHECK(project.references("/p/joined.lsys", 1, 6).size() == 3);
    CHECK(project
              .error_text("textDocument/rename", project.rename_params("/p/joined.lsys", 2, 5, "C"))
              .find("separate them by blanks") != std::string::npos);
}
