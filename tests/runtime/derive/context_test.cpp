// SPDX-License-Identifier: MIT
// Contexts over branches, ignored modules and runs of ignored modules.
#include "runtime/derive/derive.h"
#include "runtime/derive/engine/contexts.h"
#include "runtime/derive/engine/plan.h"
#include "tests/support/bytecode_builder.h"
#include "tests/support/derived.h"

#include <catch2/catch.hpp>

#include <string>

using namespace lsys;
using test::BytecodeBuilder;
using test::derived;
using test::derived_every_way;

namespace {

/// Derives one generation of a system of letters whose only production rewrites A in the context
/// `head` to X.
std::string once(const std::string& axiom, const std::string& head, const std::string& ignored) {
    BytecodeBuilder builder;
    builder.settings.print_letters = true;
    std::string spaced;
    for (const char c : axiom) {
        spaced += c;
        spaced += ' ';
    }
    builder.axiom(spaced).production("p : " + head + " : * : X").ignore(ignored);
    return derived_every_way(builder.build(), 1, 0);
}

} // namespace

TEST_CASE("a left context is the path to the root") {
    CHECK(once("BABA", "B < A", "") == "BXBX");
    CHECK(once("AB", "B < A", "") == "AB");
    CHECK(once("B[A]A", "B < A", "") == "B[X]X");
    CHECK(once("B[C]A", "B < A", "") == "B[C]X");
    CHECK(once("B[C[D]E]A", "B < A", "") == "B[C[D]E]X");
    CHECK(once("C[B]A", "B < A", "") == "C[B]A");
    CHECK(once("[B]A", "B < A", "") == "[B]A");
    CHECK(once("CB[[A]C[A]]", "C B < A", "") == "CB[[X]C[A]]");
    CHECK(once("B[C]C[A]", "B C < A", "") == "B[C]C[X]");
    CHECK(once("B[C][A]", "B C < A", "") == "B[C][A]");
}

TEST_CASE("a right context is the axis, and branches where the pattern has them") {
    CHECK(once("ABAB", "A > B", "") == "XBXB");
    CHECK(once("BA", "A > B", "") == "BA");
    CHECK(once("A[C]B", "A > B", "") == "X[C]B");
    CHECK(once("A[B]C", "A > B", "") == "A[B]C");
    CHECK(once("[A]B", "A > B", "") == "[A]B");
    CHECK(once("A[B]C", "A > [ B ] C", "") == "X[B]C");
    CHECK(once("A[B]C", "A > [ B ]", "") == "X[B]C");
    CHECK(once("A[BD]C", "A > [ B ] C", "") == "X[BD]C");
    CHECK(once("A[D][B]C", "A > [ B ] C", "") == "A[D][B]C");
    CHECK(once("A[D][B]C", "A > [ D ] [ B ] C", "") == "X[D][B]C");
    CHECK(once("A[D][B]C", "A > [ D ] C", "") == "X[D][B]C");
    CHECK(once("A[E[F]B[C]D]G", "A > [ E B [ C ] D ] G", "") == "X[E[F]B[C]D]G");
    CHECK(once("A[E]G", "A > [ ] G", "") == "X[E]G");
    CHECK(once("A[]G", "A > [ ] G", "") == "X[]G");
    CHECK(once("A[]G", "A > [ G ]", "") == "A[]G");
    CHECK(once("A[[G]]", "A > [ [ G ] ]", "") == "X[[G]]");
    CHECK(once("AG", "A > [ ] G", "") == "AG");
    CHECK(once("A", "A > [ ]", "") == "A");
}

TEST_CASE("brackets without a partner") {
    CHECK(once("B]A", "B < A", "") == "B]A");
    CHECK(once("A]B", "A > B", "") == "A]B");
    CHECK(once("A[B", "A > B", "") == "A[B");
    CHECK(once("A[B", "A > [ B ]", "") == "X[B");
    CHECK(once("A[BC", "A > [ B ] C", "") == "A[BC");
    CHECK(once("B[A", "B < A", "") == "B[X");
    CHECK(once("B]C[D]A", "C < A", "") == "B]C[D]X");
}

TEST_CASE("ignored modules are not seen") {
    CHECK(once("B+A", "B < A", "+") == "B+X");
    CHECK(once("B++[-A]+A", "B < A", "+ -") == "B++[-X]+X");
    CHECK(once("A+[-+C]+B", "A > B", "+ -") == "X+[-+C]+B");
    CHECK(once("A+[-+C]+B", "A > [ C ] B", "+ -") == "X+[-+C]+B");
    CHECK(once("A+", "A > +", "+") == "A+");
    CHECK(once("+A", "+ < A", "+") == "+A");
    CHECK(once("B+A", "B < A", "") == "B+A");
    // An ignored module may itself be rewritten.
    CHECK(once("BAAC", "B < A > C", "A") == "BXXC");
    CHECK(once("A++[+B]", "A > [ B ]", "+") == "X++[+B]");
    CHECK(once("A++", "A > [ ]", "+") == "A++");
}

TEST_CASE("both contexts, and the first production that matches") {
    BytecodeBuilder builder;
    builder.axiom("B A C A B A B");
    builder.production("p : B < A > C : * : X").production("q : B < A : * : Y");
    builder.production("r : A > B : * : Z");
    CHECK(derived_every_way(builder.build(), 1, 0) == "B X C Z B Y B");
}

