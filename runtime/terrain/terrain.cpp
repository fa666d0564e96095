// SPDX-License-Identifier: MIT
#include "runtime/terrain/terrain.h"

#include "grammar/base/hash.h"
#include "runtime/base/random.h"
#include "runtime/terrain/impl/interpolate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

namespace lsys {

namespace {

constexpr double kPeriod = NoiseLayer::kPeriod; // lattice cells
/// Distance over which slopes are measured, as a fraction of the size of the finest feature.
/// Coordinates in the noise are exact to 2^-17 of a cell, which makes this distance uncertain by 1
/// in 2,000.
constexpr double kSlopePart = 1.0 / 32.0;
// m, about the resolution of binary32 coordinates far from the origin.
constexpr double kMinSlopeStep = 0.05;
/// Generation number of the random draws of terrains; no derivation reaches it.
constexpr std::uint32_t kTerrainGeneration = 0xFFFFFFFCu;

bool within(double value, double min, double max) {
    return value >= min && value <= max; // false for NaN
}

Result<void> check_noise(const NoiseOptions& options) {
    struct Bound {
        std::string_view name;
        double value;
        double min;
        double max;
    };
    const std::array<Bound, 6> bounds{
        Bound{"octaves", static_cast<double>(options.octaves), 1.0, kMaxOctaves},
        Bound{"lacunarity", options.lacunarity, 1.0, 8.0},
        Bound{"gain", options.gain, 0.0, 1.0},
        Bound{"feature size", options.feature, 1.0e-3, kMaxCoordinate},
        Bound{"height", options.height, 0.0, kMaxCoordinate},
        Bound{"base", options.base, -kMaxCoordinate, kMaxCoordinate},
    };
    for (const Bound& bound : bounds) {
        if (!within(bound.value, bound.min, bound.max)) {
            return Error{
                fmt::format("the {} of the terrain's noise is {}; it must be from {} to {}",
                            bound.name, bound.value, bound.min, bound.max)};
        }
    }
    return {};
}

Result<void> check_altitude(std::string_view name, double altitude) {
    if (!within(altitude, -kMaxCoordinate, kMaxCoordinate)) {
        return Error{fmt::format("the {} of the terrain is {} m; it must be from {} to {}", name,
                                 altitude, -kMaxCoordinate, kMaxCoordinate)};
    }
    return {};
}

/// `cells` modulo the period of the noise.
float wrapped(double cells) {
    return static_cast<float>(cells - kPeriod * std::floor(cells / kPeriod));
}

/// Max overshoot of a bicubic surface above its pixels, as a fraction of the pixels' range. The
/// weights of Catmull-Rom sum up to 1 and their absolute values to at most 1.25^2 = 1.5625, so the
/// positive weights sum up to at most 1.28125.
constexpr double kOvershoot = 0.28125;

} // namespace

Result<Terrain> Terrain::flat(const Region& region, double altitude) {
    if (const Result<void> checked = check_region(region); !checked) {
        return checked.error();
    }
    if (const Result<void> checked = check_altitude("altitude", altitude); !checked) {
        return checked.error();
    }
    Terrain terrain(region);
    terrain.base_ = altitude;
    return terrain;
}

Result<Terrain> Terrain::noise(const Region& region, const NoiseOptions& options) {
    if (const Result<void> checked = check_region(region); !checked) {
        return checked.error();
    }
    if (const Result<void> checked = check_noise(options); !checked) {
        return checked.error();
    }
    Terrain terrain(region);
    double frequency = 1.0 / options.feature;
    double amplitude = 1.0;
    double sum = 0.0;
    for (std::uint32_t number = 0; number < options.octaves; ++number) {
        // Each octave is shifted, because otherwise the zeros of all octaves would coincide.
        const PhiloxBlock words = draw_block(options.seed, kTerrainGeneration, number, 0);
        const auto layer = static_cast<float>(words[2] >> 24U);
        terrain.octaves_.push_back({frequency, static_cast<double>(words[0]) * (kPeriod * 0x1p-32),
                                    static_cast<double>(words[1]) * (kPeriod * 0x1p-32), layer,
                                    amplitude, NoiseLayer(layer)});
        sum += amplitude;
        terrain.slope_step_ = std::max(kMinSlopeStep, kSlopePart / frequency);
        frequency *= options.lacunarity;
        amplitude *= options.gain;
    }
    for (Octave& octave : terrain.octaves_) {
        octave.amplitude *= 0.5 * options.height / sum; // half the height, because noise is -1 to 1
    }
    terrain.base_ = options.base + 0.5 * options.height;
    return terrain;
}

Result<Terrain>
Terrain::height_map(const Region& region, GreyMap map, const HeightMapOptions& options) {
    if (const Result<void> checked = check_region(region); !checked) {
        return checked.error();
    }
    if (map.columns < 2 || map.rows < 2 ||
        map.values.size() != std::uint64_t{map.columns} * map.rows) {
        return Error{fmt::format("a height map of {} by {} pixels; it takes at least 2 by 2",
                                 map.columns, map.rows)};
    }
    const std::array<std::pair<std::string_view, double>, 2> altitudes{
        std::pair{std::string_view("lowest height"), options.lowest},
        std::pair{std::string_view("highest height"), options.highest}};
    for (const auto& [name, altitude] : altitudes) {
        if (const Result<void> checked = check_altitude(name, altitude); !checked) {
            return checked.error();
        }
    }
    Terrain terrain(region);
    terrain.base_ = options.lowest;
    terrain.map_scale_ = (options.highest - options.lowest) / 65535.0;
    const double cell = std::min(region.width / (map.columns - 1), region.depth / (map.rows - 1));
    terrain.slope_step_ = std::max(kMinSlopeStep, 0.5 * cell);
    terrain.map_ = std::move(map);
    terrain.filter_ = options.filter;
    return terrain;
}

double Terrain::noise_height(double x, double z) const {
    double height = 0.0;
    for (const Octave& octave : octaves_) {
        const float noise = octave.noise.at(wrapped(x * octave.frequency + octave.shift_x),
                                            wrapped(z * octave.frequency + octave.shift_z));
        height += octave.amplitude * std::clamp(static_cast<double>(noise), -1.0, 1.0);
    }
    return height;
}

double Terrain::map_height(double x, double z) const {
    const double column = (x - region_.x) / region_.width * (map_->columns - 1);
    const double row = (z - region_.z) / region_.depth * (map_->rows - 1);
    const double grey = filter_ == HeightFilter::Bicubic ? interpolate_bicubic(*map_, column, row)
                                                         : interpolate_bilinear(*map_, column, row);
    return map_scale_ * grey;
}

double Terrain::exact_height(double x, double z) const {
    if (map_) {
        return base_ + map_height(x, z);
    }
    return octaves_.empty() ? base_ : base_ + noise_height(x, z);
}

float Terrain::height(float x, float z) const {
    return static_cast<float>(exact_height(static_cast<double>(x), static_cast<double>(z)));
}

/// Adds noise_height() at each point of a grid to `sums`.
void Terrain::add_noise(std::span<const float> x,
                        std::span<const float> z,
                        std::span<double> sums) const {
    const auto axis = [](std::span<const float> places, double frequency, double shift) {
        std::vector<float> cells(places.size());
        std::transform(places.begin(), places.end(), cells.begin(), [&](float place) {
            return wrapped(static_cast<double>(place) * frequency + shift);
        });
        return NoiseAxis(cells);
    };
    for (const Octave& octave : octaves_) {
        octave.noise.add_grid(axis(x, octave.frequency, octave.shift_x),
                              axis(z, octave.frequency, octave.shift_z), octave.amplitude, sums);
    }
}

std::vector<float> Terrain::heights(std::span<const float> x, std::span<const float> z) const {
    std::vector<float> heights;
    heights.reserve(x.size() * z.size());
    if (map_) {
        for (const float at_z : z) {
            for (const float at_x : x) {
                heights.push_back(height(at_x, at_z));
            }
        }
        return heights;
    }
    std::vector<double> sums(x.size() * z.size());
    add_noise(x, z, sums);
    for (const double sum : sums) {
        heights.push_back(static_cast<float>(base_ + sum));
    }
    return heights;
}

std::array<double, 2> Terrain::altitudes() const {
    if (map_) {
        const auto [least, most] = std::minmax_element(map_->values.begin(), map_->values.end());
        const double a = base_ + map_scale_ * *least;
        const double b = base_ + map_scale_ * *most;
        const double over = filter_ == HeightFilter::Bicubic ? kOvershoot * std::abs(a - b) : 0.0;
        return {std::min(a, b) - over, std::max(a, b) + over};
    }
    double reach = 0.0;
    for (const Octave& octave : octaves_) {
        reach += octave.amplitude;
    }
    return {base_ - reach, base_ + reach};
}

std::uint64_t Terrain::digest() const {
    std::uint64_t state = combine_numbers(0, region_.x, region_.z, region_.width, region_.depth,
                                          base_, map_scale_, slope_step_, octaves_.size(), filter_);
    for (const Octave& octave : octaves_) {
        state = combine_numbers(state, octave.frequency, octave.shift_x, octave.shift_z,
                                octave.layer, octave.amplitude);
    }
    return finish(map_ ? combine_map(state, *map_) : state);
}

double Terrain::mesh_error(double cell) const {
    // A triangle with legs of `cell` along the axes is off by at most cell^2 / 8 times
    // |f_xx| + 2 |f_xz| + |f_zz|.
    double error = 0.0;
    for (const Octave& octave : octaves_) {
        // Upper bound for the noise of (|f_xx| + 2 |f_xz| + |f_zz|) / 8, with lengths in cells of
        // the noise; the largest measured value is 3.14.
        constexpr double kNoiseBend = 3.3;
        const double part = cell * octave.frequency;
        error += octave.amplitude * std::min(kNoiseBend * part * part, 2.0);
    }
    if (!map_) {
        return error;
    }
    const auto value = [&](std::uint32_t column, std::uint32_t row) {
        return static_cast<double>(map_->values[std::size_t{row} * map_->columns + column]);
    };
    double bend = 0.0; // max of |f_xx| + 2 |f_xz| + |f_zz|, from differences of pixels
    const auto [low, high] = std::minmax_element(map_->values.begin(), map_->values.end());
    for (std::uint32_t row = 0; row + 1 < map_->rows; ++row) {
        for (std::uint32_t column = 0; column + 1 < map_->columns; ++column) {
            const double here = value(column, row);
            const double right = value(column + 1, row);
            const double below = value(column, row + 1);
            double sum = 2.0 * std::abs(here - right - below + value(column + 1, row + 1));
            sum += column == 0 ? 0.0 : std::abs(value(column - 1, row) - 2.0 * here + right);
            sum += row == 0 ? 0.0 : std::abs(value(column, row - 1) - 2.0 * here + below);
            bend = std::max(bend, sum);
        }
    }
    const double pixel =
        std::min(region_.width / (map_->columns - 1), region_.depth / (map_->rows - 1));
    const double part = cell / pixel;
    // Between pixels a bilinear surface has creases, whose error is linear in the cell.
    const double bent = bend * std::max(part, part * part) / 2.0;
    const double range = filter_ == HeightFilter::Bicubic ? 1.0 + 2.0 * kOvershoot : 1.0;
    return std::abs(map_scale_) * std::min(bent, range * static_cast<double>(*high - *low));
}

std::array<double, 2> Terrain::gradient(float x, float z) const {
    if (!map_ && octaves_.empty()) {
        return {0.0, 0.0};
    }
    const auto px = static_cast<double>(x);
    const auto pz = static_cast<double>(z);
    const auto around = [&](double at, double lowest, double side) {
        const double half = 0.5 * slope_step_;
        return map_ ? std::array{std::clamp(at - half, lowest, lowest + side - half),
                                 std::clamp(at + half, lowest + half, lowest + side)}
                    : std::array{at - half, at + half};
    };
    const auto [left, right] = around(px, region_.x, region_.width);
    const auto [back, front] = around(pz, region_.z, region_.depth);
    return {(exact_height(right, pz) - exact_height(left, pz)) / (right - left),
            (exact_height(px, front) - exact_height(px, back)) / (front - back)};
}

glm::vec3 Terrain::normal(float x, float z) const {
    const auto [along_x, along_z] = gradient(x, z);
    const double length = std::sqrt(along_x * along_x + along_z * along_z + 1.0);
    return {static_cast<float>(-along_x / length), static_cast<float>(1.0 / length),
            static_cast<float>(-along_z / length)};
}

float Terrain::slope(float x, float z) const {
    const auto [along_x, along_z] = gradient(x, z);
    return static_cast<float>(std::sqrt(along_x * along_x + along_z * along_z));
}

} // namespace lsys
