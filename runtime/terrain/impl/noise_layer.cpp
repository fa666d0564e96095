// SPDX-License-Identifier: MIT
#include "runtime/terrain/noise_layer.h"

#include <algorithm>
#include <cmath>
#include <stb/stb_perlin.h>

namespace lsys {

namespace {

/// Weight of the lattice point above a place at the fraction `a` of a cell, with the order of
/// operations of stb_perlin.
float fade(float a) {
    return ((a * 6.0F - 15.0F) * a + 10.0F) * a * a * a;
}

float mix(float a, float b, float part) {
    return a + (b - a) * part;
}

/// Consecutive points of a row of the grid that lie in one lattice cell.
struct NoiseRun {
    const float* offsets; // NoiseAxis::offsets along X
    const float* weights; // NoiseAxis::weights along X
    double* sums;         // to which the noise is added
    std::size_t count;    // number of points
};

/// Contribution of a lattice point to the noise along a row: along_x * (distance along X) + rest.
struct RowProduct {
    float along_x;
    float rest; // z component of the gradient times the distance along Z
};

/// The four lattice points of a cell, named near or far first along X, then along Z, and the
/// constants of a row. Near points are at or below the points of the row, far points next above.
struct RowCell {
    RowProduct near_near;
    RowProduct near_far;
    RowProduct far_near;
    RowProduct far_far;
    float weight_z; // weight of the lattice points that are far along Z
    double amplitude;
};

[[gnu::always_inline]] inline void add_run_inline(const RowCell& cell, const NoiseRun& run) {
    for (std::size_t i = 0; i < run.count; ++i) {
        const float near = run.offsets[i];
        const float far = near - 1.0F;
        const float low = mix(cell.near_near.along_x * near + cell.near_near.rest,
                              cell.near_far.along_x * near + cell.near_far.rest, cell.weight_z);
        const float high = mix(cell.far_near.along_x * far + cell.far_near.rest,
                               cell.far_far.along_x * far + cell.far_far.rest, cell.weight_z);
        const auto noise = static_cast<double>(mix(low, high, run.weights[i]));
        run.sums[i] += cell.amplitude * std::clamp(noise, -1.0, 1.0);
    }
}

void add_run_plain(const RowCell& cell, const NoiseRun& run) {
    add_run_inline(cell, run);
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void add_run_avx2(const RowCell& cell, const NoiseRun& run) {
    add_run_inline(cell, run);
}

const auto add_run = __builtin_cpu_supports("avx2") != 0 ? add_run_avx2 : add_run_plain;
#else
constexpr auto add_run = add_run_plain;
#endif

} // namespace

NoiseAxis::NoiseAxis(std::span<const float> places) {
    for (const float place : places) {
        cells.push_back(static_cast<std::uint32_t>(place));
        offsets.push_back(place - static_cast<float>(cells.back()));
        weights.push_back(fade(offsets.back()));
    }
}

NoiseLayer::NoiseLayer(float height) {
    // Near a lattice point the noise is the dot product of gradient and distance, up to an error of
    // third order. The distance along X is 32 times the distance along Z, so that one noise value
    // determines both components of the gradient.
    constexpr float kNear = 0x1p-7F;     // distance along X, in lattice cells
    constexpr float kNearest = 0x1p-12F; // distance along Z, in lattice cells
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
        const Gradient& there = gradient(cell_x + to_x, cell_z + to_z);
        return static_cast<float>(there.x) * (part_x - static_cast<float>(to_x)) +
               static_cast<float>(there.z) * (part_z - static_cast<float>(to_z));
    };
    const float weight_z = fade(part_z);
    return mix(mix(product(0, 0), product(0, 1), weight_z),
               mix(product(1, 0), product(1, 1), weight_z), fade(part_x));
}

void NoiseLayer::add_grid(const NoiseAxis& x,
                          const NoiseAxis& z,
                          double amplitude,
                          std::span<double> sums) const {
    const std::size_t columns = x.cells.size();
    for (std::size_t row = 0; row < z.cells.size(); ++row) {
        const float near = z.offsets[row];
        const float far = near - 1.0F;
        for (std::size_t first = 0; first < columns;) {
            const std::uint32_t cell = x.cells[first];
            std::size_t end = first + 1;
            while (end < columns && x.cells[end] == cell) {
                ++end;
            }
            const auto product = [&](std::uint32_t to_x, std::uint32_t to_z) -> RowProduct {
                const Gradient& there = gradient(cell + to_x, z.cells[row] + to_z);
                return {static_cast<float>(there.x),
                        static_cast<float>(there.z) * (to_z == 0 ? near : far)};
            };
            add_run(
                {product(0, 0), product(0, 1), product(1, 0), product(1, 1), z.weights[row],
                 amplitude},
                {&x.offsets[first], &x.weights[first], &sums[row * columns + first], end - first});
            first = end;
        }
    }
}

} // namespace lsys
