// SPDX-License-Identifier: MIT
// DetailLevels: a chain of meshes of one plant. Each has a half to a third of the triangles of the
// mesh before it; the last has at most kMinDetailTriangles. The first levels have fewer sides and
// joints (MeshOptions::level); coarser levels leave out whole twigs and leaves and enlarge the
// others; the last levels are crossed cards. A finer level keeps every part that a coarser level
// keeps. Made from the skeleton at rest; the levels then fit every pose of this skeleton.
#pragma once

#include "runtime/meshing/mesh.h"
#include "runtime/turtle/skeleton.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace lsys {

/// Chains end with the first level of at most this many triangles.
inline constexpr std::uint64_t kMinDetailTriangles = 50;
/// Max number of the coarsest level; the finest level has number 0.
inline constexpr std::uint32_t kMaxDetailLevel = 24;
/// Size on screen, in pixels of the plant's largest extent, for which the finest level is made.
inline constexpr float kFinestPixels = 1024.0F;

/// One mesh of the chain.
struct DetailLevel {
    MeshOptions options;
    bool is_thinned = false;   // drawn from a thinned skeleton
    bool is_impostor = false;  // drawn as cards with pictures of the finest level
    double cover = 1.0;        // impostors: area of opaque texels / area of the plant
    std::uint64_t paths = 0;   // thinned levels: number of paths of wood that stay
    std::uint64_t foliage = 0; // thinned levels: number of objects and polygons that stay
    /// Thinned levels: factors of the widths of wood and of the size of foliage. With these factors
    /// wood and foliage cover the same area of a picture as at level 0.
    float wood_scale = 1.0F;
    float foliage_scale = 1.0F;
    /// Factor of the linear colours of materials, or of the picture of the impostor, that brings
    /// the mean colour of the level to that of level 0: 0.25 to 4 for each component, or exactly 1
    /// if it is nearer than 0.002 to 1. Impostors that are fitted always get one, other levels only
    /// with DetailChain::pictures. A mesh with a part of several colours is drawn without it.
    glm::vec3 tint{1.0F};
    /// Colour of all materials before the tint. Set if no moderate tint gives the materials that
    /// stay the mean colour of level 0.
    std::optional<glm::vec3> colour = std::nullopt;
    std::uint64_t triangles = 0;
    /// Max size on screen for this level, in pixels of the plant's largest extent. At this size the
    /// axes of branches may be off by half a pixel.
    float pixels = kFinestPixels;
    float error = 0.0F; // m, half a pixel at the size `pixels`; 0 for the finest level
};

inline constexpr std::uint32_t kNoDetailLevel = ~std::uint32_t{0};

/// Which levels to plan.
struct DetailChain {
    std::uint32_t last = kMaxDetailLevel; // max number of the last level
    /// For formats with pictures: the chain ends with an impostor, crossed cards with one picture
    /// and its normals, and materials of coarser levels have colours of their own.
    bool pictures = false;
    /// Levels from this number on, and the last level, get scales and tints; computing these takes
    /// most of the time. kNoDetailLevel: no level gets any, and fit_detail_levels() must be called
    /// before the levels are meshed.
    std::uint32_t first_fitted = 0;
    /// Max number of levels. Of a longer chain the finest level, the coarsest level and levels in
    /// about equal steps between these two are kept. 1: the finest level only.
    std::uint32_t count = kMaxDetailLevel + 1;
};

struct ThinningOrder; // runtime/meshing/impl/thinning.h

struct DetailLevels {
    std::vector<DetailLevel> levels;            // at least the finest
    std::shared_ptr<const ThinningOrder> order; // null if no level is thinned
};

/// Plans the levels of `chain`. `options` are those of level 0; no level has a smaller
/// MeshOptions::level. MeshMethod::Solid has level 0 only. Returns the Stop of make_mesh() on
/// failure.
[[nodiscard]] std::optional<Stop> plan_detail_levels(const Skeleton& skeleton,
                                                     const std::vector<UserMesh>& user_meshes,
                                                     const MeshOptions& options,
                                                     const DetailChain& chain,
                                                     DetailLevels& levels);

/// Sets the scales and tints of the levels that are marked in `which`, and their exact numbers of
/// triangles. The arguments other than `levels` and `which` are those of plan_detail_levels().
/// Precondition: which.size() == levels.levels.size().
[[nodiscard]] std::optional<Stop> fit_detail_levels(const Skeleton& skeleton,
                                                    const std::vector<UserMesh>& user_meshes,
                                                    const MeshOptions& options,
                                                    const DetailChain& chain,
                                                    const std::vector<bool>& which,
                                                    DetailLevels& levels);

/// Makes the mesh of one level from `skeleton`, which is the planned skeleton or a pose of it.
/// Mesh::segments refers to `skeleton`. Of `options`, only the requested arrays, `threads` and
/// `max_bytes` are used; the level sets all other options. Precondition: number <
/// levels.levels.size().
[[nodiscard]] std::optional<Stop> make_detail_mesh(const Skeleton& skeleton,
                                                   const std::vector<UserMesh>& user_meshes,
                                                   const DetailLevels& levels,
                                                   std::size_t number,
                                                   const MeshOptions& options,
                                                   Mesh& mesh);

} // namespace lsys
