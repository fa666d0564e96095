// SPDX-License-Identifier: MIT
// Choices and random ranges: their draw numbers and frequencies.
#include "runtime/base/random.h"
#include "runtime/derive/derive.h"
#include "tests/support/bytecode_builder.h"
#include "tests/support/derived.h"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <string>
#include <vector>

using namespace lsys;
using test::BytecodeBuilder;
using test::derived;
using test::derived_every_way;

namespace {

std::string repeated(const std::string& text, int count) {
    std::string all;
    for (int i = 0; i < count; ++i) {
        all += text;
    }
    return all;
}

float u_at(std::uint64_t seed, std::uint32_t generation, std::uint64_t position, std::uint32_t n) {
    return DrawSource(seed, generation, position).draw(n);
}

} // namespace

TEST_CASE("a choice compares draw 0 at the position of the module with running sums") {
    BytecodeBuilder builder;
    builder.axiom(repeated("+", 50));
    builder.production("p : + : ~ 0.2 : a").production("q : + : ~ 0.3 : b");
    builder.production("r : + : ~ 0.5 : c");
    builder.settings.print_letters = true;
    const std::uint64_t seed = 42;
    std::string expected;
    for (std::uint64_t position = 0; position < 50; ++position) {
        const float u = u_at(seed, 0, position, 0);
        const float sum = 0.2F + 0.3F + 0.5F;
        const float first = 0.2F / sum;
        const float second = first + 0.3F / sum;
        expected += first > u ? "a" : second > u ? "b" : "c";
    }
    CHECK(derived_every_way(builder.build(), 1, seed) == expected);
}

TEST_CASE("only productions whose condition holds take part") {
    BytecodeBuilder builder;
    builder.fold = GENERATE(true, false);
    builder.axiom(repeated("+(1)+(2)", 40));
    builder.production("p : +(x) : x < 2 ~ 0.5 : a(x)");
    builder.production("q : +(x) : * ~ 0.5 : b(x)");
    builder.production("r : +(x) : x > 1 ~ 0.25 : c(x)");
    std::string expected;
    for (std::uint64_t position = 0; position < 80; ++position) {
        const float u = u_at(7, 0, position, 0);
        const bool is_one = position % 2 == 0;
        const float first = is_one ? 0.5F / (0.5F + 0.5F) : 0.5F / (0.5F + 0.25F);
        expected += is_one ? (first > u ? "a(1)" : "b(1)") : (first > u ? "b(2)" : "c(2)");
    }
    CHECK(derived_every_way(builder.build(), 1, 7) == expected);
}

TEST_CASE("a production without probability ends the search unless a stochastic one came first") {
    BytecodeBuilder builder;
    builder.axiom(repeated("A ", 30));
    builder.settings.print_letters = true;
    SECTION("certain first") {
        builder.production("p : A : * : a").production("q : A : ~ 1 : b");
        CHECK(derived_every_way(builder.build(), 1, 3) == repeated("a", 30));
    }
    SECTION("certain between two of the group") {
        builder.production("p : A : ~ 0.5 : a").production("q : A : * : b");
        builder.production("r : A : ~ 0.5 : c");
        std::string expected;
        for (std::uint64_t position = 0; position < 30; ++position) {
            expected += 0.5F > u_at(3, 0, position, 0) ? "a" : "c";
        }
        CHECK(derived_every_way(builder.build(), 1, 3) == expected);
    }
    SECTION("alone in its group") {
        builder.production("p : A : ~ 0.5 : a");
        CHECK(derived_every_way(builder.build(), 1, 3) == repeated("a", 30));
    }
}

