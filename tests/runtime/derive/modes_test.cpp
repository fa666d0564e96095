// SPDX-License-Identifier: MIT
// Sequential and cyclic rewriting, and predecessors of several modules.
#include "runtime/base/random.h"
#include "runtime/derive/derive.h"
#include "tests/support/bytecode_builder.h"
#include "tests/support/derived.h"

#include <catch2/catch.hpp>

#include <string>

using namespace lsys;
using test::BytecodeBuilder;
using test::derived_every_way;

namespace {

BytecodeBuilder letters(RewritingMode mode) {
    BytecodeBuilder builder;
    builder.settings.rewriting = mode;
    builder.settings.print_letters = true;
    return builder;
}

} // namespace

TEST_CASE("sequential rewriting makes one pass for each rule in order") {
    BytecodeBuilder builder = letters(RewritingMode::Sequential);
    builder.axiom("A B");
    builder.production("p : A : * : B A").production("q : B : * : C");
    const Bytecode bytecode = builder.build();
    CHECK(derived_every_way(bytecode, 1, 0) == "CAC");
    CHECK(derived_every_way(bytecode, 2, 0) == "CCAC");
    CHECK(derived_every_way(bytecode, 4, 0) == "CCCCAC");
}

TEST_CASE("rules are numbered by first appearance and hold all productions of their predecessor") {
    BytecodeBuilder builder = letters(RewritingMode::Sequential);
    builder.axiom("A B A");
    // Rule 0 rewrites A (two productions), rule 1 rewrites B.
    builder.production("p : B < A : * : B").production("q : B : * : C");
    builder.production("r : A : * : D");
    CHECK(derived_every_way(builder.build(), 1, 0) == "DCC");
}

TEST_CASE("a match consumes its modules, and the pass does not read its successor") {
    BytecodeBuilder builder = letters(GENERATE(RewritingMode::Sequential, RewritingMode::Cyclic));
    builder.axiom("A A A A A B A A");
    builder.production("p : A A : * : A C");
    const Bytecode bytecode = builder.build();
    CHECK(derived_every_way(bytecode, 1, 0) == "ACACABAC");
    CHECK(derived_every_way(bytecode, 2, 0) == "ACACABAC");
}

TEST_CASE("the modules of a predecessor must be adjacent") {
    BytecodeBuilder builder = letters(RewritingMode::Sequential);
    builder.axiom("A + B A B A [ B ] A").ignore("+");
    builder.production("p : A B : * : X");
    CHECK(derived_every_way(builder.build(), 1, 0) == "A+BXA[B]A");
}

TEST_CASE("a predecessor that is longer than a chunk") {
    BytecodeBuilder builder = letters(RewritingMode::Cyclic);
    builder.axiom("a b c d e f g h i j a b c d e f g h i a b c d e f g h i j");
    builder.production("p : a b c d e f g h i j : * : X Y");
    CHECK(derived_every_way(builder.build(), 1, 0) == "XYabcdefghiXY");
}

TEST_CASE("contexts of a predecessor of several modules see the word before the pass") {
    BytecodeBuilder builder = letters(RewritingMode::Sequential);
    builder.axiom("C A B D A B D A B E");
    builder.production("p : C < A B > D : * : X").production("q : D < A B > D : * : Y C");
    builder.production("r : A B : * : Z");
    CHECK(derived_every_way(builder.build(), 1, 0) == "CXDYCDZE");
}

TEST_CASE("parameters of a predecessor of several modules") {
    BytecodeBuilder builder;
    builder.fold = GENERATE(true, false);
    builder.settings.rewriting = RewritingMode::Sequential;
    builder.axiom("A(1)B(2,3)A(4)B(5,6)C A(7)B(8,9)");
    builder.production("p : A(x) B(y,z) > C : x == 4 : A(x+y+z)");
    builder.production("q : A(x) B(y,z) : x > 0 && x < 7 : B(z,y)A(x)");
    builder.production("r : B(x,y) : * : D(x,y) D(y,x)");
    CHECK(derived_every_way(builder.build(), 1, 0) == "D(3,2)D(2,3)A(1)A(15)C A(7)D(8,9)D(9,8)");
}

TEST_CASE("cyclic rewriting makes the pass of one rule per generation") {
    BytecodeBuilder builder = letters(RewritingMode::Cyclic);
    builder.axiom("A");
    builder.production("p : A : * : A B").production("q : B : * : C C").production("r : C : * : ");
    const Bytecode bytecode = builder.build();
    CHECK(derived_every_way(bytecode, 1, 0) == "AB");
    CHECK(derived_every_way(bytecode, 2, 0) == "ACC");
    CHECK(derived_every_way(bytecode, 3, 0) == "A");
    CHECK(derived_every_way(bytecode, 5, 0) == "ACC");
}

TEST_CASE("without rules the words do not change") {
    BytecodeBuilder builder = letters(GENERATE(RewritingMode::Sequential, RewritingMode::Cyclic));
    builder.axiom("A B");
    CHECK(derived_every_way(builder.build(), 3, 0) == "AB");
}

TEST_CASE("in the pass of rule k, draw numbers are increased by 4096 k") {
    const std::uint64_t seed = 17;
    SECTION("choice at the position in the word that the pass reads") {
        BytecodeBuilder builder = letters(RewritingMode::Sequential);
        builder.axiom("A B A B B B B B");
        builder.production("p : A : * : A A").production("q : B : ~ 0.5 : C");
        builder.production("r : B : ~ 0.5 : D");
        const std::string read = "AABAABBBBB"; // the word that the pass of rule 1 reads
        std::string expected = read;
        for (std::uint64_t position = 0; position < read.size(); ++position) {
            if (read[position] == 'B') {
                const float u = DrawSource(seed, 0, position).draw(4096);
                expected[position] = 0.5F > u ? 'C' : 'D';
            }
        }
        CHECK(derived_every_way(builder.build(), 1, seed) == expected);
    }
    SECTION("ranges after the choice") {
        BytecodeBuilder builder;
        builder.settings.rewriting = RewritingMode::Sequential;
        builder.axiom("A B");
        builder.production("p : A : * : C").production("q : B : ~ 1 : D({0,1})");
        DeriveOptions options;
        options.seed = seed;
        options.generations = 1;
        const Bytecode bytecode = builder.build();
        Derivation derivation(bytecode, options);
        REQUIRE(derivation.start() == std::nullopt);
        REQUIRE(derivation.step() == std::nullopt);
        CHECK(derivation.word().parameters()[0] == DrawSource(seed, 0, 1).draw(4097));
    }
    SECTION("one choice per generation is always draw 0") {
        BytecodeBuilder builder = letters(RewritingMode::Sequential);
        builder.settings.choice = ChoiceScope::Generation;
        builder.axiom("A B B");
        builder.production("p : A : * : A").production("q : B : ~ 0.5 : C");
        builder.production("r : B : ~ 0.5 : D");
        const Bytecode bytecode = builder.build();
        for (std::uint64_t each = 0; each < 8; ++each) {
            const float u = DrawSource(each, 0, ~std::uint64_t{0} - 1).draw(0);
            CHECK(derived_every_way(bytecode, 1, each) == (0.5F > u ? "ACC" : "ADD"));
        }
    }
}

TEST_CASE("step is the age of the generation in all its passes") {
    BytecodeBuilder builder;
    builder.settings.rewriting = RewritingMode::Sequential;
    builder.axiom("A B");
    builder.production("p : A : step() < 1 : A").production("q : B : * : B C(step())");
    CHECK(derived_every_way(builder.build(), 3, 0) == "A B C(2)C(1)C(0)");
}
