// SPDX-License-Identifier: MIT
// Thinning: the order in which a plant loses its parts from level to level, and the skeleton of a
// level. Remaining parts are enlarged, so that the plant keeps its area and mean colour (Cook,
// Halstead, Planck and Ryu, "Stochastic simplification of aggregate detail", ACM TOG 26(3), 2007).
#pragma once

#include "runtime/meshing/mesh.h"
#include "runtime/turtle/skeleton.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace lsys {

/// A group of items of foliage that look alike: objects of one kind, mesh file and colour, or
/// polygons of one picture and colour.
struct FoliageGroup {
    bool is_polygons = false;                        // false: objects
    TurtleOperation kind = TurtleOperation::Nothing; // kind of the objects
    std::uint32_t mesh_file = 0;                     // mesh file of the objects
    std::uint64_t organ_triangles = 0; // of an organ at level 0, estimated; 0 for other objects
};

/// The ranks of all parts of a plant; parts of low rank stay longest. Items of foliage are numbered
/// together: objects, then polygons.
struct ThinningOrder {
    /// Per segment: the rank of its path. A path goes from the branching point at its parent path
    /// to the tip that is farthest along the wood. Paths with the most wood come first. Each path
    /// comes after its parent, so the first n paths are connected for every n.
    LargeVector<std::uint32_t> path_ranks;
    std::vector<std::uint16_t> path_orders; // by rank: number of ancestors of the path
    /// Items of foliage by rank, in random order: the first n items contain about the same fraction
    /// of each group, for every n.
    LargeVector<std::uint32_t> foliage;
    LargeVector<std::uint32_t> group_of; // per item of foliage
    std::vector<FoliageGroup> groups;

    [[nodiscard]] std::uint64_t path_count() const { return path_orders.size(); }
};
[[nodiscard]] ThinningOrder thinning_order(const Skeleton& skeleton);

/// Area of the outline of a segment, seen from the side.
[[nodiscard]] double outline_area(const Segment& segment);

/// Measures of the shape of a group.
struct FoliageShape {
    std::uint64_t triangles = 0;
    double area = 0.0;  // m^2, area of all triangles at size 1
    glm::vec3 centre{}; // centroid of this area
};
/// Shapes of the groups at MeshOptions::level `level`; polygons have none.
[[nodiscard]] std::vector<FoliageShape> foliage_shapes(const ThinningOrder& order,
                                                       const std::vector<UserMesh>& user_meshes,
                                                       std::uint32_t level);

/// The parts of a plant that a level keeps.
struct Thinning {
    std::uint64_t paths = ~std::uint64_t{0};   // number of paths kept, by rank
    std::uint64_t foliage = ~std::uint64_t{0}; // number of items of foliage kept, by rank
    float max_radius = 0.0F;                   // m, max radius to which thin wood is widened
    float wood_scale = 1.0F;                   // factor of all widths, applied after widening
    float foliage_scale = 1.0F;                // factor of the size of foliage
};

/// Makes `thin` from `skeleton`, which is the skeleton of `order` in any pose. Thin wood is widened
/// until its area is the area of all wood, or its radius is Thinning::max_radius; foliage is scaled
/// about the centres of its items. `fine` and `coarse`: shapes of the finest level and of this
/// level. `segments`: for each segment of `thin`, its number in `skeleton`.
void thin_skeleton(const Skeleton& skeleton,
                   const ThinningOrder& order,
                   const Thinning& thinning,
                   std::span<const FoliageShape> fine,
                   std::span<const FoliageShape> coarse,
                   Skeleton& thin,
                   LargeVector<std::uint32_t>& segments);

} // namespace lsys
