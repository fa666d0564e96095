// Thinning: the order in which a plant loses its parts from level to level, and the skeleton that
// is left. What remains is enlarged, so that area and mean colour stay (Cook, Halstead, Planck and
// Ryu, "Stochastic simplification of aggregate detail", ACM TOG 26(3), 2007).
#pragma once

#include "runtime/meshing/mesh.h"
#include "runtime/turtle/skeleton.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace lsys {

/// Items of foliage that look alike: objects of a kind, file and colour, or polygons of a picture
/// and a colour.
struct FoliageGroup {
    bool polygons = false;
    TurtleOperation kind = TurtleOperation::Nothing; // of objects
    std::uint32_t mesh_file = 0;                     // of objects
};

/// The order in which parts of a plant stay longest. Items of foliage are numbered: objects, then
/// polygons.
struct ThinningOrder {
    /// Per segment: the rank of its path. A path goes from where it leaves its parent to the tip
    /// that is farthest along the wood. The first paths carry most wood; each comes after its
    /// parent, so any number of first paths is connected.
    LargeVector<std::uint32_t> path_ranks;
    std::vector<std::uint16_t> path_orders; // by rank: number of paths between it and the root
    /// Items of foliage by rank, at random: the items up to any rank are about the same part of
    /// each group.
    LargeVector<std::uint32_t> foliage;
    LargeVector<std::uint32_t> group_of; // per item of foliage
    std::vector<FoliageGroup> groups;

    [[nodiscard]] std::uint64_t path_count() const { return path_orders.size(); }
};
[[nodiscard]] ThinningOrder thinning_order(const Skeleton& skeleton);

/// Area of the outline of a segment seen from its side.
[[nodiscard]] double outline_area(const Segment& segment);

/// Measures of the shape of a group.
struct FoliageShape {
    std::uint64_t triangles = 0;
    double area = 0.0;  // of all triangles at size 1
    glm::vec3 centre{}; // of that area
};
/// Shapes of the groups at MeshOptions::level `level`; polygons have none.
[[nodiscard]] std::vector<FoliageShape> foliage_shapes(const ThinningOrder& order,
                                                       const std::vector<UserMesh>& user_meshes,
                                                       std::uint32_t level);

/// The parts of a plant that a level keeps.
struct Thinning {
    std::uint64_t paths = ~std::uint64_t{0};   // number of first paths
    std::uint64_t foliage = ~std::uint64_t{0}; // number of first items of foliage
    float max_radius = 0.0F;                   // m, to which thin wood may be widened
    float wood_scale = 1.0F;                   // factor of all widths after that
    float foliage_scale = 1.0F;                // factor of the size of foliage
};

/// Makes `thin` from `skeleton`, which has the items of the skeleton of `order` in any pose. Thin
/// wood is widened up to the area of all wood, within Thinning::max_radius; foliage grows about its
/// centres. `fine` and `coarse`: shapes of the finest level and of this one. `segments`: for each
/// segment that stays, its number in `skeleton`.
void thin_skeleton(const Skeleton& skeleton,
                   const ThinningOrder& order,
                   const Thinning& thinning,
                   std::span<const FoliageShape> fine,
                   std::span<const FoliageShape> coarse,
                   Skeleton& thin,
                   LargeVector<std::uint32_t>& segments);

} // namespace lsys
