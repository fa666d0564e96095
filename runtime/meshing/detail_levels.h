// DetailLevels: a chain of meshes of one plant, each with a half to a third of the triangles of the
// one before, down to kMinDetailTriangles. The first steps have fewer sides and joints
// (MeshOptions::level); where these end, whole twigs and leaves are left out and the others
// enlarged; the last are crossed cards. What a level keeps, all finer levels keep. Made from the
// skeleton at rest; the same levels then fit every pose of it.
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
inline constexpr std::uint32_t kMaxDetailLevel = 24;
/// Pixels that the largest extent of a plant covers where its finest level is shown.
inline constexpr float kFinestPixels = 1024.0F;

/// One mesh of the chain.
struct DetailLevel {
    MeshOptions options;
    bool thinned = false;      // drawn from a thinned skeleton
    bool impostor = false;     // `triangles` of cards with pictures of the finest level
    double cover = 1.0;        // of impostors: opaque texels, in the area of the plant
    std::uint64_t paths = 0;   // of wood that stay, of thinned levels
    std::uint64_t foliage = 0; // objects and polygons that stay, of thinned levels
    float wood_scale = 1.0F; // of widths, of thinned levels: wood covers what it covers at level 0
    float foliage_scale = 1.0F; // the same of foliage
    /// Factor of linear colours of materials, or of the impostor's picture, for the mean colour of
    /// level 0; only with DetailChain::pictures, and where each part has one colour.
    glm::vec3 tint{1.0F};
    /// Colour of all materials before the tint, where those that stay lack a colour of level 0.
    std::optional<glm::vec3> colour = std::nullopt;
    std::uint64_t triangles = 0;
    /// Max pixels of the plant's largest extent for this level. Half a pixel then is the error
    /// allowed in the course of branches.
    float pixels = kFinestPixels;
    float error = 0.0F; // that half pixel in metres; 0 for the finest level
};

inline constexpr std::uint32_t kNoDetailLevel = ~std::uint32_t{0};

/// The levels to plan.
struct DetailChain {
    std::uint32_t last = kMaxDetailLevel; // the chain may end before
    /// For formats with pictures: the chain ends with an impostor, crossed cards with one picture
    /// and its normals, and materials of coarser levels have colours of their own.
    bool pictures = false;
    /// Coarser levels before this one, but for the last, get no scales and tints, which takes most
    /// of the time; kNoDetailLevel: none does, and fit_detail_levels() is called before they are
    /// meshed.
    std::uint32_t first_fitted = 0;
    /// Max number of levels. A longer chain keeps the finest, the coarsest, and others in about
    /// equal steps between; one level: the finest.
    std::uint32_t count = kMaxDetailLevel + 1;
};

struct ThinningOrder; // runtime/meshing/impl/thinning.h

struct DetailLevels {
    std::vector<DetailLevel> levels;            // at least the finest
    std::shared_ptr<const ThinningOrder> order; // null if no level is thinned
};

/// Plans the levels of `chain`. `options` are those of level 0; its level is added to the sides of
/// all. MeshMethod::Solid has level 0 only. Returns nothing when it is done, else the Stop of
/// make_mesh().
[[nodiscard]] std::optional<Stop> plan_detail_levels(const Skeleton& skeleton,
                                                     const std::vector<UserMesh>& user_meshes,
                                                     const MeshOptions& options,
                                                     const DetailChain& chain,
                                                     DetailLevels& levels);

/// Sets the scales and tints of the levels that are marked in `which`, and their exact numbers of
/// triangles. All but `levels` as given to plan_detail_levels(). Precondition: which.size() ==
/// levels.levels.size().
[[nodiscard]] std::optional<Stop> fit_detail_levels(const Skeleton& skeleton,
                                                    const std::vector<UserMesh>& user_meshes,
                                                    const MeshOptions& options,
                                                    const DetailChain& chain,
                                                    const std::vector<bool>& which,
                                                    DetailLevels& levels);

/// Makes the mesh of one level from `skeleton`: the planned one or a pose of it. Mesh::segments
/// refer to `skeleton`. `options`: arrays, threads and limit; the rest is that of the level.
/// Precondition: number < levels.levels.size().
[[nodiscard]] std::optional<Stop> make_detail_mesh(const Skeleton& skeleton,
                                                   const std::vector<UserMesh>& user_meshes,
                                                   const DetailLevels& levels,
                                                   std::size_t number,
                                                   const MeshOptions& options,
                                                   Mesh& mesh);

} // namespace lsys
