// SPDX-License-Identifier: MIT
// Slow, direct implementations of the environments of kinds Shadow, Sky and Map, written from
// docs/language.md section 13 alone. They visit pyramids voxel by voxel, rays cell by cell, and
// every organ for every cell.
#pragma once

#include "runtime/base/exact_functions.h"
#include "runtime/environment/environment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

namespace lsys::slow {

using Voxel = std::array<std::int64_t, 3>;

inline std::vector<float> rounded(const std::vector<double>& numbers) {
    std::vector<float> result;
    for (const double number : numbers) {
        const auto narrow = static_cast<float>(number);
        result.push_back(narrow == 0.0F ? 0.0F : narrow);
    }
    return result;
}

/// Counts, for each layer, the pyramids that cover a voxel with this layer.
class Pyramids {
public:
    void add(const Voxel& tip, std::int64_t levels) {
        for (std::int64_t layer = 0; layer <= levels; ++layer) {
            for (std::int64_t u = -layer; u <= layer; ++u) {
                for (std::int64_t v = -layer; v <= layer; ++v) {
                    ++counts_[{tip[0] + u, tip[1] - layer, tip[2] + v, layer}];
                }
            }
        }
    }
    [[nodiscard]] std::int64_t count(const Voxel& voxel, std::int64_t layer) const {
        const auto found = counts_.find({voxel[0], voxel[1], voxel[2], layer});
        return found == counts_.end() ? 0 : found->second;
    }

private:
    std::map<std::array<std::int64_t, 4>, std::int64_t> counts_;
};

inline std::array<double, 4>
shadow_at(const Pyramids& pyramids, const Voxel& voxel, const BytecodeEnvironment& declared) {
    const double a = static_cast<double>(declared.strength);
    const double b = static_cast<double>(declared.ratio);
    double s = 0.0;
    std::array<double, 3> sums{};
    double power = 1.0;
    for (std::int64_t layer = 0; layer <= std::int64_t{declared.levels}; ++layer) {
        s += a * power * static_cast<double>(pyramids.count(voxel, layer));
        for (std::size_t axis = 0; axis < 3; ++axis) {
            std::array<std::int64_t, 4> d{}; // number by squared distance
            for (std::int64_t x = -1; x <= 1; ++x) {
                for (std::int64_t y = -1; y <= 1; ++y) {
                    for (std::int64_t z = -1; z <= 1; ++z) {
                        const std::int64_t side = axis == 0 ? x : axis == 1 ? y : z;
                        d[static_cast<std::size_t>(x * x + y * y + z * z)] +=
                            side *
                            pyramids.count({voxel[0] + x, voxel[1] + y, voxel[2] + z}, layer);
                    }
                }
            }
            sums[axis] +=
                power * (static_cast<double>(d[1]) + static_cast<double>(d[2]) / std::sqrt(2.0) +
                         static_cast<double>(d[3]) / std::sqrt(3.0));
        }
        power /= b;
    }
    std::array<double, 4> answer{std::max(0.0, 1.0 - s + a), 0.0, 0.0, 0.0};
    const double x = -a * sums[0];
    const double y = -a * sums[1];
    const double z = -a * sums[2];
    if (x != 0.0 || y != 0.0 || z != 0.0) {
        const double length = std::sqrt(x * x + y * y + z * z);
        answer = {answer[0], x / length, y / length, z / length};
    }
    return answer;
}

inline std::vector<float> shadow(const BytecodeEnvironment& declared,
                                 const std::vector<SensePlace>& places) {
    const double cell = static_cast<double>(declared.cell);
    const auto whole = [](double number) { return static_cast<std::int64_t>(std::floor(number)); };
    std::vector<Voxel> voxels;
    Pyramids pyramids;
    for (const SensePlace& place : places) {
        const auto& [x, y, z] = place.position;
        voxels.push_back(
            {whole(x / cell + 0.5), whole(y / cell + std::exp2(-20.0)), whole(z / cell + 0.5)});
        pyramids.add(voxels.back(), declared.levels);
    }
    std::vector<double> numbers;
    for (const Voxel& voxel : voxels) {
        const std::array<double, 4> answer = shadow_at(pyramids, voxel, declared);
        numbers.insert(numbers.end(), answer.begin(), answer.end());
    }
    return rounded(numbers);
}

inline Voxel sky_cell(const Vector3& point, double cell) {
    Voxel voxel{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        voxel[axis] = static_cast<std::int64_t>(std::floor(point[axis] / cell));
    }
    return voxel;
}

/// The optical depth along one ray, which ends above or beside all organs.
inline double sky_depth(const BytecodeEnvironment& declared,
                        const std::vector<SensedOrgan>& organs,
                        const Vector3& place,
                        const Vector3& direction) {
    const double cell = static_cast<double>(declared.cell);
    Voxel low{};
    Voxel high{};
    low.fill(INT64_MAX);
    high.fill(INT64_MIN);
    for (const SensedOrgan& organ : organs) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            low[axis] = std::min(low[axis], sky_cell(organ.middle, cell)[axis]);
            high[axis] = std::max(high[axis], sky_cell(organ.middle, cell)[axis]);
        }
    }
    Voxel at = sky_cell(place, cell);
    double passed = 0.0;
    double depth = 0.0;
    for (;;) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if ((direction[axis] >= 0.0 && at[axis] > high[axis]) ||
                (direction[axis] <= 0.0 && at[axis] < low[axis])) {
                return depth;
            }
        }
        std::size_t nearest = 0;
        std::array<double, 3> exits{INFINITY, INFINITY, INFINITY};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (direction[axis] != 0.0) {
                const std::int64_t plane = direction[axis] > 0.0 ? at[axis] + 1 : at[axis];
                exits[axis] = (static_cast<double>(plane) * cell - place[axis]) / direction[axis];
            }
            if (exits[axis] < exits[nearest]) {
                nearest = axis;
            }
        }
        const double path = std::max(0.0, exits[nearest] - passed);
        double area = 0.0;
        for (const SensedOrgan& organ : organs) {
            if (sky_cell(organ.middle, cell) == at) {
                area += organ.area;
            }
        }
        depth += static_cast<double>(declared.extinction) * area / (cell * cell * cell) * path;
        passed = std::max(passed, exits[nearest]);
        at[nearest] += direction[nearest] > 0.0 ? 1 : -1;
    }
}

