#include "compiler/growth/growth.h"
#include "tests/compiler/bytecode_builder.h"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

namespace lsys {
namespace {

using test::apply;
using test::BytecodeBuilder;
using test::formal;
using test::leaf;
using test::number;
using test::TestWord;
using test::word;

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
    BytecodeBuilder builder;
    builder.axiom(word("F"));
    builder.rule("F", word("F + F - F - F + F"));
    return builder.finish();
}

Bytecode weed() {
    BytecodeBuilder builder;
    builder.axiom(word("X"));
    builder.rule("X", word("F - [ [ X ] + X ] + F [ + F X ] - X"));
    builder.rule("F", word("F F"));
    return builder.finish();
}

/// W3: parameters that no condition reads.
Bytecode ternary() {
    const TestWord f2{{"F", {number(2)}}};
    const auto turn = [](const char* name, float angle) {
        return TestWord{{name, {number(angle)}}};
    };
    BytecodeBuilder builder;
    builder.axiom(turn("!", 1.4F) + f2 + turn("/", 45) + word("A"));
    const TestWord branch = word("[") + turn("&", 22.5F) + f2 + word("A ]");
    builder.rule("A", turn("!", 1.4F) + f2 + branch + turn("/", 112.5F) + branch +
                          turn("/", 157.5F) + branch);
    builder.production({.predecessor = "F",
                        .parameters = 1,
                        .successor = {{"F", {apply(Opcode::Multiply, formal(0), number(1.1F))}}}});
    builder.production({.predecessor = "!",
                        .parameters = 1,
                        .successor = {{"!", {apply(Opcode::Multiply, formal(0), number(1.4F))}}}});
    return builder.finish();
}

Bytecode bush() {
    BytecodeBuilder builder;
    builder.axiom(word("F"));
    const auto add = [&](const char* successor, float weight) {
        builder.production({.predecessor = "F", .weight = weight, .successor = word(successor)});
    };
    add("F [ + F ] F [ - F ] F", 0.33F);
    add("F [ + F ] F", 0.33F);
    add("F [ - F ] F", 0.34F);
    return builder.finish();
}

/// W5: A(x) grows while x > 0. Where `drawn`, the axiom's parameter is not known.
Bytecode ageing(bool drawn) {
    const TestWord f{{"F", {number(1)}}};
    const TestWord next{{"A", {apply(Opcode::Subtract, formal(0), number(1))}}};
    const auto side = [&](const char* name) {
        return word("[") + TestWord{{name, {number(30)}}} + next + word("]");
    };
    BytecodeBuilder builder;
    builder.axiom({{"A", {drawn ? test::range(11, 12) : number(12)}}});
    builder.production({.predecessor = "A",
                        .parameters = 1,
                        .condition = apply(Opcode::Greater, formal(0), number(0)),
                        .successor = f + side("+") + side("-") + next});
    builder.production({.predecessor = "A",
                        .parameters = 1,
                        .condition = apply(Opcode::LessEqual, formal(0), number(0)),
                        .successor = f});
    return builder.finish();
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
    check_counts(ageing(false), {1, 10, 37, 118, 361, 1'090, 3'277, 9'838, 29'521, 88'570, 265'717,
                                 797'158, 2'391'481, 2'391'481});
}

TEST_CASE("parameters, segments and bytes are predicted with the modules") {
    const GrowthPrediction prediction = predict_growth(ternary(), 11);
    const GenerationSize& last = prediction.low.back();
    // F 354,293, ! 88,574, / 177,147 and & 265,719 have one parameter each; codes take one byte.
    CHECK(last.parameters.value == 354'293 + 88'574 + 177'147 + 265'719);
    CHECK(last.segments.value == 354'293);
    CHECK(last.bytes.value == last.modules.value + 4 * last.parameters.value);
    CHECK(predict_growth(weed(), 9).low.back().segments.value == 392'448);
}

TEST_CASE("stochastic systems have bounds that are reached, and an expectation") {
    const GrowthPrediction prediction = predict_growth(bush(), 10);
    CHECK(!prediction.exact);
    REQUIRE(prediction.has_expected);
    CHECK(prediction.expected_modules[10] == Approx(1'078'326).epsilon(1e-3));
    // The least word takes F[+F]F everywhere: 3^g F and as many + [ ] as F were rewritten.
    std::uint64_t least = 1;
    std::uint64_t most = 1;
    std::uint64_t least_f = 1;
    std::uint64_t most_f = 1;
    for (std::uint32_t g = 0; g <= 10; ++g) {
        INFO("generation " << g);
        CHECK(to_text(prediction.low[g].modules) == to_text(exactly(least)));
        CHECK(to_text(prediction.high[g].modules) == to_text(exactly(most)));
        least += 2 * least_f + 3 * least_f;
        least_f *= 3;
        most += 4 * most_f + 6 * most_f;
        most_f *= 5;
    }
}

TEST_CASE("a stochastic system whose successors are equally long is exact") {
    BytecodeBuilder builder;
    builder.axiom(word("F"));
    for (const char* successor : {"F + F", "F - F"}) {
        builder.production({.predecessor = "F", .weight = 0.5F, .successor = word(successor)});
    }
    check_counts(builder.finish(), {1, 3, 7, 15, 31});
}

TEST_CASE(
    "parameters that are drawn leave bounds, without a copied module where conditions cover all") {
    const GrowthPrediction prediction = predict_growth(ageing(true), 3);
    CHECK(!prediction.exact);
    CHECK(!prediction.has_expected);
    // Each A becomes 10 modules or one F, never stays.
    CHECK(prediction.low[1].modules.value == 1);
    CHECK(prediction.high[1].modules.value == 10);
    CHECK(prediction.high[3].modules.value == 118);
    CHECK(prediction.low[1].segments.value == 1);
}

TEST_CASE("conditions with a gap may leave a module as it is") {
    BytecodeBuilder builder;
    builder.axiom({{"A", {test::range(0, 4)}}});
    for (const Opcode comparison : {Opcode::Greater, Opcode::Less}) {
        builder.production({.predecessor = "A",
                            .parameters = 1,
                            .condition = apply(comparison, formal(0), number(2)),
                            .successor = word("B B B")});
    }
    const GrowthPrediction prediction = predict_growth(builder.finish(), 2);
    CHECK(prediction.low[2].modules.value == 1);
    CHECK(prediction.high[2].modules.value == 3);
}

TEST_CASE("contexts may match or not") {
    BytecodeBuilder builder;
    builder.axiom(word("b a a"));
    builder.production({.predecessor = "a", .successor = word("b"), .left = "b"});
    builder.production({.predecessor = "b", .successor = word("a a")});
    const GrowthPrediction prediction = predict_growth(builder.finish(), 1);
    CHECK(prediction.low[1].modules.value == 4);
    CHECK(prediction.high[1].modules.value == 4);
    CHECK(prediction.exact); // a stays or becomes b: one module either way
}

TEST_CASE("sequential rewriting makes a pass of each rule in turn") {
    BytecodeBuilder builder;
    builder.settings().rewriting = RewritingMode::Sequential;
    builder.axiom(word("A"));
    builder.rule("A", word("B B"));
    builder.rule("B", word("A C A"));
    // The pass of B reads what the pass of A wrote.
    check_counts(builder.finish(), {1, 6, 26});
}

TEST_CASE("cyclic rewriting makes one pass a generation") {
    BytecodeBuilder builder;
    builder.settings().rewriting = RewritingMode::Cyclic;
    builder.axiom(word("A"));
    builder.rule("A", word("B B"));
    builder.rule("B", word("A C A"));
    check_counts(builder.finish(), {1, 2, 6, 10, 26});
}

TEST_CASE("predecessors of several modules match from never to as often as they fit") {
    BytecodeBuilder builder;
    builder.settings().rewriting = RewritingMode::Sequential;
    builder.axiom(word("A B A B C"));
    builder.rule("A B", word("A"));
    const GrowthPrediction prediction = predict_growth(builder.finish(), 1);
    // A B A B C -> A A C in truth.
    CHECK(prediction.low[1].modules.value <= 3);
    CHECK(prediction.high[1].modules.value >= 3);
    CHECK(prediction.high[1].modules.value <= 7);
}

TEST_CASE("conditions may depend on the generation") {
    BytecodeBuilder builder;
    builder.axiom(word("A"));
    builder.production({.predecessor = "A",
                        .condition = apply(Opcode::Less, leaf(Opcode::Step), number(3)),
                        .successor = word("A B")});
    check_counts(builder.finish(), {1, 2, 3, 4, 4, 4});
}

TEST_CASE("conditions may depend on the number of generations asked for") {
    BytecodeBuilder builder;
    builder.use_steps();
    builder.axiom(word("A"));
    builder.production({.predecessor = "A",
                        .condition = apply(Opcode::Less, leaf(Opcode::Step),
                                           apply(Opcode::Subtract, leaf(Opcode::Steps), number(1))),
                        .successor = word("A B")});
    check_counts(builder.finish(), {1, 2, 3, 3});
}

TEST_CASE("a word that stays is found") {
    BytecodeBuilder builder;
    builder.axiom({{"A", {number(3)}}});
    builder.production(
        {.predecessor = "A",
         .parameters = 1,
         .condition = apply(Opcode::Greater, formal(0), number(0)),
         .successor =
             TestWord{{"A", {apply(Opcode::Subtract, formal(0), number(1))}}} + word("B")});
    const Bytecode code = builder.finish();
    const GrowthPrediction prediction = predict_growth(code, 100'000'000);
    CHECK(prediction.exact);
    REQUIRE(prediction.unchanged_from);
    CHECK(*prediction.unchanged_from == 3);
    CHECK(prediction.low.size() == kMaxListedGenerations + 1);
    CHECK(prediction.low.back().modules.value == 4);
    REQUIRE(prediction.has_last);
    CHECK(prediction.last_high.modules.value == 4);
    CHECK(!predict_growth(koch(), 3).unchanged_from);
}

TEST_CASE("the last of very many generations is found by powers") {
    BytecodeBuilder builder;
    builder.axiom(word("A"));
    builder.rule("A", word("A B"));
    const GrowthPrediction line = predict_growth(builder.finish(), 4'294'967'294U);
    REQUIRE(line.has_last);
    CHECK(to_text(line.last_low.modules) == "4,294,967,295");
    CHECK(to_text(line.last_high.modules) == "4,294,967,295");

    const GrowthPrediction curve = predict_growth(koch(), 4'000'000'000U);
    REQUIRE(curve.has_last);
    CHECK(curve.last_low.modules.approximate_log2() == Approx(4e9 * 2.321928094887362 + 1));
}

TEST_CASE("many generations of one condition are told apart up to a number, then bounded") {
    BytecodeBuilder builder;
    builder.axiom({{"A", {number(0)}}});
    builder.production(
        {.predecessor = "A",
         .parameters = 1,
         .condition = apply(Opcode::Less, formal(0), number(9'000)),
         .successor = TestWord{{"A", {apply(Opcode::Add, formal(0), number(1))}}} + word("B")});
    const Bytecode code = builder.finish();
    const GrowthPrediction prediction = predict_growth(code, 9'500);
    CHECK(!prediction.exact);
    CHECK(prediction.low[4'000].modules.value == 4'001);
    CHECK(prediction.high[4'000].modules.value == 4'001);
    CHECK(prediction.low[9'500].modules.value <= 9'001);
    CHECK(prediction.high[9'500].modules.value >= 9'001);
}

TEST_CASE("the largest fitting generation is found with the production that grows") {
    const std::optional<GrowthLimit> limit = find_growth_limit(koch(), 20, std::uint64_t{1} << 32);
    REQUIRE(limit);
    CHECK(limit->exact);
    CHECK(limit->largest_fitting == 13);
    CHECK(to_text(limit->at_largest.modules) == "2,441,406,249");
    CHECK(to_text(limit->at_next.modules) == "12,207,031,249");
    REQUIRE(limit->has_wanted);
    CHECK(to_text(limit->at_wanted.modules) == "190,734,863,281,249");
    CHECK(limit->dominant == ProductionId{0});

    CHECK(!find_growth_limit(koch(), 13, std::uint64_t{1} << 32));
    const std::optional<GrowthLimit> heavy = find_growth_limit(weed(), 30, 1'000'000);
    REQUIRE(heavy);
    CHECK(heavy->largest_fitting == 8);
    CHECK(heavy->dominant == ProductionId{0}); // X: 18 modules each
    const std::optional<GrowthLimit> axiom = find_growth_limit(ternary(), 3, 3);
    REQUIRE(axiom);
    CHECK(axiom->largest_fitting == 0);
    CHECK(axiom->at_next.modules.value == 4);
}

TEST_CASE("a limit that is reached after very many generations is found") {
    BytecodeBuilder builder;
    builder.axiom(word("A"));
    builder.rule("A", word("A B"));
    const std::optional<GrowthLimit> limit =
        find_growth_limit(builder.finish(), 4'294'967'294U, 3'000'000'000U);
    REQUIRE(limit);
    CHECK(limit->largest_fitting == 2'999'999'999U);
    CHECK(limit->at_next.modules.value == 3'000'000'001U);
    CHECK(limit->dominant == ProductionId{0});
}

TEST_CASE("a bound that grows only perhaps is no limit") {
    BytecodeBuilder builder;
    builder.axiom(word("b a"));
    builder.production({.predecessor = "a", .successor = word("a a"), .left = "b"});
    CHECK(!find_growth_limit(builder.finish(), 1'000, 100));
}

} // namespace
} // namespace lsys
