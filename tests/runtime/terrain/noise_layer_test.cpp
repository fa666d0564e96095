// SPDX-License-Identifier: MIT
#include "runtime/base/random.h"
#include "runtime/terrain/noise_layer.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <stb/stb_perlin.h>
#include <vector>

using namespace lsys;

namespace {

/// Whether two numbers have the same bits, except that -0 equals 0.
bool is_same(float a, float b) {
    return std::bit_cast<std::uint32_t>(a + 0.0F) == std::bit_cast<std::uint32_t>(b + 0.0F);
}

} // namespace

TEST_CASE("a layer of noise has the bits of stb_perlin") {
    for (const float height : {0.0F, 1.0F, 77.0F, 255.0F}) {
        const NoiseLayer layer(height);
        std::uint32_t different = 0;
        for (std::uint32_t i = 0; i < 200'000; ++i) {
            const PhiloxBlock words = draw_block(7, static_cast<std::uint32_t>(height), i, 0);
            const float x = static_cast<float>(words[0]) * 0x1p-24F; // 0 to 256, both included
            const float z = static_cast<float>(words[1]) * 0x1p-24F;
            different +=
                is_same(layer.at(x, z), stb_perlin_noise3(x, height, z, 0, 0, 0)) ? 0U : 1U;
        }
        CHECK(different == 0);
        for (const float x : {0.0F, 0.5F, 3.0F, 255.0F, 255.999F, 256.0F}) {
            for (const float z : {0.0F, 0.25F, 254.0F, 255.0F, 256.0F}) {
                CHECK(is_same(layer.at(x, z), stb_perlin_noise3(x, height, z, 0, 0, 0)));
            }
        }
    }
}

TEST_CASE("a grid of noise has the bits of its points") {
    const NoiseLayer layer(9.0F);
    // Steps from 1/100 of a lattice cell to several cells; x ends at the period, 256.
    for (const float step : {0.01F, 0.3F, 2.7F}) {
        std::vector<float> x;
        std::vector<float> z;
        for (int i = 0; i < 75; ++i) {
            x.push_back(256.0F - step * static_cast<float>(i));
            z.push_back(40.0F + step * static_cast<float>(i));
        }
        constexpr double kAmplitude = 3.7;
        std::vector<double> sums(x.size() * z.size(), 0.25);
        layer.add_grid(NoiseAxis(x), NoiseAxis(z), kAmplitude, sums);
        std::size_t different = 0;
        for (std::size_t i = 0; i < sums.size(); ++i) {
            const auto noise = static_cast<double>(layer.at(x[i % x.size()], z[i / x.size()]));
            different += sums[i] == 0.25 + kAmplitude * std::clamp(noise, -1.0, 1.0) ? 0U : 1U;
        }
        CHECK(different == 0);
    }
}
