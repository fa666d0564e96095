// SPDX-License-Identifier: MIT
#include "grammar/base/diagnostic.h"
#include "grammar/base/suggestions.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace {

/// The distance that nearest_name() uses, by its definition: optimal string alignment in which an
/// edit counts 2 and the replacement of a letter by its other case 1.
std::size_t plain_distance(std::string_view a, std::string_view b) {
    const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
    std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i) {
        for (std::size_t j = 0; j <= b.size(); ++j) {
            if (i == 0 || j == 0) {
                d[i][j] = 2 * (i + j);
                continue;
            }
            const char x = a[i - 1];
            const char y = b[j - 1];
            const std::size_t replace = x == y ? 0 : lower(x) == lower(y) ? 1 : 2;
            d[i][j] = std::min({d[i - 1][j] + 2, d[i][j - 1] + 2, d[i - 1][j - 1] + replace});
            if (i > 1 && j > 1 && x == b[j - 2] && a[i - 2] == y) {
                d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 2);
            }
        }
    }
    return d[a.size()][b.size()];
}

std::optional<std::string_view> plain_nearest(std::string_view wanted,
                                              const std::vector<std::string_view>& candidates) {
    std::optional<std::string_view> best;
    std::size_t best_distance = std::numeric_limits<std::size_t>::max();
    for (const std::string_view candidate : candidates) {
        const std::size_t shorter = std::min(candidate.size(), wanted.size());
        const std::size_t limit = shorter < 3 ? 0 : 2 * (shorter / 3);
        const std::size_t distance = plain_distance(wanted, candidate);
        const bool differs_in_case =
            candidate.size() == wanted.size() && candidate != wanted &&
            std::equal(wanted.begin(), wanted.end(), candidate.begin(), [](char x, char y) {
                return std::tolower(static_cast<unsigned char>(x)) ==
                       std::tolower(static_cast<unsigned char>(y));
            });
        if (differs_in_case) {
            return candidate;
        }
        if (candidate != wanted && distance <= limit && distance < best_distance) {
            best = candidate;
            best_distance = distance;
        }
    }
    return best;
}

class Words {
public:
    std::string word(std::size_t max_length) {
        std::string text(1 + next() % max_length, ' ');
        for (char& c : text) {
            c = "abcABZz_1"[next() % 9];
        }
        return text;
    }

private:
    std::uint32_t next() {
        state_ = state_ * 1664525U + 1013904223U;
        return state_ >> 16U;
    }
    std::uint32_t state_ = 1;
};

} // namespace

TEST_CASE("the nearest name is the one of the plain definition") {
    Words words;
    int found = 0;
    for (int round = 0; round < 2000; ++round) {
        const std::size_t max_length = round % 10 == 0 ? 64 : 9;
        const std::string wanted = words.word(max_length);
        std::vector<std::string> names;
        for (int i = 0; i < 20; ++i) {
            names.push_back(words.word(max_length));
        }
        names.push_back(wanted.substr(0, wanted.size() / 2) + "b" +
                        wanted.substr(wanted.size() / 2));
        names.back().resize(std::min<std::size_t>(names.back().size(), 64));
        const std::vector<std::string_view> candidates(names.begin(), names.end());
        CAPTURE(wanted);
        const auto nearest = lsys::nearest_name(wanted, candidates);
        REQUIRE(nearest == plain_nearest(wanted, candidates));
        found += nearest ? 1 : 0;
    }
    CHECK(found > 1000);
}

TEST_CASE("names of more than 64 letters are compared without case only") {
    const std::string name(64, 'a');
    CHECK(lsys::nearest_name(name, {name.substr(1) + "b"}));
    CHECK_FALSE(lsys::nearest_name(name + "a", {name + "b"}));
    CHECK(lsys::nearest_name(name + "a", {name + "A"}) == name + "A");
}

TEST_CASE("suggestions end after four million comparisons") {
    lsys::Suggestions suggestions;
    const std::vector<std::string_view> names(2'000'000, "stemm");
    CHECK(suggestions.nearest("stem", names) == "stemm");
    CHECK(suggestions.claim(1'999'999));
    CHECK_FALSE(suggestions.claim(2));
    CHECK(suggestions.nearest("stem", {"stems"}) == "stems");
    CHECK(suggestions.nearest("stem", {"stems"}).empty());
}
