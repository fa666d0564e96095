// SPDX-License-Identifier: MIT
// Run-time errors: which error is reported, and its message.
#include "runtime/base/random.h"
#include "runtime/derive/derive.h"
#include "runtime/derive/runtime_diagnostic.h"
#include "runtime/derive/stream.h"
#include "tests/support/bytecode_builder.h"
#include "tests/support/derived.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <string>

using namespace lsys;
using test::BytecodeBuilder;
using test::error_every_way;

namespace {

std::string name_of(const Bytecode& bytecode, const RuntimeError& error) {
    return error.production == kNoProduction
               ? ""
               : bytecode.productions[static_cast<std::size_t>(error.production)].name;
}

std::string repeated_text(const std::string& text, int count) {
    std::string all;
    for (int i = 0; i < count; ++i) {
        all += text;
    }
    return all;
}

} // namespace

TEST_CASE("an argument that is not finite") {
    BytecodeBuilder builder;
    builder.fold = GENERATE(true, false);
    builder.axiom("A(3)").production("p : A(x) : * : F(1/x)A(x-1)");
    const Bytecode bytecode = builder.build();
    const RuntimeError error = error_every_way(bytecode, 9, 0);
    CHECK(error.kind == RuntimeErrorKind::NotFinite);
    CHECK(name_of(bytecode, error) == "p");
    CHECK(error.generation == 3);
    CHECK(error.position == 3);
    CHECK(error.parameters == std::vector<float>{0.0F});
    CHECK(std::isinf(error.value));
    CHECK_FALSE(error.in_condition);
    CHECK(error.site != kNone);
}

TEST_CASE("the fast forms of arguments overflow as the general ones do") {
    BytecodeBuilder builder;
    builder.fold = GENERATE(true, false);
    builder.axiom(repeated_text("F(1)", 100) + "G(1e30)F(1e38)" + repeated_text("F(1)", 100));
    builder.production("p : F(x) : * : F(x*4)").production("q : G(x) : * : G(x*x)");
    const Bytecode bytecode = builder.build();
    const RuntimeError error = error_every_way(bytecode, 1, 0);
    CHECK(name_of(bytecode, error) == "q");
    CHECK(error.position == 100);
}

TEST_CASE("the lowest position is reported, conditions before arguments") {
    BytecodeBuilder builder;
    builder.fold = GENERATE(true, false);
    SECTION("a condition after an argument") {
        builder.axiom(repeated_text("A(1)", 50) + "B(0)" + repeated_text("A(1)", 20) + "A(0)");
        builder.production("p : A(x) : 1/x > 0 && 1/x : C").production("q : B(x) : * : D(1/x)");
        const Bytecode bytecode = builder.build();
        const RuntimeError error = error_every_way(bytecode, 1, 0);
        CHECK(name_of(bytecode, error) == "q");
        CHECK(error.position == 50);
    }
    SECTION("a condition that has no value") {
        builder.axiom(repeated_text("A(1)", 50) + "A(0)B(0)");
        builder.production("p : A(x) : 1/x : C").production("q : B(x) : * : D(1/x)");
        const Bytecode bytecode = builder.build();
        const RuntimeError error = error_every_way(bytecode, 1, 0);
        CHECK(name_of(bytecode, error) == "p");
        CHECK(error.in_condition);
        CHECK(error.position == 50);
        CHECK(error.parameters == std::vector<float>{0.0F});
    }
    SECTION("conditions are evaluated only until one holds") {
        builder.axiom("A(0)");
        builder.production("p : A(x) : x == 0 : C").production("q : A(x) : 1/x : D");
        CHECK(test::derived_every_way(builder.build(), 1, 0) == "C");
    }
    SECTION("every condition of a stochastic group is evaluated") {
        builder.axiom("A(0)");
        builder.production("p : A(x) : x == 0 ~ 0.5 : C(1/x)");
        builder.production("q : A(x) : 1/x ~ 0.5 : D");
        const Bytecode bytecode = builder.build();
        const RuntimeError error = error_every_way(bytecode, 1, 0);
        CHECK(name_of(bytecode, error) == "q");
        CHECK(error.in_condition);
    }
    SECTION("arguments from left to right") {
        builder.axiom("A(0)");
        builder.production("p : A(x) : * : C(x, sqrt(x-1), 1/x)");
        const RuntimeError error = error_every_way(builder.build(), 1, 0);
        CHECK(std::isnan(error.value));
    }
}

