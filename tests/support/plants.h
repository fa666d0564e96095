// SPDX-License-Identifier: MIT
// Skeletons for tests, and the coverage of pictures by meshes.
#pragma once

#include "runtime/meshing/mesh.h"

#include <cstdint>
#include <random>

namespace lsys::test {

/// Draws segments, each from the tip of its parent.
class Plant {
public:
    struct Look {
        float base_radius = 0.1F;
        float tip_radius = 0.1F;
        std::uint16_t order = 0;
        std::uint16_t colour = 0;
        std::uint8_t sides = 8;
        float roll = 0.0F; // radians
    };

    /// Adds a segment along `direction` (not zero) from the parent's tip or the origin.
    std::uint32_t
    add(std::uint32_t parent, const glm::vec3& direction, float length, const Look& look);
    std::uint32_t add(std::uint32_t parent, const glm::vec3& direction, float length) {
        return add(parent, direction, length, Look{});
    }
    [[nodiscard]] const Skeleton& skeleton() const { return skeleton_; }
    [[nodiscard]] Skeleton& skeleton() { return skeleton_; }

private:
    Skeleton skeleton_;
};

/// Random numbers, equal with every standard library.
class RandomNumbers {
public:
    explicit RandomNumbers(std::uint32_t seed) : engine_(seed) {}
    [[nodiscard]] float uniform(float low, float high) {
        return low + (high - low) * static_cast<float>(engine_() >> 8) * (1.0F / 16777216.0F);
    }
    [[nodiscard]] std::uint32_t below(std::uint32_t bound) {
        return static_cast<std::uint32_t>(engine_()) % bound;
    }
    [[nodiscard]] glm::vec3 direction();

private:
    std::mt19937 engine_;
};

/// A tree with `orders` levels of branches, as tapering axes of several segments.
[[nodiscard]] Skeleton random_tree(std::uint32_t seed, std::uint32_t orders);

/// The number of pixels of a size x size picture of the square around `frame` that a mesh covers,
/// seen along -Z after a turn about +Y by `turn` radians.
[[nodiscard]] std::size_t
coverage(const Mesh& mesh, const Bounds& frame, std::uint32_t size, float turn);

} // namespace lsys::test
