// SPDX-License-Identifier: MIT
#include "runtime/pipeline/growth_forecast.h"
#include "tests/support/bytecode_builder.h"

#include <catch2/catch.hpp>

#include <cstdint>
#include <limits>
#include <optional>

using namespace lsys;

namespace {

std::optional<LimitReport>
limit(const Bytecode& bytecode, std::uint32_t generations, std::uint64_t max_modules) {
    Limits limits;
    limits.max_modules = max_modules;
    return predict_limit(bytecode, generations, limits);
}

} // namespace

TEST_CASE("a limit is predicted from the first generation over it on") {
    test::BytecodeBuilder builder;
    builder.axiom("A").production("p : A : * : A B A");
    const Bytecode bytecode = builder.build();
    CHECK_FALSE(limit(bytecode, 3, 15)); // 1, 3, 7, 15, 31 modules
    const std::optional<LimitReport> report = limit(bytecode, 4, 15);
    REQUIRE(report);
    CHECK(report->generation == 3);
    CHECK(report->modules == 15);
    CHECK(report->predicted_modules == 31);
    CHECK(limit(bytecode, 4'000'000'000, 15));
}

TEST_CASE("a limit is predicted for counts beyond 2^64, whatever the limit is") {
    test::BytecodeBuilder builder;
    builder.axiom("A").production("p : A : * : A A");
    const Bytecode bytecode = builder.build();
    constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
    CHECK_FALSE(limit(bytecode, 63, kMost));
    const std::optional<LimitReport> report = limit(bytecode, 70, kMost);
    REQUIRE(report);
    CHECK(report->generation == 63);
    CHECK(report->modules == std::uint64_t{1} << 63);
    Limits limits;
    limits.max_modules = kMost;
    REQUIRE(predict_counts(bytecode, 63, limits));
    CHECK(predict_counts(bytecode, 63, limits)->back() == std::uint64_t{1} << 63);
    CHECK_FALSE(predict_counts(bytecode, 64, limits));
}

TEST_CASE("no limit is predicted for words that never grow") {
    test::BytecodeBuilder builder;
    builder.axiom("A B A B").production("p : A : * : B").production("q : B : * : A");
    CHECK_FALSE(limit(builder.build(), 4'000'000'000, 4));
}

TEST_CASE("a limit is predicted if several productions rewrite a module in one generation") {
    test::BytecodeBuilder builder;
    builder.axiom("A").production("p : A : * : B B").production("q : B : * : C C");
    builder.settings.rewriting = RewritingMode::Sequential;
    const std::optional<LimitReport> report = limit(builder.build(), 1, 3);
    REQUIRE(report);
    CHECK(report->predicted_modules == 4);
}
