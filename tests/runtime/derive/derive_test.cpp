// SPDX-License-Identifier: MIT
// Parallel rewriting: one generation, for every kind of module and production.
#include "runtime/derive/derive.h"
#include "tests/support/bytecode_builder.h"
#include "tests/support/derived.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <span>
#include <string>
#include <vector>

using namespace lsys;
using test::BytecodeBuilder;
using test::derived;
using test::derived_every_way;

namespace {

std::vector<std::uint64_t> counts(const Bytecode& bytecode, std::uint32_t generations) {
    DeriveOptions options;
    options.generations = generations;
    options.threads = 1;
    Derivation derivation(bytecode, options);
    REQUIRE(derivation.start() == std::nullopt);
    std::vector<std::uint64_t> all{derivation.word().module_count()};
    for (std::uint32_t i = 0; i < generations; ++i) {
        REQUIRE(derivation.step() == std::nullopt);
        all.push_back(derivation.word().module_count());
    }
    CHECK(derivation.check_brackets() == std::nullopt);
    return all;
}

} // namespace

TEST_CASE("the published numbers of modules") {
    SECTION("Koch curve") {
        BytecodeBuilder builder;
        builder.axiom("F").production("p : F : * : F+F-F-F+F");
        CHECK(counts(builder.build(), 9) == std::vector<std::uint64_t>{1, 9, 49, 249, 1249, 6249,
                                                                       31249, 156249, 781249,
                                                                       3906249});
    }
    SECTION("weed") {
        BytecodeBuilder builder;
        builder.axiom("X").production("p : X : * : F-[[X]+X]+F[+F X]-X");
        builder.production("q : F : * : F F");
        CHECK(counts(builder.build(), 9) == std::vector<std::uint64_t>{1, 18, 89, 379, 1551, 6263,
                                                                       25159, 100839, 403751,
                                                                       1615783});
    }
    SECTION("ternary tree with parameters") {
        BytecodeBuilder builder;
        builder.fold = GENERATE(true, false);
        builder.axiom("!(1.4)F(2)/(45)A");
        builder.production("p : A : * : !(1.4)F(2)[&(22.5)F(2)A]/(112.5)[&(22.5)F(2)A]/(157.5)"
                           "[&(22.5)F(2)A]");
        builder.production("q : F(l) : * : F(l*1.1)").production("r : !(w) : * : !(w*1.4)");
        CHECK(counts(builder.build(), 9) ==
              std::vector<std::uint64_t>{4, 22, 76, 238, 724, 2182, 6556, 19678, 59044, 177142});
    }
    SECTION("conditions on a countdown") {
        BytecodeBuilder builder;
        builder.axiom("A(12)");
        builder.production("p : A(x) : x > 0 : F(1)[+(30)A(x-1)][-(30)A(x-1)]A(x-1)");
        builder.production("q : A(x) : x <= 0 : F(1)");
        const std::vector<std::uint64_t> expected{
            1, 10, 37, 118, 361, 1090, 3277, 9838, 29521, 88570, 265717, 797158, 2391481, 2391481};
        CHECK(counts(builder.build(), 13) == expected);
    }
    SECTION("anabaena") {
        BytecodeBuilder builder;
        builder.axiom("al");
        builder.production("a : al : * : al br").production("b : br : * : al");
        const Bytecode bytecode = builder.build();
        CHECK(derived(bytecode, 1, 0) == "al br");
        CHECK(derived(bytecode, 5, 0) == "al br al al br al br al al br al al br");
    }
}

TEST_CASE("modules are copied, rewritten and erased") {
    BytecodeBuilder builder;
    builder.axiom("a b c [ d ] e");
    builder.production("p : a : * : a a").production("q : c : * : ");
    CHECK(derived_every_way(builder.build(), 3, 0) == "a a a a a a a a b[d]e");
}

TEST_CASE("a word may become empty and stays so") {
    BytecodeBuilder builder;
    builder.axiom("a a").production("p : a : * : ");
    CHECK(derived_every_way(builder.build(), 3, 0).empty());
}

TEST_CASE("modules with different numbers of parameters are different") {
    BytecodeBuilder builder;
    builder.axiom("A A(1) A(1,2)");
    builder.production("p : A(x) : * : A(x+1) B");
    CHECK(derived_every_way(builder.build(), 2, 0) == "A A(3)B B A(1,2)");
}