TEST_CASE("ranges are numbered after the choice, in the order of closing braces") {
    BytecodeBuilder builder;
    builder.fold = GENERATE(true, false);
    const std::uint64_t seed = 99;
    const auto at = [&](std::uint32_t position, std::uint32_t number) {
        return draw_in_range(0.0F, 1.0F, u_at(seed, 0, position, number));
    };
    SECTION("without probability from 0") {
        builder.axiom("A A");
        builder.production("p : A : * : f({0,1}, {0,1}) f({0,1},{0,1}) g({0,{0,1}}) f({0,1},0)");
        const Bytecode bytecode = builder.build();
        DeriveOptions options;
        options.seed = seed;
        options.generations = 1;
        Derivation derivation(bytecode, options);
        REQUIRE(derivation.start() == std::nullopt);
        REQUIRE(derivation.step() == std::nullopt);
        const std::span<const float> values = derivation.word().parameters();
        REQUIRE(values.size() == 14);
        for (std::uint32_t module = 0; module < 2; ++module) {
            const std::span<const float> module_values = values.subspan(module * 7, 7);
            for (std::uint32_t number = 0; number < 4; ++number) {
                CHECK(module_values[number] == at(module, number));
            }
            // The inner range closes first, so it takes the first number.
            CHECK(module_values[4] == draw_in_range(0.0F, at(module, 4), u_at(seed, 0, module, 5)));
            CHECK(module_values[5] == at(module, 6));
            CHECK(module_values[6] == 0.0F);
        }
        static_cast<void>(derived_every_way(bytecode, 1, seed));
    }
    SECTION("with probability from 1") {
        builder.axiom("A A");
        builder.production("p : A : ~ 1 : f({0,1})");
        const Bytecode bytecode = builder.build();
        DeriveOptions options;
        options.seed = seed;
        options.generations = 1;
        Derivation derivation(bytecode, options);
        REQUIRE(derivation.start() == std::nullopt);
        REQUIRE(derivation.step() == std::nullopt);
        CHECK(derivation.word().parameters()[0] == at(0, 1));
        CHECK(derivation.word().parameters()[1] == at(1, 1));
    }
}

TEST_CASE("later generations draw by their own age and positions") {
    BytecodeBuilder builder;
    builder.axiom("A");
    builder.production("p : A : ~ 0.5 : A A").production("q : A : ~ 0.5 : B A");
    builder.production("r : B : ~ 0.4 : B").production("s : B : ~ 0.6 : A B");
    const Bytecode bytecode = builder.build();
    std::string word = "A";
    for (std::uint32_t generation = 0; generation < 9; ++generation) {
        std::string next;
        for (std::uint64_t position = 0; position < word.size(); ++position) {
            const float u = u_at(5, generation, position, 0);
            if (word[position] == 'A') {
                next += 0.5F > u ? "AA" : "BA";
            } else {
                const float sum = 0.4F + 0.6F;
                next += 0.4F / sum > u ? "B" : "AB";
            }
        }
        word = next;
    }
    BytecodeBuilder letters = builder;
    letters.settings.print_letters = true;
    CHECK(derived_every_way(letters.build(), 9, 5) == word);
    CHECK(derived(bytecode, 9, 5) != derived(bytecode, 9, 6));
}

TEST_CASE("all modules of a rule share one choice per generation") {
    BytecodeBuilder builder;
    builder.settings.choice = ChoiceScope::Generation;
    builder.settings.print_letters = true;
    builder.axiom("A A B A B");
    builder.production("p : A : ~ 0.5 : a").production("q : B : ~ 0.5 : c");
    builder.production("r : A : ~ 0.5 : b").production("s : B : ~ 0.5 : d");
    const Bytecode bytecode = builder.build();
    int different = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const float a = u_at(seed, 0, ~std::uint64_t{0}, 0);
        const float b = u_at(seed, 0, ~std::uint64_t{0} - 1, 0);
        const std::string x = 0.5F > a ? "a" : "b";
        const std::string y = 0.5F > b ? "c" : "d";
        CHECK(derived_every_way(bytecode, 1, seed) == x + x + y + x + y);
        different += (x == "a") != (y == "c") ? 1 : 0;
    }
    CHECK(different > 0);
}

