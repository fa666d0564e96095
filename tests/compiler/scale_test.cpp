// SPDX-License-Identifier: MIT
// Inputs so large that a quadratic step would exceed the time limit, yet small enough for every
// test run.
#include "tests/compiler/compile_text.h"

#include <catch2/catch.hpp>

using namespace lsys;
using test::compile_text;

TEST_CASE("the search for a split ends early for a name that is costly to split") {
    // Every prefix of the long name is a known name, but no sequence of known names reaches its
    // end.
    std::string text = "#w : F;\n";
    for (int length = 1; length <= 1'500; ++length) {
        text += "#module " + std::string(static_cast<std::size_t>(length), 'a') + ";\n";
    }
    text += "#p : F : * : " + std::string(1'000'000, 'a') + "b;\n";
    const test::Compiled c = compile_text(text);
    CHECK(c.errors().empty());
    CHECK(c.find(DiagnosticCode::SplitName) == nullptr);
}

TEST_CASE("a long name splits in linear time") {
    std::string name;
    for (int i = 0; i < 100'000; ++i) {
        name += i % 2 == 0 ? "Ab" : "Cde";
    }
    const test::Compiled c =
        compile_text("#w : F;\n#p : F : * : " + name + ";\n#q : Ab : * : F;\n#r : Cde : * : F;\n");
    CHECK(c.errors().empty());
    REQUIRE(c.outcome.program);
    CHECK(c.outcome.program->productions[0].successor.module_count == 100'000);
}

TEST_CASE("thousands of definitions, productions and mistakes take linear time") {
    std::string text = "#define d0 1;\n";
    for (int i = 1; i < 20'000; ++i) {
        text += "#define d" + std::to_string(i) + " d" + std::to_string(i - 1) + " + 1;\n";
    }
    text += "#w : A0(d19999);\n";
    for (int i = 0; i < 20'000; ++i) {
        text += "#p" + std::to_string(i) + " : A" + std::to_string(i) + "(x) : * : F(x) A" +
                std::to_string((i + 1) % 20'000) + "(x + 1);\n";
    }
    const test::Compiled c = compile_text(text);
    CHECK(c.errors().empty());
    REQUIRE(c.outcome.program);
    CHECK(c.outcome.program->rule_count == 20'000);
    CHECK(c.outcome.program->constants.back().value == 20'000.0F);

    std::string mistakes = "#w : F(1);\n";
    for (int i = 0; i < 20'000; ++i) {
        mistakes +=
            "#p" + std::to_string(i) + " : F(x) : x > 1 : F(unknown" + std::to_string(i) + ");\n";
    }
    CHECK(compile_text(mistakes).errors().size() == 20'000);
}
