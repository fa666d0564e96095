// SPDX-License-Identifier: MIT
// NoiseLayer: a horizontal layer of stb_perlin's noise, with the same bits, in a third of the time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace lsys {

/// Places along one axis of a grid.
struct NoiseAxis {
    /// `places`: in lattice cells, from 0 to NoiseLayer::kPeriod.
    explicit NoiseAxis(std::span<const float> places);

    std::vector<std::uint32_t> cells; // lattice points below the places
    std::vector<float> offsets;       // distance of each place from its lattice point
    std::vector<float> weights;       // of the lattice points above the places
};

/// Perlin's improved noise (Perlin 2002) at an integral height. At such heights the lattice points
/// of the next height have weight 0, so four gradients suffice, not eight. The gradients of the
/// layer are measured once from stb_perlin and kept: 128 KiB, which copies share.
class NoiseLayer {
public:
    static constexpr std::uint32_t kPeriod = 256; // lattice cells after which the noise repeats

    /// The layer at `height`, an integer from 0 to 255.
    explicit NoiseLayer(float height);

    /// stb_perlin_noise3(x, height, z, 0, 0, 0) for x and z from 0 to kPeriod, in lattice cells.
    [[nodiscard]] float at(float x, float z) const;
    /// Adds `amplitude` times the noise, clamped to -1 to 1, at each point of a grid to `sums`,
    /// whose rows run along X. Yields the same bits as at(), but is faster where several points of
    /// a row lie in one lattice cell.
    void add_grid(const NoiseAxis& x,
                  const NoiseAxis& z,
                  double amplitude,
                  std::span<double> sums) const;

private:
    /// Horizontal part of the gradient at a lattice point: -1, 0 or 1 along each axis.
    struct Gradient {
        std::int8_t x = 0;
        std::int8_t z = 0;
    };
    using Lattice = std::array<Gradient, std::size_t{kPeriod} * kPeriod>; // in rows along Z

    /// The gradient at a lattice point; numbers from kPeriod on repeat.
    [[nodiscard]] const Gradient& gradient(std::uint32_t x, std::uint32_t z) const {
        return (*lattice_)[(x % kPeriod) * kPeriod + z % kPeriod];
    }

    std::shared_ptr<const Lattice> lattice_;
};

} // namespace lsys
