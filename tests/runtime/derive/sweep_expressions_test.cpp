// SPDX-License-Identifier: MIT
// Conditions, weights and new parameters in sweeps, which are computed without the stack machine.
#include "compiler/bytecode/distributions.h"
#include "runtime/base/random.h"
#include "runtime/derive/engine/sweep_program.h"
#include "runtime/derive/word_text.h"
#include "tests/runtime/derive/derived_text.h"

#include <catch2/catch.hpp>

#include <string>

namespace lsys {
namespace {

using test::compiled;
using test::word_of;

std::string copies_of(const std::string& text, int count) {
    std::string all;
    for (int i = 0; i < count; ++i) {
        all += text;
    }
    return all;
}

TEST_CASE("choices and values that several operations of a sweep use") {
    // 4; (3-4)*(4-2) = -2; m = 2, h = 1: 1; m = 1, h = 0.5: 0.5
    CHECK(word_of("#w : A(1) A(2) A(3) A(4);\n"
                  "#down d : A(x) > A(y) : * : let m = max(x, y), h = m/2 :"
                  " A(if(x < 3, if(y > 4, m+h, m-h), (x-y)*(y-h)));\n",
                  0) == "A(0.5)A(1)A(-2)A(4)");
}

TEST_CASE("a sweep computes all operators with either operand at hand") {
    const std::string down = "#w : A(6) A(4);\n#down d : A(x) > A(y) : * : ";
    CHECK(word_of(down + "A((x+y)*(x-y) - x/(y-x));\n", 0) == "A(23)A(4)");
    CHECK(word_of(down + "A(x - (y - x*y));\n", 0) == "A(26)A(4)");
    CHECK(word_of(down + "A(x / (y/8) + 1/(x-y));\n", 0) == "A(12.5)A(4)");
    CHECK(word_of(down + "A((x < y+y) + 2*(x > y+y) + 4*(y+y >= x) + 8*(x+x == y*3));\n", 0) ==
          "A(13)A(4)");
    CHECK(word_of(down + "A(max(x, y+1) + 100*min(x, y+1) + 10000*max(x+1, y));\n", 0) ==
          "A(70506)A(4)");
    CHECK(word_of(down + "A((x && y-4) + 2*(x-6 || y) + 4*!(y-4) + 8*(x != y+2));\n", 0) ==
          "A(6)A(4)");
    CHECK(word_of(down + "A(mod(x+1, y) + 10*mod(y*5, x+1) + 100*floor(x/y) + (y-2)^(x-3));\n",
                  0) == "A(171)A(4)");
}

TEST_CASE("a curve in a sweep") {
    CHECK(word_of("#curve c 0 0, 4 8;\n#w : A(6) A(2);\n"
                  "#down d : A(x) > A(y) : * : A(c(y) + x);\n",
                  0) == word_of("#curve c 0 0, 4 8;\n#w : A(c(2) + 6) A(2);\n", 0));
}

TEST_CASE("expressions of more operations than a sweep runs at a time") {
    CHECK(word_of("#w : A(1) A(2);\n#down d : A(x) > A(y) : * : A(x" + copies_of("+(y-x*2)", 400) +
                      ");\n",
                  0) == "A(1)A(2)");
    std::string locals = "v0 = x+1";
    for (int i = 1; i < 300; ++i) {
        locals += ", v" + std::to_string(i) + " = v" + std::to_string(i - 1) + "+1";
    }
    CHECK(word_of("#w : A(1) A(2);\n#down d : A(x) : * : let " + locals + " : A(v299);\n", 0) ==
          "A(301)A(302)");
}

TEST_CASE("new values of a module that read its old ones") {
    CHECK(word_of("#w : A(1,2,3) A(4,5,6);\n"
                  "#down d : A(x,y,z) > A(a,b,c) : * : A(y,z+c,x-a);\n",
                  0) == "A(2,9,-3)A(4,5,6)");
}

TEST_CASE("the draws of a sweep") {
    std::string expected;
    for (std::uint64_t i = 0; i < 200; ++i) {
        DrawSource source(7, 0, 2 * i);
        const float range = draw_in_range(0.0F, 8.0F, source.draw(kFirstDownDraw));
        const float drawn = draw_from(Opcode::Poisson, 3.0F, 3.0F, source.draw(kFirstDownDraw + 1));
        expected += "A(";
        append_number(range + 8.0F * drawn, expected);
        expected += ")+";
    }
    CHECK(word_of("#w : " + copies_of("A(3)+", 200) +
                      ";\n#down d : A(x) : * : A({0, 8} + 8*poisson(x));\n",
                  0) == expected);
}

TEST_CASE("a sweep reports an invalid draw only if its side of a choice is taken") {
    const std::string up = "#w : A(0) A(1) A(2);\n#up u : A(x) : * : ";
    CHECK(word_of(up + "A(if(x < 5, x+1, {x, 1}));\n", 0) == "A(1)A(2)A(3)");
    CHECK(word_of(up + "A(if(x < 2, x+1, if(x < 5, 7, {x, 1})));\n", 0) == "A(1)A(2)A(7)");
    const auto error_of = [&](const std::string& successor) {
        return test::error_every_way(compiled(up + successor), 0, 7);
    };
    const RuntimeError range = error_of("A(if(x < 2, x+1, if(x > 5, 1, {x, 1})));\n");
    CHECK(range.kind == RuntimeErrorKind::RangeReversed);
    CHECK(range.position == 2);
    const RuntimeError distribution = error_of("A(if(x < 1, x, poisson(0-x)));\n");
    CHECK(distribution.kind == RuntimeErrorKind::BadDistribution);
    CHECK(distribution.position == 1);
    // A local value that nothing reads is computed all the same.
    const RuntimeError unread = error_of("let r = {x, 1} : A(x);\n");
    CHECK(unread.kind == RuntimeErrorKind::RangeReversed);
    CHECK(unread.position == 2);
}

} // namespace
} // namespace lsys
