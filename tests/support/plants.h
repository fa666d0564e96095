// SPDX-License-Identifier: MIT
// Skeletons for tests, and the number of pixels that meshes cover in pictures.
#pragma once

#include "runtime/meshing/mesh.h"

#include <cstdint>
#include <random>

namespace lsys::test {

/// Makes a skeleton segment by segment; each segment begins at the tip of its parent.
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

    /// Adds a segment in `direction` (not zero), from the tip of the parent or, without a parent,
    /// from the origin.
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

/// Random numbers that are the same with every standard library.
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

/// A tree with `orders` levels of branches. Each axis has several segments and tapers.
[[nodiscard]] Skeleton random_tree(std::uint32_t seed, std::uint32_t orders);

/// The number of pixels that a mesh covers in a picture of `size` by `size` pixels. The picture
/// shows the square around `frame`, seen along -Z after the mesh was turned about +Y by `turn`
/// radians.
[[nodiscard]] std::size_t
coverage(const Mesh& mesh, const Bounds& frame, std::uint32_t size, float turn);

} // namespace lsys::test
