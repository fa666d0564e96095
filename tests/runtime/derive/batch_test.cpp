// SPDX-License-Identifier: MIT
// Parameters that are evaluated for many modules at once. Chunks of one, two and seven modules are
// evaluated one by one, so each case compares both methods.
#include "runtime/derive/derive.h"
#include "tests/compiler/compile_text.h"
#include "tests/support/derived.h"

#include <catch2/catch.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lsys {

namespace {

/// More modules than two batches have.
constexpr std::size_t kBatchedModules = 150;

Bytecode bytecode_of_batches(const std::string& text) {
    test::Compiled c = test::compile_text(text);
    CAPTURE(text, c.reports());
    REQUIRE(c.outcome.bytecode);
    return std::move(*c.outcome.bytecode);
}

/// An axiom of modules A(x) with numbers of every kind.
std::string axiom_of_many() {
    constexpr std::array<const char*, 14> kNumbers{"0",    "-(0)",  "1",     "-1",      "0.5",
                                                   "-2.5", "3",     "90",    "-270",    "1e-40",
                                                   "1e38", "-3e38", "1e-10", "16777216"};
    std::string text = "#w : ";
    for (std::size_t i = 0; i < kBatchedModules; ++i) {
        text += std::string("A(") + kNumbers[i % kNumbers.size()] +
                (i % 5 == 4 ? " * 0." + std::to_string(i) : "") + ") ";
    }
    return text + ";\n";
}

std::string check_every_way(const std::string& text, std::uint32_t generations) {
    CAPTURE(text);
    return test::derived_every_way(bytecode_of_batches(text), generations, 7);
}

/// Rewrites modules A(x) to F(`value`), or to F(-1) where the value is not finite, in every way.
void check_value(const std::string& locals, const std::string& value) {
    check_every_way(axiom_of_many() + "#p : A(x) : * : let " + locals + "v = " + value +
                        " : F(if(v*0 == 0, v, -1)) G(x);\n",
                    1);
}

std::size_t count_of(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
        ++count;
    }
    return count;
}

} // namespace

TEST_CASE("batches compute every operation like single modules") {
    for (const char* const value : {"-x",
                                    "!x",
                                    "x ^ 2.5",
                                    "x * 3",
                                    "7 / x",
                                    "x + 0.1",
                                    "5 - x",
                                    "x < 1",
                                    "x <= 1",
                                    "x > 1",
                                    "x >= 1",
                                    "x == 1",
                                    "x != 1",
                                    "x && x - 1",
                                    "x || x - 1",
                                    "sin(x)",
                                    "cos(x)",
                                    "tan(x)",
                                    "asin(x)",
                                    "acos(x)",
                                    "atan(x)",
                                    "atan2(x, 2)",
                                    "sqrt(x)",
                                    "exp(x)",
                                    "log(x)",
                                    "abs(x)",
                                    "floor(x)",
                                    "ceil(x)",
                                    "round(x)",
                                    "sign(x)",
                                    "min(x, 1)",
                                    "max(1, x)",
                                    "mod(x, 0.7)",
                                    "clamp(x, -1, 1)",
                                    "mix(x, 3, x)",
                                    "step() + x",
                                    "steps() - x",
                                    "x * x / x",
                                    "sqrt(x) - sqrt(-x)",
                                    "if(x, x, 1)",
                                    "if(x > 1, log(x), if(x < 0, -x, sqrt(x)))"}) {
        check_value("", value);
        check_value("r = {0.25, 0.75}, ", std::string("r * (") + value + ")");
    }
}

TEST_CASE("batches draw the random numbers of single modules") {
    for (const char* const value :
         {"{1, 2}", "{x, x}", "{-abs(x)/4, abs(x)/4}", "{1000, 1000.0001}",
          "{1, 2} + {1, 2} + {1, 2} + {1, 2} + {1, 2} + {1, 2}", "normal(x, 2)",
          "poisson(clamp(x, 0, 20))", "binomial(20, clamp(x, 0, 1))", "{0, {1, {2, 3}}}"}) {
        check_value("", value);
        check_every_way(axiom_of_many() + "#p : A(x) : ~ 0.5 : F(" + value +
                            ");\n#q : A(x) : ~ 0.5 : G(" + value + ", {3, 4});\n",
                        1);
    }
    check_every_way("#set choice generation;\n" + axiom_of_many() +
                        "#p : A(x) : ~ 0.5 : F({1, 2});\n" + "#q : A(x) : ~ 0.5 : F({2, 3});\n",
                    1);
    check_every_way("#set rewriting sequential;\n" + axiom_of_many() +
                        "#p : A(x) : * : B({1, 2}) B({3, 4});\n" +
                        "#q : B(x) : * : let y = {0, x} : C(y) C(y * y);\n",
                    1);
}

TEST_CASE("in a batch, only the chosen side of if() can cause an error") {
    CHECK(count_of(check_every_way(axiom_of_many() +
                                       "#p : A(x) : * :"
                                       "F(if(x > 1, {1, x}, if(x < 0, {x, 0}, {0, 1})));\n",
                                   1),
                   "F(") == kBatchedModules);
    check_value("", "if(x >= 0 && x <= 1, binomial(9, x), 5)");
    check_value("", "if(x >= 0 && x < 700, poisson(x), if(x < 0, normal(1, -x), x))");
}

