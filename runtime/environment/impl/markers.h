// SPDX-License-Identifier: MIT
// Markers: the points of an environment of kind Space, drawn once per derivation
// (docs/language.md section 13).
#pragma once

#include "runtime/base/large_vector.h"
#include "runtime/environment/environment.h"
#include "runtime/environment/impl/triangle_tree.h"

#include <array>
#include <cstdint>
#include <optional>

namespace lsys {

/// A marker, by the draws of its point.
struct Marker {
    std::array<float, 3> units{}; // u of x, y, z, in [0, 1)
    std::uint32_t index = 0;      // below the declared count
};

/// The box and the shape that hold the markers.
class MarkerShape {
public:
    /// All arguments must outlive the shape. `crown`: for SpaceShape::Mesh, the tree of the mesh,
    /// already moved to its place; else null.
    MarkerShape(const BytecodeEnvironment& declared,
                const EnvironmentMesh* mesh,
                const TriangleTree* crown);

    /// low + u (high - low) along each axis, in binary64.
    [[nodiscard]] Vector3 position(const std::array<float, 3>& units) const {
        Vector3 position;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            position[axis] = low_[axis] + static_cast<double>(units[axis]) * extent_[axis];
        }
        return position;
    }
    /// Whether the point is inside. Ball, dome and cone are tested in coordinates of the box: with
    /// X = 2 u - 1, Z likewise, and Y = 2 u - 1 for a ball and u for the others, a ball and a dome
    /// are (X^2 + Y^2) + Z^2 <= 1, a cone X^2 + Z^2 <= (1 - Y)^2.
    [[nodiscard]] bool holds(const std::array<float, 3>& units) const;

private:
    SpaceShape shape_;
    const TriangleTree* crown_;
    Vector3 low_{};    // low corner of the bounding box
    Vector3 extent_{}; // high - low
};

/// Key of the draws of an environment.
struct MarkerKey {
    std::uint64_t seed = 0;
    std::uint32_t number = 0; // index of the environment in Bytecode::environments
};

/// Max points that are tried for one marker.
inline constexpr std::uint64_t kMarkerTries = 64;

/// For each marker i below `count`, the first of the points 64 i ... 64 i + 63 that is in `shape`;
/// markers without such a point are missing. By ascending index. No value when cancelled.
[[nodiscard]] std::optional<LargeVector<Marker>> draw_markers(const MarkerShape& shape,
                                                              std::uint32_t count,
                                                              const MarkerKey& key,
                                                              const EnvironmentContext& context);

/// Indexes of the markers by cells of a grid in Morton order (Morton 1966), so that markers near
/// each other are next to each other.
[[nodiscard]] LargeVector<std::uint32_t> order_in_space(const LargeVector<Marker>& markers);

} // namespace lsys
