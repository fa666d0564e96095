// SPDX-License-Identifier: MIT
// Folding of reachable modules: the programs that benefit, and the parameters that their words
// store.
#include "runtime/derive/fold_reached.h"
#include "tests/support/bytecode_builder.h"
#include "tests/support/derived.h"

#include <catch2/catch.hpp>

#include <optional>
#include <string>

using namespace lsys;
using test::BytecodeBuilder;
using test::derived_every_way;

namespace {

/// Parameters that the word of the folded program stores.
std::uint64_t stored(const Bytecode& folded, std::uint32_t generations, std::uint64_t seed = 0) {
    DeriveOptions options;
    options.generations = generations;
    options.seed = seed;
    Derivation derivation(folded, options);
    REQUIRE(derivation.start() == std::nullopt);
    REQUIRE(derivation.run_to(generations) == std::nullopt);
    return derivation.word().parameter_count();
}

} // namespace

TEST_CASE("parameters that grow by a factor each generation are folded") {
    BytecodeBuilder builder;
    builder.axiom("!(1.4)F(2)/(45)A");
    builder.production("p : A : * : !(1.4)F(2)[&(22.5)F(2)A]/(112.5)[&(22.5)F(2)A]");
    builder.production("q : F(l) : * : F(l*1.1)").production("r : !(w) : * : !(w*1.4)");
    const Bytecode bytecode = builder.build();
    const std::optional<Bytecode> folded = fold_reached(bytecode, 0, 8);
    REQUIRE(folded.has_value());
    CHECK(stored(*folded, 8) == 0);
    CHECK(code_width(folded->code_count()) == code_width(bytecode.code_count()));
    static_cast<void>(derived_every_way(bytecode, 8, 0));
}

TEST_CASE("counters that run down are folded, and so are their conditions") {
    BytecodeBuilder builder;
    builder.axiom("A(6)");
    builder.production("p : A(x) : x > 0 : F(1)[+(30)A(x-1)]A(x-1)");
    builder.production("q : A(x) : x <= 0 : F(x)");
    const Bytecode bytecode = builder.build();
    const std::optional<Bytecode> folded = fold_reached(bytecode, 0, 9);
    REQUIRE(folded.has_value());
    CHECK(stored(*folded, 9) == 0);
    static_cast<void>(derived_every_way(bytecode, 9, 0));
}

TEST_CASE("alternatives of one module are folded separately") {
    BytecodeBuilder builder;
    builder.axiom("A(1)A(2)");
    builder.production("p : A(x) : x < 4 ~ 0.5 : A(x+1)[B(x*2)]");
    builder.production("q : A(x) : x < 4 ~ 0.25 : A(x-1)A(x+1)");
    builder.production("r : A(x) : x < 3 ~ 0.25 : B(x)");
    const Bytecode bytecode = builder.build();
    const std::optional<Bytecode> folded = fold_reached(bytecode, 3, 7);
    REQUIRE(folded.has_value());
    CHECK(stored(*folded, 7, 3) == 0);
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
        static_cast<void>(derived_every_way(bytecode, 7, seed));
    }
}

TEST_CASE("values that depend on chance, the age or a neighbour are not folded") {
    BytecodeBuilder builder;
    SECTION("a range") {
        builder.axiom("A(1)");
        builder.production("p : A(x) : * : F({0,x})A(x+1)B(x)");
    }
    SECTION("the age") {
        builder.axiom("A(1)B(2)");
        builder.production("p : A(x) : * : F(step())A(x+1)").production("q : B(x) : * : B(x/2)");
    }
    SECTION("a neighbour") {
        builder.axiom("A(1)B(2)A(3)");
        builder.production("p : A(a) < B(x) > A(b) : x < 9 : B(a+b)C(x)");
        builder.production("q : A(x) : * : A(x+1)").production("r : C(x) : * : C(x*2)A(x)");
    }
    const Bytecode bytecode = builder.build();
    CHECK(stored(fold_reached(bytecode, 0, 6).value_or(bytecode), 6) != 0);
    static_cast<void>(derived_every_way(bytecode, 6, 0));
}

TEST_CASE("the number of generations is a constant") {
    BytecodeBuilder builder;
    builder.axiom("A(0)").production("p : A(x) : x < steps() : F(steps()-x)A(x+1)");
    const Bytecode bytecode = builder.build();
    const std::optional<Bytecode> folded = fold_reached(bytecode, 0, 12);
    REQUIRE(folded.has_value());
    CHECK(stored(*folded, 12) == 0);
    static_cast<void>(derived_every_way(bytecode, 12, 0));
}

TEST_CASE("a zero keeps its sign") {
    BytecodeBuilder builder;
    builder.axiom("A(1)").production("p : A(x) : * : A(-x*0)B(1/(x+2))");
    static_cast<void>(derived_every_way(builder.build(), 4, 0));
}

TEST_CASE("nothing is folded if codes would become wider") {
    BytecodeBuilder builder;
    builder.axiom("A(1)").production("p : A(x) : * : A(x+1)F(x)F(x/2)F(x/3)");
    const Bytecode bytecode = builder.build();
    CHECK(fold_reached(bytecode, 0, 40).has_value());
    CHECK_FALSE(fold_reached(bytecode, 0, 400).has_value());
}

TEST_CASE("nothing is folded without parameters or in other modes") {
    BytecodeBuilder builder;
    SECTION("no parameters") {
        builder.axiom("F").production("p : F : * : F+F");
        CHECK_FALSE(fold_reached(builder.build(), 0, 5).has_value());
    }
    SECTION("no other arguments") {
        builder.axiom("F(1)").production("p : F(x) : * : F(1)F(1)");
        CHECK_FALSE(fold_reached(builder.build(), 0, 5).has_value());
    }
    SECTION("sequential") {
        builder.settings.rewriting = RewritingMode::Sequential;
        builder.axiom("A(1)").production("p : A(x) : * : A(x+1)");
        CHECK_FALSE(fold_reached(builder.build(), 0, 5).has_value());
    }
}

TEST_CASE("an error message is the same as without folding") {
    BytecodeBuilder builder;
    builder.axiom("A(3)").production("p : A(x) : * : A(x-1)F(1/x)");
    const RuntimeError error = test::error_every_way(builder.build(), 6, 0);
    CHECK(error.kind == RuntimeErrorKind::NotFinite);
    CHECK(error.generation == 3);
    CHECK(error.parameters == std::vector<float>{0.0F});
}
