// SPDX-License-Identifier: MIT
#include "compiler/growth/condition_grid.h"
#include "tests/support/builder_text.h"

#include <catch2/catch.hpp>

#include <array>
#include <bit>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace lsys::analysis {
namespace {

struct CompiledConditions {
    std::vector<std::uint32_t> instructions;
    std::vector<ConditionView> views;
};

/// The instructions of conditions on the formals x and y, each followed by Test and End.
CompiledConditions compile_conditions(const std::vector<std::string>& conditions) {
    const test::NameTable names{{"x", 0}, {"y", 1}};
    const test::NameTable globals{{"c", 0}};
    std::uint32_t draws = 0;
    bool uses_steps = false;
    CompiledConditions compiled;
    for (const std::string& text : conditions) {
        const test::Instructions condition =
            test::compile_expression(text, {names, globals, draws, uses_steps});
        compiled.views.push_back({static_cast<std::uint32_t>(compiled.instructions.size()), 0});
        compiled.instructions.insert(compiled.instructions.end(), condition.begin(),
                                     condition.end());
        compiled.instructions.push_back(encode(Opcode::Test, 0));
        compiled.instructions.push_back(encode(Opcode::End, 0));
    }
    return compiled;
}

std::optional<ConditionGrid> grid_of(const CompiledConditions& compiled, std::uint32_t formals) {
    const std::vector<KnownValue> unknown(formals);
    return make_condition_grid(compiled.instructions, compiled.views, unknown, {}, 10'000);
}

std::optional<ConditionGrid> grid_of(const std::string& condition, std::uint32_t formals) {
    return grid_of(compile_conditions({condition}), formals);
}

std::vector<float> lows(const GridAxis& axis) {
    std::vector<float> result;
    for (const GridCell& cell : axis.cells) {
        result.push_back(cell.low);
    }
    return result;
}

const float kLowest = std::numeric_limits<float>::lowest();

float above(float value) {
    return std::nextafter(value, std::numeric_limits<float>::infinity());
}

TEST_CASE("order indices number the finite values without gaps") {
    CHECK(order_index(0.0F) == 0);
    CHECK(order_index(-0.0F) == 0);
    for (const float value : {1.0F, -1.0F, 0.5F, 1e-40F, -3e38F}) {
        CHECK(number_at(order_index(value)) == value);
        CHECK(number_at(order_index(value) + 1) == above(value));
    }
}

TEST_CASE("a comparison splits the range of its parameter between neighbouring numbers") {
    const auto less = grid_of("x < 2", 1);
    REQUIRE(less);
    REQUIRE(less->axes.size() == 1);
    CHECK(lows(less->axes[0]) == std::vector<float>{kLowest, 2.0F});

    const auto greater = grid_of("x > 2", 1);
    REQUIRE(greater);
    CHECK(lows(greater->axes[0]) == std::vector<float>{kLowest, above(2.0F)});

    const auto equal = grid_of("2 == x", 1);
    REQUIRE(equal);
    CHECK(lows(equal->axes[0]) == std::vector<float>{kLowest, 2.0F, above(2.0F)});
    CHECK(equal->axes[0].cells[1].high == 2.0F);
}

TEST_CASE("monotone expressions are split exactly where rounding changes them") {
    const auto grid = grid_of("0.1 * x - 1 >= 0", 1);
    REQUIRE(grid);
    REQUIRE(grid->axes[0].cells.size() == 2);
    const float cut = grid->axes[0].cells[1].low;
    CHECK(0.1F * cut - 1.0F >= 0.0F);
    const float before = number_at(order_index(cut) - 1);
    CHECK(0.1F * before - 1.0F < 0.0F);

    const auto falling = grid_of("3 - x < 1", 1);
    REQUIRE(falling);
    CHECK(3.0F - falling->axes[0].cells[1].low < 1.0F);
    CHECK(3.0F - falling->axes[0].cells[0].high >= 1.0F);
}

TEST_CASE(
    "several parameters make a product grid, and compared parameters are tried in every order") {
    const auto product = grid_of("x < 2 && y > 3", 2);
    REQUIRE(product);
    CHECK(product->point_count() == 4);

    const auto compared = grid_of("x < y", 2);
    REQUIRE(compared);
    CHECK(compared->axes[0].compared);
    bool less = false;
    bool equal = false;
    bool greater = false;
    std::vector<KnownValue> values(2);
    for (std::uint64_t point = 0; point < compared->point_count(); ++point) {
        compared->set_parameters(point, values);
        less = less || values[0].value < values[1].value;
        equal = equal || values[0].value == values[1].value;
        greater = greater || values[0].value > values[1].value;
    }
    CHECK(less);
    CHECK(equal);
    CHECK(greater);
}

TEST_CASE("conditions of other forms have no grid") {
    CHECK(!grid_of("sin(x) < 0", 1));
    CHECK(!grid_of("mod(x, 2) == 0", 1));
    CHECK(!grid_of("x + y < 0", 2));
    CHECK(!grid_of("x < step()", 1));
    CHECK(!grid_of("x < c", 1));
}

TEST_CASE("a deeper right operand, computed first, gives the same splits and values") {
    const auto op = [](Opcode opcode, std::uint32_t operand = 0) {
        return encode(opcode, operand);
    };
    const auto three = std::bit_cast<std::uint32_t>(3.0F);
    // `falling`: 3 - x * 3, else x * 3 - 3. `swapped`: the right operand is computed first.
    const auto side = [&](bool swapped, bool falling) {
        const test::Instructions constant{op(Opcode::Literal), three};
        const test::Instructions product{op(Opcode::Formal), op(Opcode::Literal), three,
                                         op(Opcode::Multiply)};
        test::Instructions code = falling != swapped ? constant : product;
        const test::Instructions& second = falling != swapped ? product : constant;
        code.insert(code.end(), second.begin(), second.end());
        if (swapped) {
            code.push_back(op(Opcode::Swap));
        }
        code.push_back(op(Opcode::Subtract));
        return code;
    };
    for (const bool falling : {false, true}) {
        std::vector<std::vector<float>> cuts;
        for (const bool swapped : {false, true}) {
            CompiledConditions compiled{side(swapped, falling), {{0, 0}}};
            compiled.instructions.insert(compiled.instructions.end(),
                                         {op(Opcode::Test), op(Opcode::End)});
            const std::vector<KnownValue> two{{2.0F, true}};
            CHECK(Evaluator().run(compiled.instructions, 0, {two, {}, {}}).value ==
                  (falling ? -3.0F : 3.0F));
            const auto grid = grid_of(compiled, 1);
            REQUIRE(grid);
            cuts.push_back(lows(grid->axes.at(0)));
        }
        CHECK(cuts[0].size() == 3);
        CHECK(cuts[0] == cuts[1]);
    }
}

TEST_CASE("known parameters are constants") {
    const CompiledConditions compiled = compile_conditions({"x < y"});
    const std::vector<KnownValue> values{{}, {5.0F, true}};
    const auto grid = make_condition_grid(compiled.instructions, compiled.views, values, {}, 100);
    REQUIRE(grid);
    REQUIRE(grid->axes.size() == 1);
    CHECK(lows(grid->axes[0]) == std::vector<float>{kLowest, 5.0F});
}

TEST_CASE("a grid that would be too large is not made") {
    std::vector<std::string> conditions;
    for (int i = 0; i < 200; ++i) {
        conditions.push_back("x == " + std::to_string(i));
        conditions.push_back("y == " + std::to_string(i));
    }
    CHECK(!grid_of(compile_conditions(conditions), 2));
}

// --- every condition has the same truth value in a whole cell

struct Random {
    std::mt19937 engine;
    std::uint32_t operator()() { return static_cast<std::uint32_t>(engine()); }
};

std::string random_side(Random& random, std::uint32_t formals) {
    std::string side = random() % formals == 0 ? "x" : "y";
    for (std::uint32_t i = random() % 3; i > 0; --i) {
        const std::string constant =
            std::to_string((static_cast<float>(random() % 17) - 8.0F) / 3.0F + 0.1F);
        const std::string all[]{"(" + side + ") + " + constant,
                                constant + " - (" + side + ")",
                                "(" + side + ") * " + constant,
                                "(" + side + ") / " + constant,
                                "-(" + side + ")",
                                "floor(" + side + ")",
                                "round(" + side + ")"};
        side = all[random() % std::size(all)];
    }
    return side;
}

std::string random_condition(Random& random, std::uint32_t formals, int depth) {
    if (depth > 0 && random() % 3 != 0) {
        const char* both = random() % 2 == 0 ? ") && (" : ") || (";
        const std::string left = random_condition(random, formals, depth - 1);
        const std::string condition =
            "(" + left + both + random_condition(random, formals, depth - 1) + ")";
        return random() % 4 == 0 ? "!(" + condition + ")" : condition;
    }
    const std::string comparison =
        std::array{" < ", " <= ", " > ", " >= ", " == ", " != "}[random() % 6];
    if (formals > 1 && random() % 4 == 0) {
        return "x" + comparison + "y";
    }
    return random_side(random, formals) + comparison +
           std::to_string(static_cast<float>(random() % 9) / 2.0F);
}

TEST_CASE("a condition has one truth value in each cell and in each order of compared parameters") {
    Random random{std::mt19937(20'240'607)};
    Evaluator evaluator;
    int grids = 0;
    for (int round = 0; round < 300; ++round) {
        const std::uint32_t formals = 1 + random() % 2;
        const CompiledConditions compiled =
            compile_conditions({random_condition(random, formals, 2)});
        const std::optional<ConditionGrid> grid = grid_of(compiled, formals);
        if (!grid) {
            continue;
        }
        ++grids;
        const auto holds = [&](const std::vector<KnownValue>& values) {
            const KnownValue value = evaluator.run(compiled.instructions, 0, {values, {}, {}});
            REQUIRE(value.known);
            return value.value != 0.0F;
        };
        std::vector<KnownValue> values(formals, KnownValue{0.0F, true});
        std::vector<KnownValue> inside(formals, KnownValue{0.0F, true});
        for (int probe = 0; probe < 50; ++probe) {
            // Take random values and find the grid point that stands for them: its cells contain
            // the values, and compared parameters have the same order.
            for (KnownValue& value : inside) {
                value.value = random() % 2 == 0
                                  ? static_cast<float>(random() % 21) / 2.0F - 5.0F
                                  : number_at(static_cast<std::int32_t>(random() % 0x80000000U));
                value.value = std::isfinite(value.value) ? value.value : 0.0F;
            }
            bool met = false;
            for (std::uint64_t point = 0; point < grid->point_count() && !met; ++point) {
                grid->set_parameters(point, values);
                met = true;
                bool compared = false;
                for (std::size_t axis = 0; axis < grid->axes.size(); ++axis) {
                    const GridAxis& row = grid->axes[axis];
                    const GridCell& cell =
                        row.cells[row.samples[grid->sample_of(point, axis)].cell];
                    const float value = inside[row.parameter].value;
                    met = met && cell.low <= value && value <= cell.high;
                    compared = compared || row.compared;
                }
                if (compared && formals == 2) {
                    const auto order = [](const std::vector<KnownValue>& v) {
                        return v[0].value < v[1].value ? -1 : v[0].value > v[1].value ? 1 : 0;
                    };
                    met = met && order(values) == order(inside);
                }
                if (met) {
                    CHECK(holds(values) == holds(inside));
                }
            }
            CHECK(met);
        }
    }
    CHECK(grids > 250);
}

} // namespace
} // namespace lsys::analysis