inline std::vector<float> sky(const BytecodeEnvironment& declared,
                              const std::vector<SensedOrgan>& organs,
                              const std::vector<SensePlace>& places) {
    std::vector<double> numbers;
    for (const SensePlace& place : places) {
        double light = 0.0;
        double weights = 0.0;
        for (std::uint32_t i = 0; i < declared.directions; ++i) {
            const double s =
                (static_cast<double>(i) + 0.5) / static_cast<double>(declared.directions);
            const double azimuth = static_cast<double>(i) * 180.0 * (3.0 - std::sqrt(5.0));
            const double level = std::sqrt(1.0 - s * s);
            const Vector3 direction{level * exact_cosine_of_degrees(azimuth), s,
                                    level * exact_sine_of_degrees(azimuth)};
            light += s * exact_exp(-sky_depth(declared, organs, place.position, direction));
            weights += s;
        }
        numbers.push_back(light / weights);
    }
    return rounded(numbers);
}

/// The value of a pixel; outside of the picture, the value of the nearest pixel at the border.
inline double pixel(const EnvironmentPicture& picture, double column, double row) {
    const double last_column = static_cast<double>(picture.columns) - 1.0;
    const double last_row = static_cast<double>(picture.rows) - 1.0;
    const auto x = static_cast<std::size_t>(std::clamp(column, 0.0, last_column));
    const auto z = static_cast<std::size_t>(std::clamp(row, 0.0, last_row));
    return picture.values[z * picture.columns + x];
}

inline std::vector<float> map(const BytecodeEnvironment& declared,
                              const EnvironmentPicture& picture,
                              const std::vector<SensePlace>& places) {
    const auto wide = [](float number) { return static_cast<double>(number); };
    std::vector<double> numbers;
    for (const SensePlace& place : places) {
        // In pixels, from the centre of the first pixel.
        const double x =
            ((place.position[0] - wide(declared.at[0])) / wide(declared.size[0]) + 0.5) *
                static_cast<double>(picture.columns) -
            0.5;
        const double z =
            ((place.position[2] - wide(declared.at[1])) / wide(declared.size[1]) + 0.5) *
                static_cast<double>(picture.rows) -
            0.5;
        const double u = x - std::floor(x);
        const double v = z - std::floor(z);
        const double grey = (1.0 - v) * ((1.0 - u) * pixel(picture, std::floor(x), std::floor(z)) +
                                         u * pixel(picture, std::floor(x) + 1.0, std::floor(z))) +
                            v * ((1.0 - u) * pixel(picture, std::floor(x), std::floor(z) + 1.0) +
                                 u * pixel(picture, std::floor(x) + 1.0, std::floor(z) + 1.0));
        numbers.push_back(wide(declared.low) + (wide(declared.high) - wide(declared.low)) * grey);
    }
    return rounded(numbers);
}

} // namespace lsys::slow