TEST_CASE(
    "the shared choice of a generation selects among the matching productions of each module") {
    BytecodeBuilder builder;
    builder.fold = GENERATE(true, false);
    builder.settings.choice = ChoiceScope::Generation;
    builder.axiom("A(1)A(2)A(1)A(2)");
    builder.production("p : A(x) : x < 2 ~ 0.5 : a({0,1})");
    builder.production("q : A(x) : * ~ 0.5 : b");
    builder.production("r : A(x) : x > 1 ~ 0.5 : c");
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        const float u = u_at(seed, 0, ~std::uint64_t{0}, 0);
        const std::string text = derived_every_way(builder.build(), 1, seed);
        if (0.5F > u) {
            // Without a choice, ranges are numbered from 0.
            BytecodeBuilder plain;
            plain.axiom("x x x x").production("p : x : * : a({0,1})");
            const std::string draws = derived(plain.build(), 1, seed);
            const std::string first = draws.substr(0, draws.find(')') + 1);
            CHECK(text.substr(0, first.size() + 1) == first + "b");
        } else {
            CHECK(text == "b c b c");
        }
    }
}

TEST_CASE("constants and the axiom are drawn once, by the number of their range") {
    BytecodeBuilder builder;
    builder.global("angle", "{10, 20} + {0, 1}").parameter("width", "{1, 2}", 0.0F, 5.0F);
    builder.axiom("F(angle, width) G({5, 6})").production("p : F(x,y) : * : F(x,angle)");
    const Bytecode bytecode = builder.build();
    const auto draw = [](std::uint64_t position, float minimum, float maximum) {
        return draw_in_range(minimum, maximum, u_at(11, kStartGeneration, position, 0));
    };
    DeriveOptions options;
    options.seed = 11;
    Derivation derivation(bytecode, options);
    REQUIRE(derivation.start() == std::nullopt);
    const float angle = draw(0, 10.0F, 20.0F) + draw(1, 0.0F, 1.0F);
    const float width = draw(2, 1.0F, 2.0F);
    CHECK(derivation.globals() == std::vector<float>{angle, width});
    const std::span<const float> values = derivation.word().parameters();
    CHECK(std::vector<float>(values.begin(), values.end()) ==
          std::vector<float>{angle, width, draw(3, 5.0F, 6.0F)});
    REQUIRE(derivation.step() == std::nullopt);
    CHECK(derivation.word().parameters()[1] == angle);
}

TEST_CASE("frequencies of choices over 100,000 draws") {
    const std::array<double, 4> weights{0.1, 0.2, 0.3, 0.4};
    BytecodeBuilder builder;
    builder.settings.print_letters = true;
    builder.axiom(repeated("+", 1000));
    builder.production("p : + : ~ 0.1 : a").production("q : + : ~ 0.2 : b");
    builder.production("r : + : ~ 0.3 : c").production("s : + : ~ 0.4 : d");
    const Bytecode bytecode = builder.build();
    std::array<double, 4> seen{};
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        for (const char letter : derived(bytecode, 1, seed)) {
            ++seen[static_cast<std::size_t>(letter - 'a')];
        }
    }
    double chi_square = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
        const double expected = 100'000.0 * weights[i];
        chi_square += (seen[i] - expected) * (seen[i] - expected) / expected;
    }
    CHECK(chi_square < 16.27); // three degrees of freedom, significance 0.001
}

TEST_CASE("ranges are uniform over 100,000 draws") {
    BytecodeBuilder builder;
    builder.axiom(repeated("+", 1000));
    builder.production("p : + : * : a({-2, 2})");
    const Bytecode bytecode = builder.build();
    std::array<double, 16> bins{};
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        DeriveOptions options;
        options.seed = seed;
        options.generations = 1;
        options.threads = 1;
        Derivation derivation(bytecode, options);
        REQUIRE(derivation.start() == std::nullopt);
        REQUIRE(derivation.step() == std::nullopt);
        for (const float value : derivation.word().parameters()) {
            const double place = (static_cast<double>(value) + 2.0) * 4.0;
            REQUIRE((place >= 0.0 && place < 16.0));
            ++bins[static_cast<std::size_t>(place)];
        }
    }
    double chi_square = 0.0;
    for (const double count : bins) {
        chi_square += (count - 6250.0) * (count - 6250.0) / 6250.0;
    }
    CHECK(chi_square < 37.7); // fifteen degrees of freedom, significance 0.001
}
