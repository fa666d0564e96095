// SPDX-License-Identifier: MIT
// 1,000 random grammars, and edge cases that random grammars do not reach, must be derived by `lsc`
// exactly as by the oracle.

#include "tests/reference/build.h"
#include "tests/reference/compare.h"
#include "tests/reference/generate_expression.h"
#include "tests/reference/print.h"

#include <catch2/catch.hpp>

#include <cstdio>
#include <cstdlib>

namespace lsys::reference {

namespace {

void compare_seeds(std::uint64_t first, std::uint64_t last) {
    int shown = 0;
    for (std::uint64_t seed = first; seed <= last; ++seed) {
        const std::string text = difference(generate(seed));
        if (!text.empty() && ++shown <= 3) {
            FAIL_CHECK("seed " << seed << "\n" << text);
        }
    }
    CHECK(shown == 0);
}

Production choice(const std::string& label, float probability, std::vector<ModuleUse> successor) {
    Production production;
    production.label = label;
    production.predecessor = {{"A", {}}};
    production.probability = number(probability);
    production.successor = std::move(successor);
    return production;
}

Case one_step(const Grammar& grammar, std::uint64_t seed) {
    Case test_case;
    test_case.grammar = grammar;
    test_case.request.seed = seed;
    test_case.request.generations = 1;
    return test_case;
}

} // namespace

TEST_CASE("random grammars 1 to 250 are derived as by the oracle") {
    compare_seeds(1, 250);
}
TEST_CASE("random grammars 251 to 500 are derived as by the oracle") {
    compare_seeds(251, 500);
}
TEST_CASE("random grammars 501 to 750 are derived as by the oracle") {
    compare_seeds(501, 750);
}
TEST_CASE("random grammars 751 to 1000 are derived as by the oracle") {
    compare_seeds(751, 1000);
}

// Seeds whose first draw u is a special number: between a running sum of the weights in binary32
// and the same sum in binary64, equal to a running sum, or the smallest or largest possible u.
TEST_CASE("choices at the edge of a weight") {
    struct Edge {
        std::vector<float> weights;
        std::uint64_t seed;
        const char* word;
    };
    const std::vector<Edge> edges = {
        {{0.5F, 0.5F}, 515707, "C"}, // u = 0.5 is not below 0.5
        // The running sum 0.65 is smaller in binary32.
        {{0.1F, 0.1F, 0.45F, 0.35F}, 13371537, "E"},
        {{0.1F, 0.1F, 0.7F, 0.1F}, 5427075, "E"},      // the running sum 0.9 is smaller
        {{0.1F, 0.3F, 0.15F, 0.45F}, 1593363, "E"},    // u equals the running sum 0.55
        {{0.1F, 0.6F, 0.1F, 0.2F}, 16390493, "E"},     // the sum is below the largest u
        {{0.25F, 0.25F, 0.25F, 0.25F}, 12121362, "B"}, // u = 0
    };
    for (const Edge& edge : edges) {
        Grammar grammar;
        add_axiom(grammar, letters("A"));
        const std::string names = "BCDE";
        for (std::size_t i = 0; i < edge.weights.size(); ++i) {
            const std::string name(1, names[i]);
            add_production(grammar, choice("p" + name, edge.weights[i], letters(name)));
        }
        CHECK(print_word(derive(grammar, one_step(grammar, edge.seed).request).words[1], true) ==
              edge.word);
        CHECK(difference(one_step(grammar, edge.seed)) == "");
    }
}

// Section 4: values in a production that matches no module cause no error; values in a successor
// that is applied, and in a condition that is tested, do.
TEST_CASE("a value that is never finite is an error only where it is computed") {
    Grammar grammar;
    add_axiom(grammar, letters("A"));
    Production never = choice("never", 1, {{"F", {binary("/", number(1), number(0))}}});
    never.probability.reset();
    never.condition = binary(">", number(0), number(1));
    add_production(grammar, never);
    Production other = choice("other", 1, {{"F", {call("asin", {number(2)})}}});
    other.probability.reset();
    other.predecessor = {{"B", {}}};
    add_production(grammar, other);
    Production undecided = choice("undecided", 1, letters("F"));
    undecided.probability.reset();
    undecided.predecessor = {{"C", {}}};
    undecided.condition = call("log", {number(0)});
    add_production(grammar, undecided);
    CHECK(difference(one_step(grammar, 0)) == "");
    for (const char* axiom : {"B", "C"}) { // B: applied successor; C: tested condition
        Grammar faulty = grammar;
        for (Statement& statement : faulty.files[0].statements) {
            if (statement.kind == StatementKind::Axiom) {
                statement.modules = letters(axiom);
            }
        }
        CHECK(derive(faulty, one_step(faulty, 0).request).error.has_value());
        CHECK(difference(one_step(faulty, 0)) == "");
    }
}

TEST_CASE("polygons are checked along the word") {
    CHECK(difference(one_step(letter_system("{A", {"A=}F{", "B=}"}), 0)) == "");
    CHECK(difference(one_step(letter_system("{[A]F", {"A=}"}), 0)) == "");
    CHECK(difference(one_step(letter_system("FA", {"A=}{"}), 0)) == "");
    CHECK(difference(one_step(letter_system("{A}F", {"A=[%}]"}), 0)) == "");
    CHECK(difference(one_step(letter_system("A}", {"A=%{"}), 0)) == "");
}

// Compares the grammars of a range of seeds, `FIRST-LAST` in LSYS_RANDOM_GRAMMARS. Not part of a
// run of all tests.
TEST_CASE("random grammars of a range are derived as by the oracle", "[.]") {
    const char* const range_text = std::getenv("LSYS_RANDOM_GRAMMARS");
    unsigned long long first = 1001;
    unsigned long long last = 10000;
    if (range_text != nullptr) {
        REQUIRE(std::sscanf(range_text, "%llu-%llu", &first, &last) == 2);
    }
    REQUIRE(first <= last);
    compare_seeds(first, last);
}

TEST_CASE("words that become empty stay empty") {
    Grammar grammar = letter_system("A", {"A="});
    Case test_case = one_step(grammar, 0);
    test_case.request.generations = 4;
    CHECK(difference(test_case) == "");
}

TEST_CASE("every mode without productions keeps the axiom") {
    for (const char* mode : {"parallel", "sequential", "cyclic", "leftmost"}) {
        Grammar grammar = letter_system("A[B]", {});
        add_setting(grammar, "rewriting", mode);
        CHECK(difference(one_step(grammar, 0)) == "");
    }
}

} // namespace lsys::reference