TEST_CASE("ranges with invalid bounds") {
    BytecodeBuilder builder;
    builder.fold = GENERATE(true, false);
    SECTION("reversed") {
        builder.axiom("A(2)A(1)A(0)").production("p : A(x) : * : F({1, x})");
        const RuntimeError error = error_every_way(builder.build(), 1, 0);
        CHECK(error.kind == RuntimeErrorKind::RangeReversed);
        CHECK(error.position == 2);
        CHECK(error.first_argument == 1.0F);
        CHECK(error.second_argument == 0.0F);
    }
    SECTION("too wide") {
        builder.axiom("A(3e38)").production("p : A(x) : * : F({-x, x})");
        CHECK(error_every_way(builder.build(), 1, 0).kind == RuntimeErrorKind::RangeTooWide);
    }
    SECTION("without a finite bound") {
        builder.axiom("A(0)").production("p : A(x) : * : F({1, 1/x})");
        CHECK(error_every_way(builder.build(), 1, 0).kind == RuntimeErrorKind::RangeTooWide);
    }
}

TEST_CASE("errors in passes of rules") {
    BytecodeBuilder builder;
    builder.settings.rewriting = RewritingMode::Sequential;
    builder.axiom("A(1)B(1)A(1)B(0)C A(1)B(0)");
    builder.production("p : C : * : C C").production("q : A(x) B(y) : * : A(x/y)");
    const Bytecode bytecode = builder.build();
    const RuntimeError error = error_every_way(bytecode, 1, 0);
    CHECK(name_of(bytecode, error) == "q");
    CHECK(error.position == 2);
    CHECK(error.generation == 0);
    CHECK(error.parameters == std::vector<float>{1.0F});
}

TEST_CASE("after an error the word is that of the last generation") {
    BytecodeBuilder builder;
    builder.settings.rewriting = GENERATE(RewritingMode::Parallel, RewritingMode::Sequential);
    builder.axiom("A(2)").production("p : A(x) : * : A(x-1)B(1/x)").production("q : B(x) : * : b");
    const Bytecode bytecode = builder.build();
    DeriveOptions options;
    options.generations = 5;
    Derivation derivation(bytecode, options);
    REQUIRE(derivation.start() == std::nullopt);
    REQUIRE(derivation.run_to(5) == Stop::Diagnosed);
    CHECK(derivation.age() == 2);
    const bool parallel = builder.settings.rewriting == RewritingMode::Parallel;
    CHECK(test::text_of(bytecode, derivation.word()) == (parallel ? "A(0)B(1)b" : "A(0)b b"));
    CHECK(derivation.step() == Stop::Diagnosed);
}

TEST_CASE("errors before generation 0") {
    BytecodeBuilder builder;
    DeriveOptions options;
    SECTION("a parameter outside its bounds") {
        builder.parameter("width", "{2, 3}", 0.0F, 1.0F).axiom("F");
        const Bytecode bytecode = builder.build();
        Derivation derivation(bytecode, options);
        REQUIRE(derivation.start() == Stop::Diagnosed);
        CHECK(derivation.error().kind == RuntimeErrorKind::OutOfBounds);
        CHECK(derivation.error().generation == kStartGeneration);
        const Diagnostic diagnostic = runtime_diagnostic(derivation.error(), bytecode, true);
        CHECK(diagnostic.code == DiagnosticCode::BadParameterBounds);
        CHECK(diagnostic.message.find("`width` is 2.") != std::string::npos);
        CHECK(diagnostic.message.find("outside its bounds {0, 1}") != std::string::npos);
    }
    SECTION("a constant without value") {
        builder.global("c", "1 / ({0, 0})").axiom("F(c)");
        const Bytecode bytecode = builder.build();
        Derivation derivation(bytecode, options);
        REQUIRE(derivation.start() == Stop::Diagnosed);
        CHECK(runtime_diagnostic(derivation.error(), bytecode, true).message ==
              "the value of constant `c` is infinite");
    }
    SECTION("the axiom") {
        builder.global("c", "{0, 0}").axiom("F [ F(1) F(c) F(1, 1/c) ]");
        const Bytecode bytecode = builder.build();
        Derivation derivation(bytecode, options);
        REQUIRE(derivation.start() == Stop::Diagnosed);
        CHECK(derivation.error().position == 4);
        const Diagnostic diagnostic = runtime_diagnostic(derivation.error(), bytecode, true);
        CHECK(diagnostic.message == "a parameter of the axiom is infinite");
        CHECK(diagnostic.notes ==
              std::vector<std::string>{"module 4 of the axiom (counted from 0)"});
    }
}

