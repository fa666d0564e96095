// SPDX-License-Identifier: MIT
// 1,000 random plants that sense must be derived by `lsc` exactly as by the oracle, whose
// environments look at every voxel, marker, pair and triangle.

#include "tests/reference/compare.h"

#include <catch2/catch.hpp>

#include <cstdio>
#include <cstdlib>
#include <iostream>

namespace lsys::reference {

namespace {

constexpr std::uint64_t kPlants = 1000;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr std::uint64_t kStep = 8; // every eighth plant: sanitizers slow the programs down
#else
constexpr std::uint64_t kStep = 1;
#endif

#ifdef _WIN32
constexpr bool kRunsPrograms = false; // `lsc` starts no programs there
#else
constexpr bool kRunsPrograms = true;
#endif

// Compares the plants first, first + step, ... up to last. Returns the answers of all of them, by
// kind of environment.
std::map<std::string, Answered>
compare_plants(std::uint64_t first, std::uint64_t last, std::uint64_t step) {
    std::map<std::string, Answered> answered;
    std::string different; // seeds
    int shown = 0;
    std::uint64_t stopped = 0;
    for (std::uint64_t seed = first; seed <= last; seed += step) {
        const Case test_case = generate_plant(seed);
        if (!kRunsPrograms && !test_case.request.programs.empty()) {
            continue;
        }
        const Derivation derivation = derive(test_case.grammar, test_case.request);
        const std::string text = difference_of_plant(test_case, derivation);
        different += text.empty() ? "" : " " + std::to_string(seed);
        if (!text.empty() && ++shown <= 3) {
            FAIL_CHECK("plant " << seed << "\n" << text);
        }
        stopped += derivation.error ? 1U : 0U;
        for (const auto& [kind, of_plant] : derivation.answered) {
            Answered& all = answered[kind];
            all.modules += of_plant.modules;
            all.other_than_zero += of_plant.other_than_zero;
            all.different.insert(of_plant.different.begin(), of_plant.different.end());
        }
    }
    CHECK(different == "");
    CHECK(stopped * 5 * step < last - first + step);
    return answered;
}

} // namespace

TEST_CASE("random plants sense as by the oracle") {
    const std::map<std::string, Answered> answered = compare_plants(1, kPlants, kStep);
    std::vector<std::string> kinds = {"turtle", "shadow", "sky", "space", "crowd", "solid", "map"};
    if (kRunsPrograms) {
        kinds.emplace_back("program");
    }
    for (const std::string& kind : kinds) {
        const auto found = answered.find(kind);
        REQUIRE(found != answered.end());
        const Answered& all = found->second;
        std::cout << kind << ": " << all.modules << " answers, " << all.other_than_zero
                  << " other than 0, " << all.different.size() << " different\n";
        INFO(kind);
        CHECK(all.modules * kStep >= 2000);
        CHECK(all.other_than_zero * 10 > all.modules);
        CHECK(all.different.size() * kStep >= 250);
    }
}

// Compares more plants than a run of all tests: LSYS_RANDOM_PLANTS is `FIRST-LAST`.
TEST_CASE("random plants of a range sense as by the oracle", "[.]") {
    const char* const range_text = std::getenv("LSYS_RANDOM_PLANTS");
    unsigned long long first = 1001;
    unsigned long long last = 10000;
    if (range_text != nullptr) {
        REQUIRE(std::sscanf(range_text, "%llu-%llu", &first, &last) == 2);
    }
    REQUIRE(first <= last);
    compare_plants(first, last, 1);
}

} // namespace lsys::reference
