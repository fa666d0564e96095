// SPDX-License-Identifier: MIT
#include "runtime/base/random.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <vector>

using lsys::draw_in_range;
using lsys::DrawSource;
using lsys::philox4x32;
using lsys::PhiloxBlock;
using lsys::unit_interval;

TEST_CASE("Philox gives the published words") {
    CHECK(philox4x32({0, 0, 0, 0}, {0, 0}) ==
          PhiloxBlock{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8});
    constexpr std::uint32_t kOnes = 0xFFFFFFFF;
    CHECK(philox4x32({kOnes, kOnes, kOnes, kOnes}, {kOnes, kOnes}) ==
          PhiloxBlock{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd});
}

TEST_CASE("a draw depends on seed, generation, position and number") {
    const std::uint64_t seed = 0x0123456789ABCDEF;
    const std::uint64_t position = 0xFEDCBA9876543210;
    DrawSource source(seed, 7, position);
    for (std::uint32_t number = 0; number < 12; ++number) {
        const PhiloxBlock block =
            philox4x32({0x76543210, 0xFEDCBA98, 7, number / 4}, {0x89ABCDEF, 0x01234567});
        CHECK(source.draw(number) == unit_interval(block[number % 4]));
    }
    // A draw from an earlier block.
    const PhiloxBlock block = philox4x32({0x76543210, 0xFEDCBA98, 7, 0}, {0x89ABCDEF, 0x01234567});
    CHECK(source.draw(2) == unit_interval(block[2]));
}

TEST_CASE("drawing for many positions at once gives the numbers of each alone") {
    for (std::uint32_t word = 0; word < 4; ++word) {
        const lsys::DrawKey key{0x0123456789ABCDEF, 7, 5, word};
        for (std::size_t count = 0; count <= 33; ++count) {
            std::vector<std::uint64_t> positions;
            for (std::size_t i = 0; i < count; ++i) {
                positions.push_back((std::uint64_t{i} << 31) + 0xFFFFFFF0 + i * i);
            }
            std::vector<float> units(count + 1, 2.0F);
            lsys::draw_units(key, positions.data(), count, units.data());
            for (std::size_t i = 0; i < count; ++i) {
                const PhiloxBlock block = lsys::draw_block(key.seed, 7, positions[i], 5);
                CHECK(units[i] == unit_interval(block[word]));
            }
            CHECK(units[count] == 2.0F);
        }
    }
}

TEST_CASE("u lies from 0 to below 1 and has 24 bits") {
    CHECK(unit_interval(0) == 0.0F);
    CHECK(unit_interval(0xFF) == 0.0F);
    CHECK(unit_interval(0x100) == 0x1p-24F);
    CHECK(unit_interval(0xFFFFFFFF) == 1.0F - 0x1p-24F);
}

TEST_CASE("a range never yields its maximum") {
    const float largest = 1.0F - 0x1p-24F;
    CHECK(draw_in_range(0.0F, 1.0F, largest) == largest);
    // Computed directly, min + (max - min) u would be rounded up to the maximum for these ranges.
    CHECK(draw_in_range(1.0F, 1.0F + 0x1p-23F, largest) == 1.0F);
    CHECK(draw_in_range(1024.0F, 1025.0F, largest) < 1025.0F);
    CHECK(draw_in_range(1024.0F, 1025.0F, largest) ==
          std::nextafter(1025.0F, -std::numeric_limits<float>::infinity()));
    CHECK(draw_in_range(3.0F, 3.0F, 0.5F) == 3.0F);
    CHECK(draw_in_range(-2.0F, 2.0F, 0.75F) == 1.0F);
}

TEST_CASE("blocks computed in runs equal blocks computed one by one") {
    for (const std::uint32_t first : {0U, 8U, 1'000'000U, 0xFFFFFFF8U}) {
        const auto run = lsys::draw_block_run(0x123456789ABCDEF0, 0xFFFFFFFE, 77, first);
        for (std::uint32_t i = 0; i < lsys::kBlockRun; ++i) {
            CHECK(run[i] == lsys::draw_block(0x123456789ABCDEF0, 0xFFFFFFFE, 77, first + i)[0]);
        }
    }
}
