// SPDX-License-Identifier: MIT
// Random places, and environments that answer at these places, for tests of environments.
#pragma once

#include "runtime/environment/environment.h"

#include <catch2/catch.hpp>

#include <array>
#include <bit>
#include <cstdint>
#include <random>
#include <vector>

namespace lsys::environments {

/// A source of random numbers for tests. Its numbers are the same with every standard library.
class TestRandom {
public:
    explicit TestRandom(std::uint32_t seed) : engine_(seed) {}

    [[nodiscard]] std::uint32_t below(std::uint32_t count) {
        return static_cast<std::uint32_t>(engine_()) % count;
    }
    /// A uniform random number from `low` to `high`.
    [[nodiscard]] double between(double low, double high) {
        return low + (high - low) * (static_cast<double>(engine_()) * 0x1p-32);
    }
    /// A place in a cube around the origin. `half`: half of its side.
    [[nodiscard]] Vector3 in_cube(double half) {
        const double x = between(-half, half);
        const double y = between(-half, half);
        return {x, y, between(-half, half)};
    }

private:
    std::mt19937 engine_;
};

/// Places of a word. Some are random, some lie on a grid, so that distances are equal, and some are
/// equal to another place.
inline std::vector<SensePlace> random_places(TestRandom& random, std::size_t count, double half) {
    std::vector<SensePlace> places;
    for (std::size_t i = 0; i < count; ++i) {
        SensePlace place;
        place.position = random.in_cube(half);
        const std::uint32_t kind = random.below(4);
        if (kind == 0) {
            for (double& coordinate : place.position) {
                coordinate = static_cast<double>(static_cast<int>(coordinate * 2.0)) / 2.0;
            }
        } else if (kind == 1 && i > 0) {
            place.position = places[random.below(static_cast<std::uint32_t>(i))].position;
        }
        constexpr std::array<Vector3, 4> kHeadings{
            Vector3{0.0, 1.0, 0.0}, {1.0, 0.0, 0.0}, {0.6, 0.8, 0.0}, {0.0, -0.6, 0.8}};
        place.heading = kHeadings[random.below(4)];
        place.up = {0.0, 0.0, 1.0};
        places.push_back(place);
    }
    return places;
}

inline SensedWord word_of(const std::vector<SensePlace>& places) {
    SensedWord word;
    word.places = places;
    return word;
}

/// The answers of an environment: four numbers for each place. Fails the test if there is no
/// answer.
inline std::vector<float> answers_of(Environment& environment,
                                     const std::vector<SensePlace>& places) {
    std::vector<float> answers(places.size() * 4, -77.0F);
    std::vector<std::uint32_t> sizes;
    REQUIRE_FALSE(environment.answer(word_of(places), answers, sizes).has_value());
    return answers;
}

/// Whether both answers have the same bits.
inline bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
    if (a.size() != b.size()) {
        return false;
    }
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (std::bit_cast<std::uint32_t>(a[i]) != std::bit_cast<std::uint32_t>(b[i])) {
            return false;
        }
    }
    return true;
}

} // namespace lsys::environments
