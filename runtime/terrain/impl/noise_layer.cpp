// SPDX-License-Identifier: MIT
#include "runtime/terrain/noise_layer.h"

#include <cmath>
#include <stb/stb_perlin.h>

namespace lsys {

namespace {

/// Weight of the far lattice point at a fraction of a cell, with the order of operations of
/// stb_perlin.
float fade(float a) {
    return ((a * 6.0F - 15.0F) * a + 10.0F) * a * a * a;
}

float mix(float a, float b, float part) {
    return a + (b - a) * part;
}

} // namespace

NoiseLayer::NoiseLayer(float height) {
    // Near a lattice point the noise is its gradient times the distance, up to a part of the cube of
    // the distance. The two distances differ so much that one value shows both components.
    constexpr float kNear = 0x1p-7F;
    constexpr float kNearest = 0x1p-12F;
    const auto lattice = std::make_shared<Lattice>();
    for (std::uint32_t x = 0; x < kPeriod; ++x) {
        for (std::uint32_t z = 0; z < kPeriod; ++z) {
            const float value = stb_perlin_noise3(static_cast<float>(x) + kNear, height,
                                                  static_cast<float>(z) + kNearest, 0, 0, 0);
            const float along_x = std::round(value / kNear);
            const float along_z = std::round((value - along_x * kNear) / kNearest);
            (*lattice)[x * kPeriod + z] = {static_cast<std::int8_t>(along_x),
                                           static_cast<std::int8_t>(along_z)};
        }
    }
    lattice_ = lattice;
}

float NoiseLayer::at(float x, float z) const {
    const auto cell_x = static_cast<std::uint32_t>(x);
    const auto cell_z = static_cast<std::uint32_t>(z);
    const float part_x = x - static_cast<float>(cell_x);
    const float part_z = z - static_cast<float>(cell_z);
    const auto product = [&](std::uint32_t to_x, std::uint32_t to_z) {
        const Gradient& gradient =
            (*lattice_)[((cell_x + to_x) % kPeriod) * kPeriod + (cell_z + to_z) % kPeriod];
        return static_cast<float>(gradient.x) * (part_x - static_cast<float>(to_x)) +
               static_cast<float>(gradient.z) * (part_z - static_cast<float>(to_z));
    };
    const float weight_z = fade(part_z);
    return mix(mix(product(0, 0), product(0, 1), weight_z),
               mix(product(1, 0), product(1, 1), weight_z), fade(part_x));
}

} // namespace lsys