TEST_CASE("the first production that matches is taken") {
    BytecodeBuilder builder;
    builder.axiom("A(1)A(2)A(3)A(4)");
    builder.production("p : A(x) : x < 2 : B(x)");
    builder.production("q : A(x) : x < 4 && x >= 2 : C(x)");
    builder.production("r : A(x) : x == 3 : D(x)");
    CHECK(derived_every_way(builder.build(), 1, 0) == "B(1)C(2)C(3)A(4)");
}

TEST_CASE("conditions and arguments of every form") {
    BytecodeBuilder builder;
    builder.fold = GENERATE(true, false);
    SECTION("specialised and general forms give the arithmetic result") {
        builder.axiom("A(3)A(-3)A(0)A(0.1)");
        builder.production("p : A(x) : * : B(x)B(x*1.1)B(x-1)B(2*x+1)B(-x)B(x/4)B(x/3)B(7-x)"
                           "B(x*x)B(abs(x))B(-(x+1))");
        const std::string text = derived_every_way(builder.build(), 1, 0);
        CHECK(text.substr(0, text.find("B(-3)B(-3.3")) ==
              "B(3)B(3.3000002)B(2)B(7)B(-3)B(0.75)B(1)B(4)B(9)B(3)B(-4)");
        CHECK(text.find("B(0)B(0)B(-1)B(1)B(-0)B(0)B(0)B(7)B(0)B(0)B(-1)") != std::string::npos);
        CHECK(text.find("B(0.1)B(0.11000001)B(-0.9)B(1.2)B(-0.1)B(0.025)B(0.033333335)B(6.9)") !=
              std::string::npos);
    }
    SECTION("zeros keep their signs") {
        builder.axiom("A(1)A(-1)");
        builder.production("p : A(x) : * : B(x*0)B(x*-0.0)B(-0.0)B(x-x)B(0-x*0)B(0*x)");
        CHECK(derived_every_way(builder.build(), 2, 0) ==
              "B(0)B(-0)B(-0)B(0)B(0)B(0)B(-0)B(0)B(-0)B(0)B(0)B(-0)");
    }
    SECTION("comparisons, negations and connectives") {
        builder.axiom("A(1)A(2)A(3)A(4)A(5)");
        builder.production("p : A(x) : 2 < x && !(x == 3) && x*2 <= 8 : four(x)");
        builder.production("q : A(x) : x == 1 || x == 5 : end(x)");
        builder.production("r : A(x) : 3 > x : two(x)");
        builder.production("s : A(x) : x != 0 : three(x)");
        CHECK(derived_every_way(builder.build(), 1, 0) == "end(1)two(2)three(3)four(4)end(5)");
    }
    SECTION("several factors and summands apply one after the other") {
        builder.axiom("A(1)A(-2)");
        const auto [value, expected] =
            GENERATE(table<std::string, std::string>({{"x*2*3", "B(6)B(-12)"},
                                                      {"x/2*5", "B(2.5)B(-5)"},
                                                      {"2*(3*x)", "B(6)B(-12)"},
                                                      {"x*3/2", "B(1.5)B(-3)"},
                                                      {"(x+1)*2", "B(4)B(-2)"},
                                                      {"x*2+1-4", "B(-1)B(-7)"},
                                                      {"-x*3", "B(-3)B(6)"},
                                                      {"-(x*3)", "B(-3)B(6)"}}));
        builder.production("p : A(x) : * : B(" + value + ")");
        CHECK(derived_every_way(builder.build(), 1, 0) == expected);
    }
    SECTION("a bare value is a condition") {
        builder.axiom("A(0)A(2)");
        builder.production("p : A(x) : x : B");
        CHECK(derived_every_way(builder.build(), 1, 0) == "A(0)B");
    }
}

TEST_CASE("modules and successors with many parameters") {
    BytecodeBuilder builder;
    builder.fold = GENERATE(true, false);
    builder.axiom("A(1,2,3)B(1,2,3,4,5,6)C(9)");
    builder.production("p : A(x,y,z) : * : A(z,x,y)C(x)C(y+z)");
    builder.production("q : B(a,b,c,d,e,f) : a < 6 : B(b,c,d,e,f,a+6)");
    CHECK(derived_every_way(builder.build(), 3, 0) ==
          "A(1,2,3)C(2)C(4)C(3)C(3)C(1)C(5)B(4,5,6,7,8,9)C(9)");
}

