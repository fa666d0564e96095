// SPDX-License-Identifier: MIT
#include "compiler/growth/growth.h"
#include "tests/compiler/compile_text.h"
#include "tests/support/bytecode_builder.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace lsys {
namespace {

using test::BytecodeBuilder;

/// The bytecode of a system given by texts; F draws a segment.
Bytecode system(const std::string& axiom,
                const std::vector<std::string>& productions,
                RewritingMode rewriting = RewritingMode::Parallel) {
    BytecodeBuilder builder;
    builder.settings.rewriting = rewriting;
    builder.fold = false;
    builder.axiom(axiom);
    for (const std::string& production : productions) {
        builder.production("p : " + production);
    }
    Bytecode bytecode = builder.build();
    for (BytecodeSymbol& symbol : bytecode.symbols) {
        symbol.turtle = symbol.name == "F" ? TurtleOperation::Forward : TurtleOperation::Nothing;
    }
    return bytecode;
}

Count exactly(std::uint64_t value) {
    return {value, false, 0.0};
}

void check_counts(const Bytecode& code, const std::vector<std::uint64_t>& modules) {
    const auto n = static_cast<std::uint32_t>(modules.size() - 1);
    const GrowthPrediction prediction = predict_growth(code, n);
    CHECK(prediction.exact);
    REQUIRE(prediction.low.size() == modules.size());
    for (std::size_t g = 0; g < modules.size(); ++g) {
        INFO("generation " << g);
        CHECK(to_text(prediction.low[g].modules) == to_text(exactly(modules[g])));
        CHECK(to_text(prediction.high[g].modules) == to_text(exactly(modules[g])));
    }
}

Bytecode koch() {
    return system("F", {"F : * : F+F-F-F+F"});
}

Bytecode weed() {
    return system("X", {"X : * : F-[[X]+X]+F[+F X]-X", "F : * : F F"});
}

/// W3: parameters that no condition reads.
Bytecode ternary() {
    return system("!(1.4)F(2)/(45)A",
                  {"A : * : !(1.4)F(2)[&(22.5)F(2)A]/(112.5)[&(22.5)F(2)A]/(157.5)[&(22.5)F(2)A]",
                   "F(x) : * : F(x * 1.1)", "!(x) : * : !(x * 1.4)"});
}

Bytecode bush() {
    return system("F",
                  {"F : * ~ 0.33 : F[+F]F[-F]F", "F : * ~ 0.33 : F[+F]F", "F : * ~ 0.34 : F[-F]F"});
}

/// W5: A(x) grows while x > 0. `axiom`: A(12), or one whose parameter is unknown.
Bytecode ageing(const std::string& axiom) {
    return system(axiom, {"A(x) : x > 0 : F(1)[+(30)A(x - 1)][-(30)A(x - 1)]A(x - 1)",
                          "A(x) : x <= 0 : F(1)"});
}

TEST_CASE("counts are written with commas, and as powers of two beyond 2^128") {
    CHECK(to_text(exactly(0)) == "0");
    CHECK(to_text(exactly(999)) == "999");
    CHECK(to_text(exactly(1'234'567)) == "1,234,567");
    const Count large{Uint128(std::uint64_t{1} << 63, 0), false, 0.0};
    CHECK(to_text(large) == "170,141,183,460,469,231,731,687,303,715,884,105,728");
    CHECK(to_text(large + large) == "2^128");
    CHECK(to_text(large * exactly(4)) == "2^129");
    CHECK((large * exactly(0)).value == 0);
    CHECK(!(large + exactly(5)).exceeds);
    CHECK((large + large + exactly(1)).approximate_log2() == Approx(128));
    CHECK(exactly(7).at_most(7));
    CHECK(!exactly(8).at_most(7));
    CHECK(!(large + large).at_most(~std::uint64_t{0}));
}

TEST_CASE("deterministic systems are counted exactly") {
    check_counts(koch(), {1, 9, 49, 249, 1'249, 6'249, 31'249, 156'249, 781'249, 3'906'249,
                          19'531'249, 97'656'249, 488'281'249});
    check_counts(weed(), {1, 18, 89, 379, 1'551, 6'263, 25'159, 100'839, 403'751, 1'615'783,
                          6'464'679, 25'861'799, 103'453'351});
    check_counts(ternary(), {4, 22, 76, 238, 724, 2'182, 6'556, 19'678, 59'044, 177'142, 531'436,
                             1'594'318, 4'782'964, 14'348'902});
}

TEST_CASE("conditions over known parameters are decided") {
    check_counts(ageing("A(12)"), {1, 10, 37, 118, 361, 1'090, 3'277, 9'838, 29'521, 88'570,
                                   265'717, 797'158, 2'391'481, 2'391'481});
}

TEST_CASE("conditions with a deeper right operand, computed first, are decided") {
    std::string depth = "x"; // 1 - (1 - (... x)), which is x after an even number of levels
    for (int i = 0; i < 200; ++i) {
        depth = "(1 - " + depth + ")";
    }
    const test::Compiled c =
        test::compile_text("#w : A(3);\n#p : A(x) : " + depth + " > 0 : A(x - 1) F;\n");
    CAPTURE(c.reports());
    REQUIRE(c.outcome.bytecode);
    const std::vector<std::uint32_t>& code = c.outcome.bytecode->instructions;
    REQUIRE(std::find(code.begin(), code.end(), encode(Opcode::Swap, 0)) != code.end());
    check_counts(*c.outcome.bytecode, {1, 2, 3, 4, 4});
}

TEST_CASE("parameters, segments and bytes are predicted with the modules") {
    const GrowthPrediction prediction = predict_growth(ternary(), 11);
    const GenerationSize& last = prediction.low.back();
    // The 354,293 F, 88,574 !, 177,147 / and 265,719 & have one parameter each; codes take one
    // byte.
    CHECK(last.parameters.value == 354'293 + 88'574 + 177'147 + 265'719);
    CHECK(last.segments.value == 354'293);
    CHECK(last.bytes.value == last.modules.value + 4 * last.parameters.value);
    CHECK(predict_growth(weed(), 9).low.back().segments.value == 392'448);
}

TEST_CASE("stochastic systems have bounds that are reached, and an expected value") {
    const GrowthPrediction prediction = predict_growth(bush(), 10);
    CHECK(!prediction.exact);
    REQUIRE(prediction.has_expected);
    CHECK(prediction.expected_modules[10] == Approx(1'078'326).epsilon(1e-3));
    // The smallest word arises if every choice takes F[+F]F: 3^g F, and one + [ ] for each F that
    // was rewritten.
    std::uint64_t min_modules = 1;
    std::uint64_t max_modules = 1;
    std::uint64_t least_f = 1;
    std::uint64_t most_f = 1;
    for (std::uint32_t g = 0; g <= 10; ++g) {
        INFO("generation " << g);
        CHECK(to_text(prediction.low[g].modules) == to_text(exactly(min_modules)));
        CHECK(to_text(prediction.high[g].modules) == to_text(exactly(max_modules)));
        min_modules += 2 * least_f + 3 * least_f;
        least_f *= 3;
        max_modules += 4 * most_f + 6 * most_f;
        most_f *= 5;
    }
}

TEST_CASE("a stochastic system whose successors are equally long is exact") {
    check_counts(system("F", {"F : * ~ 0.5 : F+F", "F : * ~ 0.5 : F-F"}), {1, 3, 7, 15, 31});
}

TEST_CASE(
    "random parameters give bounds, without unchanged modules if conditions cover all cases") {
    const GrowthPrediction prediction = predict_growth(ageing("A({11, 12})"), 3);
    CHECK(!prediction.exact);
    CHECK(!prediction.has_expected);
    // Each A becomes 10 modules or one F; no A stays unchanged.
    CHECK(prediction.low[1].modules.value == 1);
    CHECK(prediction.high[1].modules.value == 10);
    CHECK(prediction.high[3].modules.value == 118);
    CHECK(prediction.low[1].segments.value == 1);
}

TEST_CASE("conditions that do not cover all cases may leave a module unchanged") {
    const GrowthPrediction prediction =
        predict_growth(system("A({0, 4})", {"A(x) : x > 2 : B B B", "A(x) : x < 2 : B B B"}), 2);
    CHECK(prediction.low[2].modules.value == 1);
    CHECK(prediction.high[2].modules.value == 3);
}

TEST_CASE("contexts may match or not") {
    const GrowthPrediction prediction =
        predict_growth(system("b a a", {"b < a : * : b", "b : * : a a"}), 1);
    CHECK(prediction.low[1].modules.value == 4);
    CHECK(prediction.high[1].modules.value == 4);
    CHECK(prediction.exact); // `a` stays or becomes `b`: one module in both cases
}

TEST_CASE("conditions over known parameters are decided beside formals of contexts") {
    check_counts(system("A(1)B(1)", {"A(x) < B(y) : y > 2 : B(y)B(y)"}), {2, 2, 2});
}

TEST_CASE("sequential rewriting makes one pass for each rule in order") {
    // The pass of B reads the word that the pass of A wrote.
    check_counts(system("A", {"A : * : B B", "B : * : A C A"}, RewritingMode::Sequential),
                 {1, 6, 26});
}

TEST_CASE("cyclic rewriting makes one pass a generation") {
    check_counts(system("A", {"A : * : B B", "B : * : A C A"}, RewritingMode::Cyclic),
                 {1, 2, 6, 10, 26});
}

TEST_CASE("predecessors of several modules match between zero times and as often as they fit") {
    const GrowthPrediction prediction =
        predict_growth(system("A B A B C", {"A B : * : A"}, RewritingMode::Sequential), 1);
    // The actual step is A B A B C -> A A C.
    CHECK(prediction.low[1].modules.value <= 3);
    CHECK(prediction.high[1].modules.value >= 3);
    CHECK(prediction.high[1].modules.value <= 7);
}

TEST_CASE("conditions may depend on the generation") {
    check_counts(system("A", {"A : step() < 3 : A B"}), {1, 2, 3, 4, 4, 4});
}

TEST_CASE("conditions may depend on the requested number of generations") {
    check_counts(system("A", {"A : step() < steps() - 1 : A B"}), {1, 2, 3, 3});
}

TEST_CASE("a word that no longer changes is detected") {
    const GrowthPrediction prediction =
        predict_growth(system("A(3)", {"A(x) : x > 0 : A(x - 1) B"}), 100'000'000);
    CHECK(prediction.exact);
    REQUIRE(prediction.unchanged_from);
    CHECK(*prediction.unchanged_from == 3);
    CHECK(prediction.low.size() == kMaxListedGenerations + 1);
    CHECK(prediction.low.back().modules.value == 4);
    REQUIRE(prediction.has_last);
    CHECK(prediction.last_high.modules.value == 4);
    CHECK(!predict_growth(koch(), 3).unchanged_from);
}

TEST_CASE("a generation after very many others is computed by matrix powers") {
    const GrowthPrediction line = predict_growth(system("A", {"A : * : A B"}), 4'294'967'294U);
    REQUIRE(line.has_last);
    CHECK(to_text(line.last_low.modules) == "4,294,967,295");
    CHECK(to_text(line.last_high.modules) == "4,294,967,295");

    const GrowthPrediction curve = predict_growth(koch(), 4'000'000'000U);
    REQUIRE(curve.has_last);
    CHECK(curve.last_low.modules.approximate_log2() == Approx(4e9 * 2.321928094887362 + 1));
}

TEST_CASE("a counter is predicted exactly for thousands of generations, then bounded") {
    const GrowthPrediction prediction =
        predict_growth(system("A(0)", {"A(x) : x < 9000 : A(x + 1) B"}), 9'500);
    CHECK(!prediction.exact);
    CHECK(prediction.low[4'000].modules.value == 4'001);
    CHECK(prediction.high[4'000].modules.value == 4'001);
    CHECK(prediction.low[9'500].modules.value <= 9'001);
    CHECK(prediction.high[9'500].modules.value >= 9'001);
}

TEST_CASE("the largest fitting generation is found with the production that grows") {
    const std::optional<GrowthLimit> limit =
        find_growth_end(koch(), 20, std::uint64_t{1} << 32).limit;
    REQUIRE(limit);
    CHECK(limit->exact);
    CHECK(limit->largest_fitting == 13);
    CHECK(to_text(limit->at_largest.modules) == "2,441,406,249");
    CHECK(to_text(limit->at_next.modules) == "12,207,031,249");
    REQUIRE(limit->has_requested);
    CHECK(to_text(limit->at_requested.modules) == "190,734,863,281,249");
    CHECK(limit->dominant == ProductionId{0});

    CHECK(!find_growth_end(koch(), 13, std::uint64_t{1} << 32).limit);
    const std::optional<GrowthLimit> weed_limit = find_growth_end(weed(), 30, 1'000'000).limit;
    REQUIRE(weed_limit);
    CHECK(weed_limit->largest_fitting == 8);
    CHECK(weed_limit->dominant == ProductionId{0}); // X: 18 modules each
    const std::optional<GrowthLimit> axiom = find_growth_end(ternary(), 3, 3).limit;
    REQUIRE(axiom);
    CHECK(axiom->largest_fitting == 0);
    CHECK(axiom->at_next.modules.value == 4);
}

TEST_CASE("a limit that is reached after very many generations is found") {
    const std::optional<GrowthLimit> limit =
        find_growth_end(system("A", {"A : * : A B"}), 4'294'967'294U, 3'000'000'000U).limit;
    REQUIRE(limit);
    CHECK(limit->largest_fitting == 2'999'999'999U);
    CHECK(limit->at_next.modules.value == 3'000'000'001U);
    CHECK(limit->dominant == ProductionId{0});
}

TEST_CASE("no generation exceeds the limit for certain if only the upper bound does") {
    CHECK(!find_growth_end(system("b a", {"b < a : * : a a"}), 1'000, 100).limit);
}

TEST_CASE("the generation from which the word stays the same is known unless a limit comes first") {
    const GrowthEnd still = find_growth_end(system("A", {"A : * : B", "B : * : C"}), 9, 100);
    REQUIRE(still.fixed_point);
    CHECK(still.fixed_point->generation == 2);
    CHECK(!still.fixed_point->is_empty);
    const GrowthEnd gone = find_growth_end(system("A", {"A : * : B", "B : * :"}), 9, 100);
    REQUIRE(gone.fixed_point);
    CHECK(gone.fixed_point->is_empty);
    const GrowthEnd large = find_growth_end(system("A", {"A : * : B B B"}), 9, 2);
    CHECK(large.limit);
    CHECK(!large.fixed_point);
}

} // namespace
} // namespace lsys
