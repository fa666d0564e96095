// SPDX-License-Identifier: MIT
#include "tests/runtime/languageserver/editor.h"

#include <catch2/catch.hpp>

#include <set>
#include <string>

namespace {

using lsys::tests::Editor;
using Json = nlohmann::json;

constexpr const char* kAssisted = "/p/tree.lsys";
const std::string kGrammar =
    "#n = 2;\n"
    "#set turtle abop;\n"
    "#define ratio 2;\n"
    "#function half(x, y) x/ratio + y;\n"
    "#object L LEAF;\n"
    "#w : A(1) L;\n"
    "#grow : A(size) : size > ratio : let t = size/2 : F(t) A(half(t, 1));\n";

struct Session : Editor {
    Session() : Editor(Json::object()) { open(kAssisted, kGrammar); }

    /// The labels of the completion at the end of `line`, which is added to the grammar.
    std::set<std::string> labels_after(const std::string& line) {
        change(kAssisted, kGrammar + line);
        std::set<std::string> labels;
        for (const Json& item :
             request("textDocument/completion", at(kAssisted, 7, static_cast<int>(line.size())))) {
            labels.insert(item.at("label").get<std::string>());
        }
        return labels;
    }
    std::string hover_at(int line, int character) {
        const Json found = request("textDocument/hover", at(kAssisted, line, character));
        return found.is_null() ? "" : found.at("contents").at("value").get<std::string>();
    }
};

} // namespace

TEST_CASE("completion offers what may stand at the cursor") {
    Session session;
    CHECK(session.labels_after("#").contains("#define"));
    CHECK(session.labels_after("").contains("#interpret"));
    CHECK(session.labels_after("#set ").contains("rewriting"));
    CHECK(session.labels_after("#set ").contains("flare"));
    CHECK(session.labels_after("#set tips ") == std::set<std::string>{"flat", "round", "broken"});
    CHECK(session.labels_after("#set angle ").contains("ratio"));
    CHECK(session.labels_after("#object X ").contains("SPHERE"));

    const auto modules = session.labels_after("#q : L : * : ");
    CHECK(modules.contains("A"));
    CHECK(modules.contains("L"));
    CHECK(modules.contains("+"));
    CHECK_FALSE(modules.contains("ratio"));
    const auto values = session.labels_after("#q : L(age) : age > 1 : let u = age : F(");
    for (const char* name : {"age", "u", "ratio", "half", "sqrt"}) {
        CAPTURE(name);
        CHECK(values.contains(name));
    }
    CHECK_FALSE(values.contains("A"));
    CHECK(session.labels_after("#q : L(age) : ").contains("age"));
    CHECK(session.labels_after("#q : L(").empty()); // a new name
    CHECK(session.labels_after("/* ").empty());
    CHECK(session.labels_after("// #").empty());
}

TEST_CASE("completion replaces the word before the cursor") {
    Session session;
    session.change(kAssisted, kGrammar + "#define b ra");
    const Json items = session.request("textDocument/completion", Editor::at(kAssisted, 7, 12));
    REQUIRE_FALSE(items.empty());
    CHECK(items[0].at("textEdit").at("range") == Editor::range(7, 10, 12));
}

TEST_CASE("hovers tell the meaning of names, settings and statements") {
    Session session;
    CHECK(session.hover_at(6, 50).find("forward") != std::string::npos);
    CHECK(session.hover_at(6, 50).find("`abop`") != std::string::npos);
    CHECK(session.hover_at(6, 25).find("#define ratio 2;") != std::string::npos);
    CHECK(session.hover_at(6, 57).find("#function half") != std::string::npos);
    CHECK(session.hover_at(5, 5).find("#grow : A(size)") != std::string::npos);
    CHECK(session.hover_at(5, 10).find("#object L LEAF;") != std::string::npos);
    CHECK(session.hover_at(1, 7).find("`thesis`") != std::string::npos);
    CHECK(session.hover_at(2, 3).find("constant") != std::string::npos);
    CHECK(session.hover_at(6, 11).find("parameter") != std::string::npos);
    CHECK(session.hover_at(0, 4).find("generation 2: ") == 0);
    CHECK(session.hover_at(1, 14).empty());
}

TEST_CASE("hovers explain the diagnostics under the cursor") {
    Session session;
    session.change(kAssisted, "#n = 1;\n#w : F(zz);\n");
    CHECK(session.hover_at(1, 7).find("text of unknown-name") != std::string::npos);
}

TEST_CASE("signatures show the argument at the cursor") {
    Session session;
    const auto help_after = [&](const std::string& line) {
        session.change(kAssisted, kGrammar + line);
        return session.request("textDocument/signatureHelp",
                               Editor::at(kAssisted, 7, static_cast<int>(line.size())));
    };
    const Json clamp = help_after("#define c clamp(1, ");
    CHECK(clamp.at("signatures")[0].at("label") == "clamp(x, low, high)");
    CHECK(clamp.at("activeParameter") == 1);
    CHECK(clamp.at("signatures")[0].at("parameters")[1].at("label") == "low");
    CHECK(help_after("#define c half(1, min(2, 3), ").at("signatures")[0].at("label") ==
          "half(x, y)");
    const Json forward = help_after("#q : L : * : F(1, ");
    CHECK(forward.at("signatures")[0].at("label") == "F(length, spring constant, mass)");
    CHECK(forward.at("activeParameter") == 1);
    CHECK(help_after("#q : L : * : F(sin(").at("signatures")[0].at("label") == "sin(x)");
    CHECK(help_after("#q : L : * : F(1) ").is_null());
    CHECK(help_after("#q : L : * : A(").at("signatures")[0].at("label") == "A(size)");
    CHECK(help_after("#q : L : * : Q(").is_null());
}

TEST_CASE("unfinished statements of any kind have a completion") {
    Session session;
    const std::string text =
        "#q : `\xF0\x9F\x8C\xB2` < A(x) > \" : x > {1, 2} ~ 0.5 : let a = 1, b "
        "= (2) : F(a, [b] \"x\") /* c */ // d\n; #set ; #object L \"a.obj\";";
    for (std::size_t size = 0; size <= text.size(); ++size) {
        session.change(kAssisted, text.substr(0, size));
        const Json place = Editor::at(kAssisted, size > 100 ? 1 : 0, 1000);
        CHECK(session.request("textDocument/completion", place).is_array());
        CHECK(session.raw_request("textDocument/signatureHelp", place).contains("result"));
        CHECK(session.raw_request("textDocument/hover", place).contains("result"));
    }
}
