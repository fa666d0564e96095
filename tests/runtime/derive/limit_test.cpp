// SPDX-License-Identifier: MIT
// Limits on modules and memory, and cancelling.
#include "runtime/derive/derive.h"
#include "runtime/derive/runtime_diagnostic.h"
#include "runtime/derive/stream.h"
#include "tests/support/bytecode_builder.h"
#include "tests/support/derived.h"

#include <catch2/catch.hpp>

#include <atomic>
#include <new>
#include <stdexcept>
#include <string>

using namespace lsys;
using test::BytecodeBuilder;

namespace {

Bytecode koch() {
    BytecodeBuilder builder;
    builder.axiom("F").production("p : F : * : F+F-F-F+F");
    return builder.build();
}

} // namespace

TEST_CASE("a word over the limit on modules is not written") {
    const Bytecode bytecode = koch();
    DeriveOptions options;
    options.generations = 9;
    options.limits.max_modules = 6'249;
    options.threads = GENERATE(1u, 2u);
    options.chunk_modules = GENERATE(100u, 1u << 16);
    Derivation derivation(bytecode, options);
    REQUIRE(derivation.start() == std::nullopt);
    REQUIRE(derivation.run_to(9) == Stop::Limit);
    CHECK(derivation.age() == 5);
    CHECK(derivation.word().module_count() == 6'249);
    const LimitReport& report = derivation.limit();
    CHECK(report.kind == LimitKind::Modules);
    CHECK(report.generation == 5);
    CHECK(report.modules == 6'249);
    CHECK(report.predicted_modules == 31'249);
    CHECK(report.exact);
    CHECK(report.production == 0);
    CHECK(derivation.step() == Stop::Limit);

    const Diagnostic diagnostic = limit_diagnostic(report, options.limits, bytecode, true);
    CHECK(diagnostic.code == DiagnosticCode::LimitReached);
    CHECK(diagnostic.message == "generation 6 has 31,249 modules, over the limit of 6,249");
    CHECK(diagnostic.span == bytecode.sites[bytecode.productions[0].name_site].span);
    CHECK(diagnostic.notes ==
          std::vector<std::string>{"generation 5, with 6,249 modules, is the last that fits"});
    CHECK(diagnostic.help ==
          std::vector<std::string>{"ask for fewer generations: `-n 5`, or raise the limit with "
                                   "`--max-modules`"});
}

TEST_CASE("the prediction of a conditional and stochastic system is exact") {
    BytecodeBuilder builder;
    builder.settings.rewriting = GENERATE(RewritingMode::Parallel, RewritingMode::Sequential);
    builder.axiom("A(1)");
    builder.production("p : A(x) : x < 5 ~ 0.5 : A(x+1)A(x)")
        .production("q : A(x) : * ~ 0.5 : A(0)A(x)A(x)");
    builder.production("r : B : * : B B B B B B B B B");
    const Bytecode bytecode = builder.build();
    DeriveOptions options;
    options.generations = 9;
    options.threads = 1;
    Derivation unlimited(bytecode, options);
    REQUIRE(unlimited.start() == std::nullopt);
    REQUIRE(unlimited.run_to(6) == std::nullopt);
    const std::uint64_t six = unlimited.word().module_count();
    REQUIRE(unlimited.step() == std::nullopt);
    const std::uint64_t seven = unlimited.word().module_count();

    options.limits.max_modules = seven - 1;
    Derivation derivation(bytecode, options);
    REQUIRE(derivation.start() == std::nullopt);
    REQUIRE(derivation.run_to(9) == Stop::Limit);
    CHECK(derivation.limit().generation == 6);
    CHECK(derivation.limit().modules == six);
    CHECK(derivation.limit().predicted_modules == seven);
    CHECK(derivation.limit().production < 2);
}

TEST_CASE("the message names the production that adds the most modules") {
    BytecodeBuilder builder;
    builder.axiom("A B");
    builder.production("p : A : * : A A A").production("q : B : * : B C C C C");
    builder.production("r : C : * : D D D");
    const Bytecode bytecode = builder.build();
    DeriveOptions options;
    options.generations = 9;
    options.limits.max_modules = 20;
    Derivation derivation(bytecode, options);
    REQUIRE(derivation.start() == std::nullopt);
    REQUIRE(derivation.run_to(9) == Stop::Limit);
    // The word of generation 1 has 3 A, 1 B and 4 C: p adds 6 modules, q 4 and r 8.
    CHECK(derivation.limit().generation == 1);
    CHECK(derivation.limit().production == 2);
}

TEST_CASE("a limit that no production causes names none") {
    std::string axiom;
    for (int i = 0; i < 100'000; ++i) {
        axiom += "A(1)";
    }
    BytecodeBuilder builder;
    builder.fold = false;
    builder.axiom(axiom).production("p : A(x) : * : A(x+1)");
    const Bytecode bytecode = builder.build();
    DeriveOptions options;
    options.limits.max_bytes = 750'000; // for one word of 500,000 bytes, not for two
    Derivation derivation(bytecode, options);
    REQUIRE(derivation.start() == std::nullopt);
    REQUIRE(derivation.step() == Stop::Limit);
    CHECK(derivation.limit().kind == LimitKind::Memory);
    CHECK(derivation.limit().predicted_modules == 100'000);
    CHECK(derivation.limit().production == kNone);
}

TEST_CASE("a limit on memory") {
    const Bytecode bytecode = koch();
    DeriveOptions options;
    options.generations = 20;
    options.limits.max_bytes = 1 << 20;
    options.threads = GENERATE(1u, 2u);
    Derivation derivation(bytecode, options);
    REQUIRE(derivation.start() == std::nullopt);
    REQUIRE(derivation.run_to(20) == Stop::Limit);
    const LimitReport& report = derivation.limit();
    CHECK(report.kind == LimitKind::Memory);
    CHECK(report.predicted_bytes > options.limits.max_bytes);
    CHECK(report.predicted_modules == 2 * 1'953'125 - 1);
    CHECK(derivation.age() == 8);
    const Diagnostic diagnostic = limit_diagnostic(report, options.limits, bytecode, false);
    CHECK(diagnostic.message.find("generation 9 takes ") == 0);
    CHECK(diagnostic.message.find(", over the limit of 1.0 MiB") != std::string::npos);
}

TEST_CASE("an axiom over the limit") {
    BytecodeBuilder builder;
    builder.axiom("A A A");
    const Bytecode bytecode = builder.build();
    DeriveOptions options;
    options.limits.max_modules = 2;
    Derivation derivation(bytecode, options);
    REQUIRE(derivation.start() == Stop::Limit);
    CHECK(limit_diagnostic(derivation.limit(), options.limits, bytecode, true).message ==
          "generation 0 has 3 modules, over the limit of 2");
}

TEST_CASE("a streamed derivation stops at the limit on modules") {
    const Bytecode bytecode = koch();
    DeriveOptions options;
    options.generations = 12;
    options.limits.max_modules = 100'000;
    std::uint64_t modules = 0;
    const StreamOutcome outcome = derive_streamed(bytecode, options, [&](const StreamChunk& chunk) {
        modules += chunk.codes.size();
        return true;
    });
    REQUIRE(outcome.end.stop == Stop::Limit);
    CHECK(modules <= 100'000);
    CHECK(outcome.end.limit.kind == LimitKind::Modules);
    CHECK_FALSE(outcome.end.limit.exact);
    CHECK(limit_diagnostic(outcome.end.limit, options.limits, bytecode, true)
              .message.find("generation 12 has at least 10") == 0);
}

TEST_CASE("streaming needs memory per generation, not per module") {
    const Bytecode bytecode = koch();
    DeriveOptions options;
    options.generations = 11;
    options.limits.max_bytes = 9 << 20;
    std::uint64_t modules = 0;
    const StreamOutcome outcome = derive_streamed(bytecode, options, [&](const StreamChunk& chunk) {
        modules += chunk.codes.size();
        return true;
    });
    REQUIRE(outcome.end.stop == std::nullopt);
    CHECK(modules == 97'656'249);
    CHECK(outcome.modules == modules);

    options.generations = 4'000'000'000;
    const StreamOutcome deep =
        derive_streamed(bytecode, options, [](const StreamChunk&) { return true; });
    CHECK(deep.end.stop == Stop::Limit);
    CHECK(deep.end.limit.kind == LimitKind::Memory);
}

TEST_CASE("cancelling") {
    const Bytecode bytecode = koch();
    std::atomic<bool> cancelled{false};
    DeriveOptions options;
    options.generations = 12;
    options.cancelled = &cancelled;
    options.chunk_modules = 1000;
    options.threads = GENERATE(1u, 2u);
    SECTION("between generations") {
        options.progress = [&](std::uint32_t age, std::uint64_t) { cancelled = age >= 5; };
        Derivation derivation(bytecode, options);
        REQUIRE(derivation.start() == std::nullopt);
        CHECK(derivation.run_to(12) == Stop::Cancelled);
        CHECK(derivation.age() == 5);
        CHECK(derivation.word().module_count() == 6'249);
        // The derivation can continue afterwards.
        cancelled = false;
        CHECK(derivation.step() == std::nullopt);
        CHECK(derivation.word().module_count() == 31'249);
    }
    SECTION("within a generation") {
        std::uint64_t written = 0;
        options.progress = [&](std::uint32_t age, std::uint64_t modules) {
            if (age == 11) {
                written = modules;
                cancelled = true;
            }
        };
        Derivation derivation(bytecode, options);
        REQUIRE(derivation.start() == std::nullopt);
        CHECK(derivation.run_to(12) == Stop::Cancelled);
        CHECK(derivation.age() == 10);
        CHECK(written < 97'656'249);
        CHECK(derivation.word().module_count() == 19'531'249);
    }
    SECTION("by the consumer of a streamed word") {
        std::uint64_t modules = 0;
        const StreamOutcome outcome =
            derive_streamed(bytecode, options, [&](const StreamChunk& chunk) {
                modules += chunk.codes.size();
                return modules < 10'000;
            });
        CHECK(outcome.end.stop == Stop::Cancelled);
        CHECK(modules < 30'000);
    }
}

TEST_CASE("sizes in words") {
    CHECK(grouped_digits(0) == "0");
    CHECK(grouped_digits(999) == "999");
    CHECK(grouped_digits(1'000) == "1,000");
    CHECK(grouped_digits(18'446'744'073'709'551'615u) == "18,446,744,073,709,551,615");
    CHECK(byte_size_text(1023) == "1023 B");
    CHECK(byte_size_text(1536) == "1.5 KiB");
    CHECK(byte_size_text(std::uint64_t{3} << 30) == "3.0 GiB");
}

TEST_CASE("a derivation that runs out of memory ends with Stop::OutOfMemory and keeps its word") {
    const Bytecode bytecode = koch();
    DeriveOptions options;
    options.generations = 3;
    bool has_memory = false;
    options.progress = [&](std::uint32_t, std::uint64_t) {
        if (!has_memory) {
            throw std::bad_alloc();
        }
    };
    Derivation derivation(bytecode, options);
    REQUIRE(derivation.start() == std::nullopt);
    CHECK(derivation.step() == Stop::OutOfMemory);
    CHECK(derivation.end().stop == Stop::OutOfMemory);
    CHECK(derivation.limit().kind == LimitKind::Memory);

    const StreamOutcome outcome = derive_streamed(
        bytecode, options, [](const StreamChunk&) -> bool { throw std::length_error("long"); });
    CHECK(outcome.end.stop == Stop::OutOfMemory);
    CHECK(limit_diagnostic(outcome.end.limit, options.limits, bytecode, true).message ==
          "the system has no memory for generation 3");

    has_memory = true;
    CHECK(derivation.derive() == std::nullopt);
    CHECK(derivation.age() == 3);
}
