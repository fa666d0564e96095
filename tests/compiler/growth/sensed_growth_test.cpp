// SPDX-License-Identifier: MIT
#include "compiler/growth/growth.h"
#include "tests/compiler/compile_text.h"

#include <catch2/catch.hpp>

#include <string>
#include <utility>

namespace lsys {
namespace {

Bytecode code_of(const std::string& text) {
    test::Compiled compiled = test::compile_text(text);
    REQUIRE(compiled.outcome.bytecode);
    return std::move(*compiled.outcome.bytecode);
}

TEST_CASE("growth ends at the first word whose answers decide the next") {
    const Bytecode code = code_of("#n = 6;\n#sense light shadow;\n#w : B;\n#a : B : * : F C;\n"
                                  "#b : C : * : F A ?light(1, 0, 0, 0);\n"
                                  "#c : A > ?light(q, x, y, z) : q > 0.5 : F A A;\n");
    const GrowthPrediction prediction = predict_growth(code, 6);
    REQUIRE(prediction.low.size() == 3);
    CHECK(prediction.low[2].modules.value == 4);
    CHECK(!prediction.has_last);
    REQUIRE(prediction.depends_on != kNoSymbol);
    CHECK(code.symbol(prediction.depends_on).name == "?light");
    CHECK(!find_growth_end(code, 6, 1'000'000).fixed_point);
}

TEST_CASE("what a sweep changes is not known") {
    const Bytecode code = code_of("#n = 4;\n#w : A(0) L(1);\n"
                                  "#p : A(x) : x < 2 : F A(x);\n"
                                  "#down s : A(x) > L(y) : * : A(x + y);\n");
    const GrowthPrediction prediction = predict_growth(code, 4);
    REQUIRE(prediction.low.size() == 1);
    REQUIRE(prediction.depends_on != kNoSymbol);
    CHECK(code.symbol(prediction.depends_on).name == "A");
}

TEST_CASE("answers that decide nothing leave the counts known") {
    const Bytecode code = code_of("#n = 3;\n#sense light shadow;\n#w : A;\n"
                                  "#p : A : * : F ?light(0, 0, 0, 0) A;\n"
                                  "#q : ?light(q, x, y, z) : * : !(q) F;\n");
    const GrowthPrediction prediction = predict_growth(code, 3);
    CHECK(prediction.exact);
    CHECK(prediction.depends_on == kNoSymbol);
    REQUIRE(prediction.low.size() == 4);
    CHECK(prediction.low[3].modules.value == 9);
}

TEST_CASE("a word whose sense modules are not rewritten does not stay the same") {
    const Bytecode code = code_of("#n = 9;\n#sense light shadow;\n#w : F ?light(0);\n");
    CHECK(!find_growth_end(code, 9, 1'000'000).fixed_point);
}

} // namespace
} // namespace lsys