TEST_CASE("successors longer than a wide store") {
    std::string successor = "A";
    for (int i = 0; i < 70; ++i) {
        successor += " b c(1) d(x+" + std::to_string(i) + ")";
    }
    BytecodeBuilder builder;
    builder.axiom("A(0)A");
    builder.production("p : A(x) : * : A(x) " + successor);
    builder.production("q : A : * : A b");
    const std::string text = derived_every_way(builder.build(), 4, 0);
    CHECK(std::count(text.begin(), text.end(), 'd') == 4 * 70);
    CHECK(std::count(text.begin(), text.end(), 'b') == 4 * 70 + (3 + 2 + 1) + 4);
}

TEST_CASE("threads keep to their own chunks of a word") {
    // Wide stores write more than a module needs. At the end of a chunk they must not reach into
    // the next one, which another thread has begun at the same time.
    constexpr std::uint32_t kChunk = 64; // modules
    const auto axiom_of = [](const std::string& marker) {
        std::string axiom;
        for (std::uint32_t i = 0; i < 2000 * kChunk; ++i) {
            axiom += i % (kChunk / 2) == 0 ? marker : "F ";
        }
        return axiom;
    };
    BytecodeBuilder builder;
    builder.fold = false;
    builder.production("q : F : * : G").production("r : G : * : F");
    DeriveOptions options;
    options.generations = 60;
    options.threads = 2;
    options.chunk_modules = kChunk;
    SECTION("parameters") {
        builder.axiom(axiom_of("A(1) ")).production("p : A(x) : x > 0 : A(x+1)");
        const Bytecode bytecode = builder.build();
        Derivation derivation(bytecode, options);
        REQUIRE(derivation.derive() == std::nullopt);
        const std::span<const float> parameters = derivation.word().parameters();
        REQUIRE(parameters.size() == 4000);
        CHECK(std::count(parameters.begin(), parameters.end(), 61.0F) == 4000);
    }
    SECTION("codes of two bytes") {
        // So many codes prevent a census, with which one thread would write the whole word.
        builder.axiom(axiom_of("B ")).unused_symbols(5000);
        const Bytecode bytecode = builder.build();
        Derivation derivation(bytecode, options);
        REQUIRE(derivation.derive() == std::nullopt);
        // After an even number of generations the word is the axiom.
        const bool is_axiom =
            test::text_of(bytecode, derivation.word()) == test::derived(bytecode, 0, 0);
        CHECK(is_axiom);
    }
}

TEST_CASE("words of wider codes") {
    BytecodeBuilder builder;
    builder.fold = GENERATE(true, false);
    builder.unused_symbols(GENERATE(250u, 300u, 65'530u, 66'000u));
    builder.axiom("A(3)[B]C");
    builder.production("p : A(x) : x > 0 : F(x)[A(x-1)]A(x-1)");
    builder.production("q : B : ~ 0.5 : B B").production("r : B : ~ 0.5 : C");
    const Bytecode bytecode = builder.build();
    const std::string text = derived(bytecode, 3, 1);
    CHECK(text.substr(0, 30) == "F(3)[F(2)[F(1)[A(0)]A(0)]F(1)[");
    // The word does not depend on the width of codes.
    BytecodeBuilder narrow = builder;
    narrow.unused_symbols(0);
    CHECK(derived_every_way(bytecode, 3, 1) == derived(narrow.build(), 3, 1));
}

TEST_CASE("more candidates than a byte can number") {
    BytecodeBuilder builder;
    std::string axiom;
    std::string expected;
    for (int i = 0; i < 300; ++i) {
        const std::string number = std::to_string(i);
        axiom += "A(" + number + ")";
        builder.production("p" + number + " : A(x) : x == " + number + " : B(" + number + ")");
        expected += "B(" + number + ")";
    }
    builder.fold = false;
    builder.axiom(axiom);
    CHECK(derived_every_way(builder.build(), 1, 0) == expected);
}

