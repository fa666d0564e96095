// SPDX-License-Identifier: MIT
#include "tests/reference/environments/shadow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace lsys::reference {

namespace {

using Voxel = std::array<std::int64_t, 3>;
// The voxel and the layer.
using VoxelOfLayer = std::array<std::int64_t, 4>;

struct VoxelHash {
    std::size_t operator()(const VoxelOfLayer& key) const {
        std::uint64_t hash = 0;
        for (const std::int64_t number : key) {
            hash = (hash ^ static_cast<std::uint64_t>(number)) * 0x9E3779B97F4A7C15U;
            hash ^= hash >> 29U;
        }
        return hash;
    }
};

// Counts, for each voxel and layer, the pyramids that cover the voxel with this layer.
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
    std::unordered_map<VoxelOfLayer, std::int64_t, VoxelHash> counts_;
};

// Throws NoAnswer for an index beyond +-2^31.
std::int64_t index_of(double number, std::size_t place) {
    const double index = std::floor(number);
    if (!(std::fabs(index) <= 2147483648.0)) {
        throw NoAnswer{place};
    }
    return static_cast<std::int64_t>(index);
}

// The counts of the neighbours at +1 along `axis` minus those at -1, by squared distance.
std::array<double, 4>
differences(const Pyramids& pyramids, const Voxel& voxel, std::size_t axis, std::int64_t layer) {
    std::array<double, 4> sums{};
    for (std::int64_t x = -1; x <= 1; ++x) {
        for (std::int64_t y = -1; y <= 1; ++y) {
            for (std::int64_t z = -1; z <= 1; ++z) {
                const std::int64_t side = Voxel{x, y, z}[axis];
                const auto squared = static_cast<std::size_t>(x * x + y * y + z * z);
                const Voxel neighbour = {voxel[0] + x, voxel[1] + y, voxel[2] + z};
                sums[squared] += static_cast<double>(side * pyramids.count(neighbour, layer));
            }
        }
    }
    return sums;
}

std::vector<double>
shadow_answer(const Shadow& shadow, const Pyramids& pyramids, const Voxel& voxel) {
    double sum = 0;
    Vector slope{};
    double weight = 1; // b^-l
    for (std::int64_t layer = 0; layer <= shadow.levels; ++layer) {
        const std::int64_t count = pyramids.count(voxel, layer);
        if (count != 0) {
            sum += shadow.strength * weight * static_cast<double>(count);
        }
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::array<double, 4> d = differences(pyramids, voxel, axis, layer);
            if (d[1] != 0 || d[2] != 0 || d[3] != 0) {
                slope[axis] += weight * (d[1] + d[2] / std::sqrt(2.0) + d[3] / std::sqrt(3.0));
            }
        }
        weight /= shadow.ratio;
    }
    Vector direction{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        direction[axis] = -shadow.strength * slope[axis];
    }
    direction = unit(direction);
    const double exposure = std::max(0.0, (1.0 - sum) + shadow.strength);
    return {exposure, direction[0], direction[1], direction[2]};
}

} // namespace

Answers shadow_answers(const Shadow& shadow, const std::vector<Place>& places) {
    std::vector<Voxel> voxels;
    Pyramids pyramids;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const auto& [x, y, z] = places[i].position;
        voxels.push_back({index_of(x / shadow.cell + 0.5, i),
                          index_of(y / shadow.cell + std::exp2(-20.0), i),
                          index_of(z / shadow.cell + 0.5, i)});
        pyramids.add(voxels.back(), shadow.levels);
    }
    Answers answers;
    for (const Voxel& voxel : voxels) {
        answers.push_back(shadow_answer(shadow, pyramids, voxel));
    }
    return answers;
}

} // namespace lsys::reference