TEST_CASE("an unmatched bracket is reported, with its production if only one can have written it") {
    BytecodeBuilder builder;
    builder.axiom("[ A ] B").production("p : A : * : F").production("q : B : * : F [ F ] ] B");
    Bytecode bytecode = builder.build();
    DeriveOptions options;
    options.generations = 2;
    const auto check = [&] {
        Derivation derivation(bytecode, options);
        REQUIRE(derivation.start() == std::nullopt);
        CHECK(derivation.check_brackets() == std::nullopt);
        REQUIRE(derivation.run_to(2) == std::nullopt);
        REQUIRE(derivation.check_brackets() == Stop::Diagnosed);
        return derivation.error();
    };
    RuntimeError error = check();
    CHECK(error.kind == RuntimeErrorKind::Unbalanced);
    CHECK(error.position == 7);
    CHECK(error.generation == 2);
    CHECK(name_of(bytecode, error) == "q");
    CHECK(runtime_diagnostic(error, bytecode, true).message ==
          "module 7 of generation 2 is a `]` without its `[` (counted from 0)");

    builder.production("r : F : * : F [ ] ]");
    bytecode = builder.build();
    error = check();
    CHECK(error.production == kNoProduction);

    const StreamOutcome outcome =
        derive_streamed(bytecode, options, [](const StreamChunk&) { return true; });
    CHECK(outcome.end.stop == Stop::Diagnosed);
    CHECK(outcome.end.error.position == error.position);
    CHECK(outcome.end.error.kind == RuntimeErrorKind::Unbalanced);
}

TEST_CASE("a streamed derivation stops at an error") {
    BytecodeBuilder builder;
    builder.axiom("A(3)").production("p : A(x) : * : F(1/x)A(x-1)");
    const Bytecode bytecode = builder.build();
    DeriveOptions options;
    options.generations = 9;
    const StreamOutcome outcome =
        derive_streamed(bytecode, options, [](const StreamChunk&) { return true; });
    REQUIRE(outcome.end.stop == Stop::Diagnosed);
    CHECK(outcome.end.error.kind == RuntimeErrorKind::NotFinite);
    CHECK(outcome.end.error.generation == 3);
    CHECK(outcome.end.error.position == 3);
}

TEST_CASE("messages name production, module, position and generation") {
    BytecodeBuilder builder;
    builder.axiom("A(3)").production("grow : A(x) : * : F(1/x)A(x-1)");
    const Bytecode bytecode = builder.build();
    const RuntimeError error = error_every_way(bytecode, 9, 0);
    const Diagnostic diagnostic = runtime_diagnostic(error, bytecode, true);
    CHECK(diagnostic.code == DiagnosticCode::NotFinite);
    CHECK(diagnostic.severity == Severity::Error);
    CHECK(diagnostic.message == "a parameter of production `grow` is infinite");
    CHECK(diagnostic.label == "infinite here");
    CHECK(diagnostic.span == bytecode.sites[error.site].span);
    CHECK(diagnostic.notes == std::vector<std::string>{"while rewriting `A(0)`, module 3 of "
                                                       "generation 3 (counted from 0)"});
    CHECK(diagnostic.help.size() == 1);
    // Without the source text, a note gives the place.
    const Diagnostic blind = runtime_diagnostic(error, bytecode, false);
    CHECK(blind.span.file == kNoFile);
    CHECK(blind.notes.back() ==
          "at test.lsys:" + std::to_string(bytecode.sites[error.site].line) + ":1");
}

TEST_CASE("the message about a value that overflows advises to bound it") {
    BytecodeBuilder builder;
    builder.fold = false;
    builder.axiom("A(10)").production("square : A(x) : * : A(x*x)");
    const Bytecode bytecode = builder.build();
    const RuntimeError error = error_every_way(bytecode, 9, 0);
    CHECK(error.generation == 5); // 10^32 squared
    CHECK(runtime_diagnostic(error, bytecode, true).help ==
          std::vector<std::string>{"the value grows with every generation and passes 3.4e38, the "
                                   "largest binary32 number: stop it with a condition such as `x < "
                                   "100`, or bound it, as in `min(x * x, 100)`"});
}

TEST_CASE("the message about decomposition without end advises more passes if they are allowed") {
    BytecodeBuilder builder;
    builder.axiom("A(0)").production(Stage::Decompose, "d : A(x) : * : A(x)");
    Bytecode bytecode = builder.build();
    RuntimeError error;
    error.kind = RuntimeErrorKind::TooDeep;
    error.production = ProductionId{0};
    error.symbol = bytecode.symbol_of(0);
    error.parameters = {0.0F};
    const auto help = [&](std::uint32_t depth) {
        bytecode.settings.decompose_depth = depth;
        return runtime_diagnostic(error, bytecode, true).help;
    };
    const auto advice = [](const std::string& passes) {
        return std::vector<std::string>{"let its productions end" + passes +
                                        " or keep the remaining modules unchanged with `#set "
                                        "at_depth stop;`"};
    };
    const std::string raise = ", raise the number of passes with `#set decompose_depth ";
    CHECK(help(3) == advice(raise + "30;`,"));
    CHECK(help(kMaxDepth / 2) == advice(raise + "100000;`,"));
    CHECK(help(kMaxDepth) == advice(""));
    // A parameter that becomes small, but not 0, has an advice of its own.
    error.parameters = {1e-7F};
    CHECK(help(3).size() == 2);
}