TEST_CASE("formals of contexts") {
    BytecodeBuilder builder;
    builder.fold = GENERATE(true, false);
    SECTION("adjacent and distant") {
        builder.axiom("B(1)A(2)C(3)[D(7)D(8)]E B(4)[D(9)[D(10)]A(5)]C(6)");
        builder.production("p : B(l) < A(x) > C(r) : l < r : A(l*100+x*10+r)");
        builder.production("q : D(l) < A(x) : * : A(l+x)");
        CHECK(derived_every_way(builder.build(), 1, 0) ==
              "B(1)A(123)C(3)[D(7)D(8)]E B(4)[D(9)[D(10)]A(14)]C(6)");
    }
    SECTION("beyond long branches") {
        std::string branch = "[";
        for (int i = 0; i < 500; ++i) {
            branch += "D(" + std::to_string(i % 7) + "," + std::to_string(i) + ")";
        }
        branch += "]";
        builder.axiom("B(1)" + branch + "A(2)" + branch + "C(3)");
        builder.production("p : B(l) < A(x) > [ D(y,z) D(v,w) ] C(r) : * : "
                           "A(l+10*x+100*r+1000*w)");
        const std::string text = derived_every_way(builder.build(), 1, 0);
        CHECK(text.find("]A(1321)[") != std::string::npos);
    }
    SECTION("conditions on a neighbour's parameter") {
        builder.axiom("B(1)A B(2)A B(3)A");
        builder.production("p : B(x) < A : x > 1 && x < 3 : X").ignore("");
        CHECK(derived_every_way(builder.build(), 1, 0) == "B(1)A B(2)X B(3)A");
    }
}

TEST_CASE("a stochastic choice among productions of equal contexts") {
    BytecodeBuilder builder;
    builder.settings.print_letters = true;
    builder.axiom("B A C A B A C A B A C A");
    builder.production("p : B < A : ~ 0.5 : X").production("q : C < A : ~ 0.5 : Y");
    builder.production("r : B < A : ~ 0.5 : Z").production("s : C < A : ~ 0.5 : W");
    const Bytecode bytecode = builder.build();
    bool first = false;
    bool second = false;
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        const std::string text = derived_every_way(bytecode, 1, seed);
        for (std::size_t i = 0; i < text.size(); i += 4) {
            CHECK((text[i + 1] == 'X' || text[i + 1] == 'Z'));
            CHECK((text[i + 3] == 'Y' || text[i + 3] == 'W'));
            first = first || text[i + 1] == 'X';
            second = second || text[i + 1] == 'Z';
        }
    }
    CHECK(first);
    CHECK(second);
}

TEST_CASE("a signal moves along the word") {
    std::string axiom = "b";
    for (int i = 0; i < 300; ++i) {
        axiom += " a";
    }
    BytecodeBuilder builder;
    builder.settings.print_letters = true;
    builder.axiom(axiom).production("p : b < a : * : b").production("q : b : * : a");
    const std::string text = derived(builder.build(), 200, 0);
    CHECK(text == std::string(200, 'a') + "b" + std::string(100, 'a'));
    CHECK(derived_every_way(builder.build(), 17, 0).find('b') == 17);
}

TEST_CASE("the memory of the tables of neighbours is predicted") {
    std::string axiom;
    for (int i = 0; i < 1000; ++i) {
        axiom += "A(1)[A(2)]";
    }
    for (const std::string head : {"A(y) < A(x)", "A(x) > A(y)", "A(x) > [A(y)]"}) {
        BytecodeBuilder builder;
        builder.axiom(axiom).production("p : " + head + " : * : A(x+y)");
        const Bytecode bytecode = builder.build();
        Derivation derivation(bytecode, {});
        REQUIRE(derivation.start() == std::nullopt);
        Plan plan(bytecode, {}, true);
        plan.prepare(0);
        ContextTables tables(plan);
        const std::uint64_t predicted = tables.held_bytes_after(derivation.word());
        REQUIRE(tables.prepare(plan, derivation.word()));
        // Predicted: module count + 1 entries per table; left_ and jump_ have one less.
        const std::uint64_t surplus = head == "A(x) > A(y)" ? 0 : sizeof(std::uint32_t);
        CHECK(tables.held_bytes() == predicted - surplus);
    }
}

TEST_CASE("no derivation is quadratic in branches or ignored modules", "[large]") {
    BytecodeBuilder builder;
    std::string axiom;
    constexpr int kMany = 100'000;
    SECTION("nested brackets") {
        axiom = "B " + std::string(kMany, '[') + "A" + std::string(kMany, ']') + " A";
        builder.production("p : B < A : * : X");
    }
    SECTION("many branches before many candidates") {
        axiom = "B ";
        for (int i = 0; i < kMany; ++i) {
            axiom += "[A]";
        }
        builder.production("p : B < A : * : X");
    }
    SECTION("a row of ignored candidates") {
        axiom = "B " + std::string(kMany, '+') + " C";
        builder.ignore("+").production("p : B < + > C : * : X");
    }
    SECTION("ignored modules in each of many branches") {
        axiom = "B " + std::string(kMany, '+');
        for (int i = 0; i < kMany; ++i) {
            axiom += "[A]";
        }
        builder.ignore("+").production("p : B < A > [ B ] : * : Y").production("q : B < A : * : X");
    }
    const Bytecode bytecode = builder.axiom(axiom).build();
    const std::string text = derived(bytecode, 2, 0);
    CHECK(text.find('X') != std::string::npos);
}
