// SPDX-License-Identifier: MIT
// Checks that random grammars use every feature often enough.

#include "tests/reference/features.h"
#include "tests/reference/generate.h"
#include "tests/reference/print.h"

#include <catch2/catch.hpp>

#include <map>

namespace lsys::reference {

TEST_CASE("random grammars exercise every feature") {
    constexpr std::uint64_t kSeeds = 400;
    std::map<std::string, int> counts;
    std::size_t stopped = 0;
    std::size_t applied = 0;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
        const Case test_case = generate(seed);
        const Derivation derivation = derive(test_case.grammar, test_case.request);
        REQUIRE_FALSE(derivation.words.empty());
        for (const Word& word : derivation.words) {
            CHECK(word.size() <= 20000);
        }
        stopped += derivation.error ? 1U : 0U;
        applied += derivation.applications.size();
        for (const std::string& feature : features_of(test_case, derivation)) {
            ++counts[feature];
        }
    }
    for (const std::string& feature : feature_names()) {
        INFO(feature);
        CHECK(counts[feature] > 0);
    }
    CHECK(stopped < kSeeds / 5);
    CHECK(applied > 3 * kSeeds);
}

TEST_CASE("random plants exercise every feature of sensing") {
    constexpr std::uint64_t kPlants = 300;
    std::map<std::string, int> counts;
    for (std::uint64_t seed = 1; seed <= kPlants; ++seed) {
        const Case test_case = generate_plant(seed);
        const Derivation derivation = derive(test_case.grammar, test_case.request);
        REQUIRE_FALSE(derivation.words.empty());
        for (const std::string& feature : sense_features_of(test_case, derivation)) {
            ++counts[feature];
        }
    }
    for (const std::string& feature : sense_feature_names()) {
        INFO(feature);
        CHECK(counts[feature] > 0);
    }
}

TEST_CASE("a seed always gives the same grammar and the same text") {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const bool senses = seed % 2 == 0;
        const Case first = senses ? generate_plant(seed) : generate(seed);
        const Case second = senses ? generate_plant(seed) : generate(seed);
        const std::vector<TextFile> texts = print_grammar(first.grammar, first.layout_seed);
        const std::vector<TextFile> again = print_grammar(second.grammar, second.layout_seed);
        REQUIRE(texts.size() == again.size());
        for (std::size_t i = 0; i < texts.size(); ++i) {
            CHECK(texts[i].path == again[i].path);
            CHECK(texts[i].text == again[i].text);
        }
    }
}

} // namespace lsys::reference
