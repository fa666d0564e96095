// SPDX-License-Identifier: MIT
// Local values and choices, derived by all methods.
#include "tests/runtime/derive/derived_text.h"

#include <catch2/catch.hpp>

#include <string>

namespace lsys {

using test::compiled;
using test::word_of;

TEST_CASE("one draw of a local value serves twice") {
    const std::string once = word_of("#w : A A;\n#p : A : * : let r = {1, 2} : F(r) G(r);\n", 1);
    // The draws are those of a grammar with one range per module.
    const std::string apart = word_of("#w : A A;\n#p : A : * : F({1, 2});\n", 1);
    const std::size_t middle = apart.find(")F(") + 1;
    const std::string first = apart.substr(1, middle - 1);
    const std::string second = apart.substr(middle + 1);
    CHECK(once == "F" + first + "G" + first + "F" + second + "G" + second);
}

TEST_CASE("draws of local values come before those of the successor") {
    const std::string local =
        word_of("#w : A;\n#p : A : * : let r = {1, 2} : F({3, 4}) G(r);\n", 1);
    const std::string plain = word_of("#w : A;\n#p : A : * : G({1, 2}) F({3, 4});\n", 1);
    const std::size_t f = plain.find('F');
    CHECK(local == plain.substr(f) + plain.substr(0, f));
}

TEST_CASE("local values that are affine, computed, unused or many give the word as written") {
    CHECK(word_of("#w : A(8);\n#p : A(x) : x > 1 : let l = x*0.5 : F(l) [A(l)] A(l);\n", 2) ==
          "F(4)[F(2)[A(2)]A(2)]F(2)[A(2)]A(2)");
    CHECK(word_of("#w : A(9);\n#p : A(x) : * : let s = sqrt(x), t = s*s - x : F(s) F(t);\n", 1) ==
          "F(3)F(0)");
    CHECK(word_of("#w : A(9);\n#p : A(x) : * : let s = sqrt(x) : F B;\n", 1) == "F B");
    std::string many = "#w : A(1);\n#p : A(x) : * : let v0 = x + 1";
    for (int i = 1; i < 300; ++i) {
        many += ", v" + std::to_string(i) + " = v" + std::to_string(i - 1) + " + 1";
    }
    CHECK(word_of(many + " : F(v299) F(v0);\n", 1) == "F(301)F(2)");
}

TEST_CASE("a choice evaluates the chosen side only") {
    const std::string choice = "#w : A(0) A(4);\n"
                               "#p : A(x) : * : F(if(x > 0, {x/8, x}*0 + 8/x, 3)) "
                               "G(if(x, if(x > 3, 1, 2), {2, x}*0 + 5));\n";
    // The range {2, x} is chosen only for x = 0, which is an error.
    CHECK(test::error_every_way(compiled(choice), 1, 7).position == 0);
    CHECK(word_of("#w : A(0) A(4);\n#p : A(x) : * : F(if(x > 0, {x/8, x}*0 + 8/x, 3));\n", 1) ==
          "F(3)F(2)");
    CHECK(word_of("#w : A(4);\n#p : A(x) : * : F(if(x, 1, {2, -x}));\n", 1) == "F(1)");
    CHECK(word_of("#w : A(4);\n#p : A(x) : if(x > 2, 1, 0) : B;\n", 1) == "B");
}

TEST_CASE("choices can be nested without limit") {
    std::string expression = "0";
    for (int i = 1; i <= 2000; ++i) {
        expression =
            "if(x == " + std::to_string(i) + ", " + std::to_string(3 * i) + ", " + expression + ")";
    }
    CHECK(word_of("#w : A(1) A(700) A(2000) A(5);\n#p : A(x) : * : F(" + expression + ");\n", 1) ==
          "F(3)F(2100)F(6000)F(15)");
}

TEST_CASE("an invalid range in an unused local value is an error too") {
    const RuntimeError error = test::error_every_way(
        compiled("#w : A(3) A(1);\n#p : A(x) : * : let r = {2, x} : B;\n"), 1, 7);
    CHECK(error.position == 1);
}

TEST_CASE("if() and negations in conditions agree with comparisons") {
    const auto derived = [](const std::string& condition) {
        return word_of("#w : A(-2) A(-1) A(-(0)) A(0) A(1) A(1.5) A(2) A(3e38);\n#p : A(x) : " +
                           condition + " : F(x);\n",
                       1);
    };
    const std::string above = derived("x > 1");
    CHECK(derived("if(x > 1, 2, 0)") == above);
    CHECK(derived("if(x <= 1, 0, -1)") == above);
    CHECK(derived("!(x <= 1)") == above);
    CHECK(derived("!if(x*1e10 > 1e10, 0, 1)") == above);
    CHECK(derived("if(if(x > 1, 3, 0), 1, 0)") == above);
    CHECK(derived("if(x > 1, 2, 0) == 2") == above);
    CHECK(derived("if(x > 1, x > -5, 0)") == above);
    const std::string between = derived("x > -1 && x != 0 && x < 2");
    CHECK(derived("if(x > -1, x != 0 && x < 2, 0)") == between);
    CHECK(derived("if(x > -1 && x != 0, x < 2, 0)") == between);
    CHECK(derived("!(x <= -1) && !(x == 0) && !(x >= 2)") == between);
    CHECK(derived("if(x > -1 && x != 0 && x < 2, 0, 1)") ==
          derived("!(x > -1 && x != 0 && x < 2)"));
}

TEST_CASE("clamp and mix") {
    CHECK(word_of("#w : A(5) A(-5) A(0.5);\n"
                  "#p : A(x) : * : F(clamp(x, -1, 1)) G(mix(10, 20, x));\n",
                  1) == "F(1)G(60)F(-1)G(-40)F(0.5)G(15)");
}

} // namespace lsys