TEST_CASE("step and steps") {
    BytecodeBuilder builder;
    builder.fold = GENERATE(true, false);
    builder.axiom("A(0)");
    builder.production("p : A(x) : step() < 2 : A(x+step()) B(steps())");
    builder.production("q : A(x) : * : C(step()*10)");
    const Bytecode bytecode = builder.build();
    CHECK(derived_every_way(bytecode, 1, 0) == "A(0)B(1)");
    CHECK(derived_every_way(bytecode, 2, 0) == "A(1)B(2)B(2)");
    CHECK(derived_every_way(bytecode, 4, 0) == "C(20)B(4)B(4)");
}

TEST_CASE("runs of modules without a production are copied as a block") {
    std::string row;
    for (int i = 0; i < 200; ++i) {
        row += "+(7)[g(1.5,2)]";
    }
    BytecodeBuilder builder;
    builder.fold = GENERATE(true, false);
    builder.axiom(row + "A" + row);
    builder.production("p : A : * : A b");
    const bool unchanged = derived_every_way(builder.build(), 3, 0) == row + "A b b b" + row;
    CHECK(unchanged);
}

TEST_CASE("long runs of modules that nothing rewrites keep their parameters") {
    // Chunks of a few modules are rewritten without the mask of active modules.
    std::string row;
    std::string next;
    for (int i = 0; i < 1000; ++i) {
        const std::string module = i % 3 == 0   ? "b(" + std::to_string(i) + ")"
                                   : i % 3 == 1 ? "c(" + std::to_string(i) + ",2)"
                                                : "d";
        const bool is_active = i == 5 || i == 64 || i == 700 || i == 998;
        row += (i == 0 ? "" : " ") + (is_active ? "A(1)" : module);
        // Words have blanks between bare names only.
        next += (next.empty() || next.ends_with(')') ? "" : " ") + (is_active ? "A(2)d" : module);
    }
    BytecodeBuilder builder;
    builder.fold = GENERATE(true, false);
    builder.axiom(row);
    builder.production(GENERATE("p : A(x) : * : A(x+1) d", "p : A(x) : x < 9 : A(x+1) d"));
    const std::string word = derived_every_way(builder.build(), 1, 0);
    const bool is_as_expected = word == next;
    CHECK(is_as_expected);
}

TEST_CASE("a program without productions keeps its axiom") {
    BytecodeBuilder builder;
    builder.axiom("F(1)[+F]");
    CHECK(derived_every_way(builder.build(), 5, 0) == "F(1)[+F]");
}

TEST_CASE("a derivation proceeds by steps, and its word can be moved out") {
    BytecodeBuilder builder;
    builder.axiom("A").production("p : A : * : A b");
    const Bytecode bytecode = builder.build();
    DeriveOptions options;
    options.generations = 4;
    std::vector<std::uint32_t> seen;
    options.progress = [&seen](std::uint32_t age, std::uint64_t modules) {
        CHECK(modules == age + 1);
        seen.push_back(age);
    };
    Derivation derivation(bytecode, options);
    REQUIRE(derivation.start() == std::nullopt);
    CHECK(derivation.age() == 0);
    REQUIRE(derivation.step() == std::nullopt);
    CHECK(derivation.age() == 1);
    CHECK(test::text_of(bytecode, derivation.word()) == "A b");
    REQUIRE(derivation.run_to(4) == std::nullopt);
    CHECK(seen == std::vector<std::uint32_t>{1, 2, 3, 4});
    const Word word = derivation.take_word();
    CHECK(test::text_of(bytecode, word) == "A b b b b");
    // start() begins anew.
    REQUIRE(derivation.start() == std::nullopt);
    CHECK(derivation.word().module_count() == 1);
}

#if defined(__linux__)
TEST_CASE("threads are started for a word that grows, and not for one of constant length") {
    const auto threads = [] {
        const std::filesystem::directory_iterator tasks("/proc/self/task");
        return std::distance(begin(tasks), end(tasks));
    };
    const auto started = [&](const char* production) {
        std::string axiom = "F";
        for (int i = 0; i < 20'000; ++i) {
            axiom += " A";
        }
        BytecodeBuilder builder;
        builder.axiom(axiom).production(production);
        const Bytecode bytecode = builder.build();
        DeriveOptions options;
        options.generations = 3;
        options.threads = 2;
        const auto before = threads();
        Derivation derivation(bytecode, options);
        REQUIRE_FALSE(derivation.derive());
        return threads() - before;
    };
    CHECK(started("p : F : * : A") == 0);
    CHECK(started("p : A : * : A A") == 1);
}
#endif
