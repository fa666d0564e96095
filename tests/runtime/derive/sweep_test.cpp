// SPDX-License-Identifier: MIT
#include "runtime/base/random.h"
#include "runtime/derive/engine/sweep.h"
#include "runtime/derive/stream.h"
#include "runtime/derive/word_text.h"
#include "tests/support/bytecode_builder.h"
#include "tests/support/derived.h"

#include <catch2/catch.hpp>

#include <atomic>
#include <string>
#include <vector>

namespace lsys {
namespace {

using test::BytecodeBuilder;
using test::derived_every_way;

/// A program without rewriting: the axiom, swept once for each stage.
BytecodeBuilder swept(const std::string& axiom) {
    BytecodeBuilder builder;
    builder.axiom(axiom);
    return builder;
}

TEST_CASE("a down sweep carries information from the tips to the base in one generation") {
    SECTION("along a chain") {
        BytecodeBuilder builder = swept("A(1)A(2)A(3)A(4)");
        builder.production(Stage::Down, "d : A(x) > A(y) : * : A(x+y)");
        CHECK(derived_every_way(builder.build(), 0, 0) == "A(10)A(9)A(7)A(4)");
    }
    SECTION("over branches, with the branch and the axis named") {
        BytecodeBuilder builder = swept("F(0)[F(0)[F(1)]F(2)]F(0)[F(3)]F(4)");
        builder.production(Stage::Down, "d : F(x) > [F(y)] F(z) : * : F(x+y+z)");
        builder.production(Stage::Down, "e : F(x) > F(z) : * : F(x+z)");
        CHECK(derived_every_way(builder.build(), 0, 0) == "F(10)[F(3)[F(1)]F(2)]F(7)[F(3)]F(4)");
    }
    SECTION("past branches and ignored modules") {
        BytecodeBuilder builder = swept("A(1)+(5)[A(7)]-A(2)");
        builder.ignore("+ -");
        builder.production(Stage::Down, "d : A(x) > A(y) : * : A(x+y)");
        CHECK(derived_every_way(builder.build(), 0, 0) == "A(3)+(5)[A(7)]-A(2)");
    }
    SECTION("from a folded module") {
        BytecodeBuilder builder = swept("A(1)A(1)B(7)");
        builder.production(Stage::Down, "d : A(x) > B(y) : * : A(x+y)");
        builder.production(Stage::Down, "e : A(x) > A(y) : * : A(x*y)");
        CHECK(derived_every_way(builder.build(), 0, 0) == "A(8)A(8)B(7)");
    }
    SECTION("a context of several modules") {
        BytecodeBuilder builder = swept("A(1)A(2)A(3)A(4)A(5)");
        builder.production(Stage::Down, "d : A(x) > A(y) A(z) : * : A(x+y*z)");
        CHECK(derived_every_way(builder.build(), 0, 0) == "A(2163)A(94)A(23)A(4)A(5)");
    }
}

TEST_CASE("an up sweep carries information from the base to all tips in one generation") {
    BytecodeBuilder builder = swept("A(1)[A(0)[A(0)]A(0)]A(0)[A(0)]");
    builder.production(Stage::Up, "u : A(x) < A(y) : * : A(x+1)");
    CHECK(derived_every_way(builder.build(), 0, 0) == "A(1)[A(2)[A(3)]A(3)]A(2)[A(3)]");
}

TEST_CASE("the down sweep of a word comes before its up sweep") {
    BytecodeBuilder builder = swept("A(1,0)A(2,0)A(3,0)");
    builder.production(Stage::Down, "d : A(x,s) > A(y,t) : * : A(x+y,s)");
    builder.production(Stage::Up, "u : A(x,s) < A(y,t) : * : A(y,x+s)");
    CHECK(derived_every_way(builder.build(), 0, 0) == "A(6,0)A(5,6)A(3,11)");
}

TEST_CASE("each generation is swept once") {
    BytecodeBuilder builder = swept("B(1)");
    builder.production("p : B(x) : * : A(x) B(x)");
    builder.production(Stage::Down, "d : A(x) > A(y) : * : A(x+y)");
    // 1: A(1)B  2: A(2)A(1)B  3: A(4)A(2)A(1)B: the sums of the last word are swept again
    CHECK(derived_every_way(builder.build(), 3, 0) == "A(4)A(2)A(1)B(1)");
}

TEST_CASE("conditions and choices of a sweep") {
    SECTION("the first production that matches is taken") {
        BytecodeBuilder builder = swept("A(1)A(5)A(2)");
        builder.production(Stage::Down, "d : A(x) > A(y) : y > 4 : A(y)");
        builder.production(Stage::Down, "e : A(x) > A(y) : x > y : A(x+y)");
        builder.production(Stage::Down, "f : A(x) : * : A(0)");
        CHECK(derived_every_way(builder.build(), 0, 0) == "A(5)A(5)A(0)");
    }
    SECTION("a choice draws from the numbers of the sweep") {
        BytecodeBuilder builder = swept("A(0)A(0)A(0)A(0)A(0)A(0)A(0)A(0)");
        builder.production(Stage::Up, "u : A(x) : ~ 0.5 : A({1,2})");
        builder.production(Stage::Up, "v : A(x) : ~ 0.5 : A(0-1)");
        std::string expected;
        for (std::uint64_t i = 0; i < 8; ++i) {
            DrawSource source(3, 0, i);
            const float value = source.draw(kFirstUpDraw) < 0.5F
                                    ? draw_in_range(1.0F, 2.0F, source.draw(kFirstUpDraw + 1))
                                    : -1.0F;
            expected += "A(";
            append_number(value, expected);
            expected += ")";
        }
        CHECK(derived_every_way(builder.build(), 0, 3) == expected);
    }
}

/// `text` `count` times.
std::string repeated(const std::string& text, int count) {
    std::string all;
    for (int i = 0; i < count; ++i) {
        all += text;
    }
    return all;
}

TEST_CASE("contexts of several modules in words of any length") {
    // Neighbours out of reach are dropped from time to time.
    constexpr int kParts = 3000;
    SECTION("branches in branches") {
        const std::string part = "[F(2)[F(3)]F(4)]";
        BytecodeBuilder builder = swept(repeated("F(1)" + part, kParts));
        builder.fold = false;
        builder.production(Stage::Down, "d : F(x) > [F(y)[F(z)]F(w)]F(v) : * : F(x+y+z+w+0*v)");
        CHECK(test::derived(builder.build(), 0, 0) ==
              repeated("F(10)" + part, kParts - 1) + "F(1)" + part);
    }
    SECTION("many branches at a place") {
        const std::string branches = repeated("[F(1)F(2)]", kParts);
        BytecodeBuilder builder = swept("F(0)" + branches + "F(5)");
        builder.fold = false;
        builder.production(Stage::Down, "d : F(x) > [F(a)F(b)][F(c)]F(y) : * : F(a+b+c+y)");
        CHECK(test::derived(builder.build(), 0, 0) == "F(9)" + branches + "F(5)");
    }
    SECTION("the path to the base") {
        BytecodeBuilder builder = swept(repeated("F(1)[[F(2)]F(3)]", kParts));
        builder.fold = false;
        builder.production(Stage::Up, "u : F(x) F(y) < F(z) : * : F(z+0*(x+y)+10)");
        CHECK(test::derived(builder.build(), 0, 0) ==
              "F(1)[[F(2)]F(3)]F(1)[[F(12)]F(13)]" + repeated("F(11)[[F(12)]F(13)]", kParts - 2));
    }
}

TEST_CASE("step() of a sweep is the age of the word that is swept") {
    BytecodeBuilder builder = swept("A(9)");
    builder.production("p : A(x) : * : A(step()) ");
    builder.production(Stage::Down, "d : A(x) : * : A(x*10+step())");
    CHECK(derived_every_way(builder.build(), 0, 0) == "A(90)");
    CHECK(derived_every_way(builder.build(), 2, 0) == "A(12)");
}

TEST_CASE("an error of a sweep names the module and the generation, and keeps the last word") {
    BytecodeBuilder builder = swept("A(0)A(1)A(2)");
    builder.production("p : A(x) : * : A(x)");
    builder.production(Stage::Down, "d : A(x) > A(y) : step() == 2 : A(x/(y-y))");
    const Bytecode bytecode = builder.build();
    const RuntimeError error = test::error_every_way(bytecode, 3, 0);
    CHECK(error.kind == RuntimeErrorKind::NotFinite);
    CHECK(error.generation == 2);
    CHECK(error.position == 1);
    CHECK(error.parameters == std::vector<float>{1.0F});

    DeriveOptions options;
    options.generations = 3;
    Derivation derivation(bytecode, options);
    REQUIRE(!derivation.start());
    CHECK(derivation.run_to(3) == Stop::Diagnosed);
    CHECK(derivation.age() == 1);
    CHECK(test::text_of(bytecode, derivation.word()) == "A(0)A(1)A(2)");
}

TEST_CASE("a sweep that fails keeps the last word even if nothing rewrites it") {
    BytecodeBuilder builder = swept("A(1)A(1)");
    builder.production(Stage::Up, "u : A(x) < A(y) : * : A(y*2)");
    builder.production(Stage::Up, "v : A(x) : step() < 3 : A(x+1)");
    builder.production(Stage::Up, "w : A(x) : * : A(x/0)");
    const Bytecode bytecode = builder.build();
    DeriveOptions options;
    options.generations = 5;
    Derivation derivation(bytecode, options);
    REQUIRE(!derivation.start());
    CHECK(derivation.run_to(5) == Stop::Diagnosed);
    CHECK(derivation.age() == 2);
    CHECK(test::text_of(bytecode, derivation.word()) == "A(4)A(8)");
}

TEST_CASE("a sweep can be cancelled and keeps to the limit on memory") {
    BytecodeBuilder builder = swept("B");
    builder.production("p : B : * : A(1) A(1) B B");
    builder.production(Stage::Down, "d : A(x) > A(y) A(z) : * : A(x+0*y)");
    const Bytecode bytecode = builder.build();
    DeriveOptions options;
    options.generations = 20;
    SECTION("cancelled") {
        std::atomic<bool> cancelled = false;
        options.cancelled = &cancelled;
        Derivation derivation(bytecode, options);
        REQUIRE(!derivation.start());
        REQUIRE(!derivation.run_to(5));
        cancelled = true;
        CHECK(derivation.step() == Stop::Cancelled);
        CHECK(derivation.age() == 5);
    }
    SECTION("memory") {
        options.limits.max_bytes = 8U << 20;
        Derivation derivation(bytecode, options);
        REQUIRE(!derivation.start());
        CHECK(derivation.run_to(20) == Stop::Limit);
        CHECK(derivation.limit().kind == LimitKind::Memory);
        const std::string text = test::text_of(bytecode, derivation.word());
        CHECK(text == test::derived(bytecode, derivation.age(), 0));
    }
}

TEST_CASE("a limit that a sweep reaches names the last complete word") {
    // The error in generation 1 is looked for with tables of neighbours, which need memory.
    std::string axiom;
    for (int i = 0; i < 100'000; ++i) {
        axiom += i % 2 == 0 ? "A(1)" : "[A(1)]";
    }
    BytecodeBuilder builder = swept(axiom + "A(0)");
    builder.fold = false;
    builder.production("p : A(x) : * : A(x)");
    builder.production(Stage::Down, "d : A(x) > A(y) : step() == 1 : A(x/y)");
    const Bytecode bytecode = builder.build();
    bool has_stopped_in_sweep = false;
    for (std::uint64_t limit = 1'000'000; limit < 8'000'000; limit += 300'000) {
        DeriveOptions options;
        options.generations = 3;
        options.limits.max_bytes = limit;
        bool sweeps = false;
        options.on_pass = [&sweeps](const DerivationPass& pass) {
            sweeps = pass.kind == DerivationPass::Kind::Down;
        };
        Derivation derivation(bytecode, options);
        if (derivation.derive() != Stop::Limit) {
            continue;
        }
        has_stopped_in_sweep = has_stopped_in_sweep || sweeps;
        CHECK(derivation.age() == 0);
        CHECK(derivation.limit().generation == 0);
    }
    CHECK(has_stopped_in_sweep);
}

TEST_CASE("deep branches and long runs of ignored modules are swept in linear time") {
    // 200,000 levels, and as many ignored modules before the next module: quadratic work would
    // take hours.
    constexpr int kDeep = 100'000;
    std::string axiom = "A(1)";
    for (int i = 0; i < kDeep; ++i) {
        axiom += "[A(1)+";
    }
    axiom.append(kDeep, ']');
    BytecodeBuilder builder = swept(axiom);
    builder.ignore("+");
    builder.production(Stage::Down, "d : A(x) > [A(y)] : * : A(x+y)");
    builder.production(Stage::Up, "u : A(y) < A(x) : * : A(x+0*y)");
    const std::string text = test::derived(builder.build(), 0, 0);
    CHECK(text.substr(0, 10) == "A(100001)[");
}

/// Random plants of segments F(x), with leaves L(x) whose parameters are small whole numbers.
BytecodeBuilder random_plants() {
    BytecodeBuilder builder;
    builder.axiom("B(0)F(0)L(1)").ignore("+ -");
    builder.production("b : B(x) : * : B(x+1)");
    builder.production("p : L(x) : ~ 0.4 : [+F(0)L(x+1)][-F(0)L(x)]F(0)L(x)");
    builder.production("q : L(x) : ~ 0.4 : [+F(0)L(x)]F(0)F(0)L(x+2)");
    builder.production("r : L(x) : ~ 0.2 : L(x)");
    return builder;
}

/// Parameters of the modules of a name with one parameter, in order.
std::vector<float>
parameters_of(const Bytecode& bytecode, const Word& word, const std::string& name) {
    std::vector<float> found;
    std::uint64_t parameter = 0;
    for (std::uint64_t i = 0; i < word.module_count(); ++i) {
        const Code code = word.code(i);
        if (bytecode.symbol(bytecode.symbol_of(code)).name == name) {
            found.push_back(word.parameters()[parameter]);
        }
        parameter += bytecode.stored_parameters(code);
    }
    return found;
}

TEST_CASE("in every generation the sum at the base equals the sum over the leaves") {
    BytecodeBuilder builder = random_plants();
    builder.fold = false;
    builder.production(Stage::Down, "two : F(x) > [F(a)][F(b)]F(c) : * : F(a+b+c)");
    builder.production(Stage::Down, "one : F(x) > [F(a)]F(c) : * : F(a+c)");
    builder.production(Stage::Down, "leaf : F(x) > L(a) : * : F(a)");
    builder.production(Stage::Down, "none : F(x) > F(a) : * : F(a)");
    const Bytecode bytecode = builder.build();
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        DeriveOptions options;
        options.generations = 8;
        options.seed = seed;
        Derivation derivation(bytecode, options);
        REQUIRE(!derivation.start());
        for (std::uint32_t age = 0; age < 8; ++age) {
            REQUIRE(!derivation.run_to(age));
            float sum = 0.0F;
            for (const float leaf : parameters_of(bytecode, derivation.word(), "L")) {
                sum += leaf;
            }
            CHECK(parameters_of(bytecode, derivation.word(), "F").front() == sum);
        }
    }
}

TEST_CASE("in every generation all leaves know the base of this generation") {
    BytecodeBuilder builder = random_plants();
    builder.fold = false;
    builder.production(Stage::Up, "first : B(x) < F(y) : * : F(x)");
    builder.production(Stage::Up, "next : F(x) < F(y) : * : F(x)");
    builder.production(Stage::Up, "leaf : F(x) < L(y) : * : L(x)");
    const Bytecode bytecode = builder.build();
    DeriveOptions options;
    options.generations = 8;
    Derivation derivation(bytecode, options);
    REQUIRE(!derivation.start());
    for (std::uint32_t age = 0; age <= 8; ++age) {
        REQUIRE(!derivation.run_to(age));
        const float base = parameters_of(bytecode, derivation.word(), "B").front();
        CHECK(base == static_cast<float>(age));
        for (const float leaf : parameters_of(bytecode, derivation.word(), "L")) {
            CHECK(leaf == base);
        }
    }
}

TEST_CASE("a system that sweeps is not streamed, for a reason") {
    BytecodeBuilder builder = swept("A(1)");
    builder.production(Stage::Up, "u : A(x) : * : A(x+1)");
    CHECK(streaming_obstacle(builder.build()) == "production `u` of `#up` sweeps the whole word");
}

} // namespace
} // namespace lsys