TEST_CASE("curves, functions and constants in batches") {
    check_every_way(
        "#curve bend 0 0, 1 2, 5 -3;\n#function both(a, b) if(a < b, a*b, sqrt(a - b));\n"
        "#define k {1, 2};\n" +
            axiom_of_many() +
            "#p : A(x) : * : let c = bend(x), r = {0, 1} :"
            "F(c*r) G(k*r) H(both(c, r)) I(bend(both(r, r)));\n",
        1);
}

TEST_CASE("modules of a batch between other modules") {
    const std::string words = "#w : A(1, 2) B(5) [A(3, 4)] C;\n";
    check_every_way(
        words + "#p : A(x, y) : * : let r = {0.5, 1} : A(y*r, x) [B(r) C] A(x/r, y);\n"
                "#q : B(x) : x < 4 : B(x + 1) C;\n#r : B(x) : x >= 4 : B(x*{0, 1}) A(x, x);\n",
        7);
    // Successors with more parameters than a wide store, or a batch in the fast loop, can hold.
    for (const int count : {5, 16, 17, 40}) {
        std::string many = "#w : A(1) A(2) A(3);\n#p : A(x) : * : let r = {0, 1} : A(x + r) A(r)";
        for (int i = 2; i < count; ++i) {
            many += " F(x*r + " + std::to_string(i) + ")";
        }
        check_every_way(many + ";\n", 6);
    }
    // A successor longer than a wide store.
    std::string text = "#w : A(1);\n#p : A(x) : * : A(x*{0.5, 1})";
    for (int i = 0; i < 40; ++i) {
        text += " B";
    }
    check_every_way(text + " A(sqrt(x)) A(x + {1, 2});\n", 4);
}

TEST_CASE("formals of contexts and of several modules in batches") {
    check_every_way(axiom_of_many() +
                        "#p : A(l) < A(x) > A(r) : * : let s = if(l < r, l, r)*1e-20 :"
                        "F(s*{0, 1}) A(x);\n",
                    2);
    check_every_way("#set rewriting leftmost;\n#w : A(1) A(2) A(3) A(4) A(5);\n"
                    "#p : A(x) A(y) : x < 40 : A(x*y + {0, 1}) B(x, y);\n",
                    3);
}

TEST_CASE("batches in passes of decomposition and interpretation") {
    const std::string text =
        axiom_of_many() + "#p : A(x) : * : B(x*{0, 1}) B({0, 1});\n"
                          "#decompose d : B(x) : * : let r = {0, 1} : C(r*x) [+(r) D(sqrt(r))];\n"
                          "#decompose e : D(x) : x > 0.5 : D(x*{0, 1});\n";
    check_every_way(text, 1);
}

TEST_CASE("values of a batch that are not finite are errors") {
    const auto error = [](const std::string& productions) {
        std::string text = "#w : ";
        for (int i = 0; i < 100; ++i) {
            text += i == 70 || i == 71 ? "A(0) " : i == 90 ? "A(-1) " : "A(2) ";
        }
        return test::error_every_way(bytecode_of_batches(text + ";\n" + productions), 1, 7);
    };
    const RuntimeError infinite = error("#p : A(x) : * : let y = x*{1, 2} : F(y) G(1/y);\n");
    CHECK(infinite.kind == RuntimeErrorKind::NotFinite);
    CHECK(infinite.position == 70);
    const RuntimeError not_a_number = error("#p : A(x) : * : F(sqrt(x)*{0, 1});\n");
    CHECK(not_a_number.kind == RuntimeErrorKind::NotFinite);
    CHECK(not_a_number.position == 90);
    const RuntimeError reversed = error("#p : A(x) : * : let r = {1, x} : F(r);\n");
    CHECK(reversed.kind == RuntimeErrorKind::RangeReversed);
    CHECK(reversed.position == 70);
    const RuntimeError wide = error("#p : A(x) : * : let r = {0, x/(x + 1)} : F(1);\n");
    CHECK(wide.kind == RuntimeErrorKind::RangeTooWide);
    CHECK(wide.position == 90);
    const RuntimeError distribution = error("#p : A(x) : * : F(if(x < 1, poisson(x), 0));\n");
    CHECK(distribution.kind == RuntimeErrorKind::BadDistribution);
    CHECK(distribution.position == 90);
}

TEST_CASE("threads share the batches of a long word") {
    const Bytecode bytecode = bytecode_of_batches(
        "#w : A(1) A(1) A(1);\n#p : A(x) : * : let r = {0.5, 1} : A(x*r) A(x*r);\n");
    constexpr std::uint32_t kDoublings = 17; // the last words are long enough for several threads
    const auto parameters = [&](std::uint32_t threads) {
        DeriveOptions options;
        options.generations = kDoublings;
        options.threads = threads;
        Derivation derivation(bytecode, options);
        REQUIRE(derivation.start() == std::nullopt);
        REQUIRE(derivation.run_to(kDoublings) == std::nullopt);
        const std::span<const float> values = derivation.word().parameters();
        return std::vector<float>(values.begin(), values.end());
    };
    const std::vector<float> alone = parameters(1);
    CHECK(alone.size() == std::size_t{3} << kDoublings);
    for (const std::uint32_t threads : {2u, 3u}) {
        const bool is_same = parameters(threads) == alone;
        CHECK(is_same);
    }
}

TEST_CASE("local values of a successor without parameters read the formals") {
    const RuntimeError error = test::error_every_way(
        bytecode_of_batches(
            "#w : A(3) C(7) A(1);\n#p : A(x) : * : let r = {2, x} : B;\n#q : C(x) : * : D;\n"),
        1, 7);
    CHECK(error.position == 2);
}

} // namespace lsys
