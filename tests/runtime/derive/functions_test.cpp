// SPDX-License-Identifier: MIT
// Functions and curves of a grammar, derived by all methods.
#include "tests/runtime/derive/derived_text.h"

#include <catch2/catch.hpp>

#include <string>

namespace lsys {

using test::compiled;
using test::word_of;

TEST_CASE("a call stands for the body with its arguments") {
    CHECK(word_of("#function f(x, y) x*10 + y;\n#w : F(f(1, 2)) A(3);\n"
                  "#p : A(x) : f(x, 1) == 31 : F(f(x, x + 1)) F(f(f(x, 0), f(0, x)));\n",
                  1) == "F(12)F(34)F(303)");
    CHECK(word_of("#w : A(3);\n#p : A(x) : * : F(f(x));\n#function g(a, b) a - b;\n"
                  "#function f(x) g(x, 2) + g(9, x);\n",
                  1) == "F(7)");
}

TEST_CASE("an argument is computed once") {
    // Both uses of x share one draw, numbered by the place of the argument in the call.
    const std::string twice = word_of("#function twice(x) x + x;\n#w : A A;\n"
                                      "#p : A : * : F(twice({1, 2})) G({1, 2});\n",
                                      1);
    const std::string apart =
        word_of("#w : A A;\n#p : A : * : let r = {1, 2} : F(r + r) G({1, 2});\n", 1);
    CHECK(twice == apart);
    // An error in an unused argument is reported too.
    const std::string unused = "#function first(x, y) x;\n#w : A(3) A(1);\n"
                               "#p : A(x) : * : F(first(x, {2, x}));\n";
    CHECK(test::error_every_way(compiled(unused), 1, 7).position == 1);
    // In the side of an if() that is not taken, arguments are not computed.
    CHECK(word_of("#function first(x, y) x;\n#w : A(1);\n"
                  "#p : A(x) : * : F(if(x > 2, first(x, {2, x}), 5));\n",
                  1) == "F(5)");
}

TEST_CASE("nested calls use different slots") {
    CHECK(word_of("#function sq(x) x*x;\n#function both(a, b) sq(a + b) - sq(a - b);\n#w : A(3);\n"
                  "#p : A(x) : both(x + 1, x) == 48 : let y = sqrt(x + 1) :"
                  " F(both(both(y, 1), y + y)) G(y);\n",
                  1) == "F(128)G(2)");
}

TEST_CASE("a curve of a grammar is a function of one parameter") {
    CHECK(
        word_of("#define top 3;\n#curve c 0 1, 2 (top + 2), 4 -1;\n#w : F(c(2)) A(-1) A(2) A(9);\n"
                "#p : A(x) : c(x) > -5 : F(c(x));\n",
                1) == "F(5)F(1)F(5)F(-1)");
}

TEST_CASE("functions that expand to too many instructions are refused") {
    std::string text = "#function f0(x) x + 1;\n";
    for (int i = 1; i < 60; ++i) {
        const std::string before = "f" + std::to_string(i - 1);
        text +=
            "#function f" + std::to_string(i) + "(x) " + before + "(x) + " + before + "(x + 1);\n";
    }
    const test::Compiled c = test::compile_text(text + "#w : F(1);\n");
    CHECK(c.find(DiagnosticCode::ProgramTooLarge) != nullptr);
    CHECK_FALSE(c.outcome.bytecode);
}

} // namespace lsys
