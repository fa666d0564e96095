// SPDX-License-Identifier: MIT
#include "runtime/meshing/detail_levels.h"

#include "runtime/base/out_of_memory.h"
#include "runtime/meshing/impl/detail_planner.h"
#include "runtime/meshing/impl/impostor.h"
#include "runtime/meshing/impl/thinning.h"

#include <glm/common.hpp>

#include <algorithm>
#include <optional>
#include <vector>

namespace lsys {

namespace {

// Max ratio of the radius of widened wood to DetailLevel::error: the wood is then two pixels wide.
constexpr float kMaxRadiusErrors = 2.0F;

/// Whether no part has vertices of different colours.
bool has_plain_parts(const Mesh& mesh) {
    if (mesh.colours.empty()) {
        return true;
    }
    TriangleReader indices(mesh.indices);
    for (const MeshPart& part : mesh.parts) {
        const ItemColour own = mesh.colours[indices[part.first_index]];
        for (std::uint64_t i = 1; i < part.index_count; ++i) {
            if (mesh.colours[indices[part.first_index + i]] != own) {
                return false;
            }
        }
    }
    return true;
}

} // namespace

std::uint64_t triangles_of(const Mesh& mesh) {
    std::uint64_t count = 0;
    for (const MeshPart& part : mesh.parts) {
        count += part.index_count / 3;
    }
    return count;
}

Thinning thinning_of(const DetailLevel& level) {
    return {.paths = level.paths,
            .foliage = level.foliage,
            .max_radius = kMaxRadiusErrors * level.error,
            .wood_scale = level.wood_scale,
            .foliage_scale = level.foliage_scale};
}

void colour_materials(const DetailLevel& level, Mesh& mesh) {
    if ((level.tint == glm::vec3(1.0F) && !level.colour) || !has_plain_parts(mesh)) {
        return;
    }
    mesh.colours.clear();
    for (Material& material : mesh.materials) {
        const glm::vec3 own = level.colour.value_or(glm::vec3(material.colour));
        material.colour = glm::vec4(glm::min(level.tint * own, 1.0F), material.colour.a);
    }
}

namespace {

/// Makes the impostor of a pose, with the arrays that `options` request.
std::optional<Stop> make_impostor(const Skeleton& skeleton,
                                  const std::vector<UserMesh>& user_meshes,
                                  const MeshOptions& options,
                                  const DetailLevel& level,
                                  Mesh& mesh) {
    MeshOptions bake_options = options;
    bake_options.texture_coordinates = true;
    bake_options.tangents = false;
    bake_options.colours = true;
    bake_options.segments = false;
    if (const std::optional<Stop> stop = make_mesh(skeleton, user_meshes, bake_options, mesh)) {
        return stop;
    }
    return catch_out_of_memory(
        [&]() -> std::optional<Stop> {
            mesh = ImpostorBaker(mesh, level.pixels, level.triangles).make(level.cover, level.tint);
            if (!options.tangents) {
                mesh.tangents.clear();
            }
            if (options.colours) {
                mesh.colours.resize(mesh.positions.size());
                std::fill(mesh.colours.begin(), mesh.colours.end(), ItemColour{0});
            }
            if (options.segments) {
                mesh.segments.resize(mesh.positions.size());
                std::fill(mesh.segments.begin(), mesh.segments.end(),
                          VertexSegments{kNoSegment, kNoSegment});
            }
            return std::nullopt;
        },
        [&] {
            mesh = {};
            return Stop::OutOfMemory;
        });
}

/// Keeps `count` levels, at least 2: the first, the last, and the levels nearest to equal steps
/// between these two.
void spread_levels(std::size_t count, std::vector<DetailLevel>& levels) {
    if (levels.size() <= count) {
        return;
    }
    const std::size_t steps = count - 1;
    for (std::size_t k = 1; k < count; ++k) {
        levels[k] = levels[(2 * k * (levels.size() - 1) + steps) / (2 * steps)];
    }
    levels.resize(count);
}

/// Whether `which` marks a level other than the finest.
bool fits_any(const std::vector<bool>& which) {
    return which.size() > 1 && std::find(which.begin() + 1, which.end(), true) != which.end();
}

} // namespace

std::optional<Stop> plan_detail_levels(const Skeleton& skeleton,
                                       const std::vector<UserMesh>& user_meshes,
                                       const MeshOptions& options,
                                       const DetailChain& chain,
                                       DetailLevels& levels) {
    levels = {};
    if (chain.last == 0 || chain.count <= 1 || options.method == MeshMethod::Solid) {
        levels.levels.push_back({.options = options});
        return std::nullopt;
    }
    return catch_out_of_memory(
        [&] {
            const auto order = std::make_shared<const ThinningOrder>(thinning_order(skeleton));
            levels.order = order;
            DetailPlanner planner(skeleton, user_meshes, options, *order);
            if (const std::optional<Stop> stop = planner.plan(chain, levels)) {
                return std::optional(*stop);
            }
            spread_levels(chain.count, levels.levels);
            const std::size_t last = levels.levels.size() - 1;
            std::vector<bool> fitted_levels(levels.levels.size());
            for (std::size_t k = 0; k <= last && chain.first_fitted != kNoDetailLevel; ++k) {
                fitted_levels[k] = k >= std::min<std::size_t>(chain.first_fitted, last);
            }
            return fits_any(fitted_levels) ? planner.fit(chain, fitted_levels, levels)
                                           : std::nullopt;
        },
        [&] {
            levels = {};
            return Stop::OutOfMemory;
        });
}

std::optional<Stop> fit_detail_levels(const Skeleton& skeleton,
                                      const std::vector<UserMesh>& user_meshes,
                                      const MeshOptions& options,
                                      const DetailChain& chain,
                                      const std::vector<bool>& which,
                                      DetailLevels& levels) {
    if (!fits_any(which)) {
        return std::nullopt;
    }
    return catch_out_of_memory(
        [&] {
            return DetailPlanner(skeleton, user_meshes, options, *levels.order)
                .fit(chain, which, levels);
        },
        [&] {
            levels = {};
            return Stop::OutOfMemory;
        });
}

std::optional<Stop> make_detail_mesh(const Skeleton& skeleton,
                                     const std::vector<UserMesh>& user_meshes,
                                     const DetailLevels& levels,
                                     std::size_t number,
                                     const MeshOptions& options,
                                     Mesh& mesh) {
    const DetailLevel& level = levels.levels[number];
    MeshOptions all = level.options;
    all.texture_coordinates = options.texture_coordinates;
    all.tangents = options.tangents;
    all.colours = options.colours;
    all.segments = options.segments;
    all.threads = options.threads;
    all.max_bytes = options.max_bytes;
    if (level.is_impostor) {
        return make_impostor(skeleton, user_meshes, all, level, mesh);
    }
    if (!level.is_thinned) {
        const std::optional<Stop> stop = make_mesh(skeleton, user_meshes, all, mesh);
        colour_materials(level, mesh);
        return stop;
    }
    return catch_out_of_memory(
        [&]() -> std::optional<Stop> {
            const ThinningOrder& order = *levels.order;
            Skeleton thin;
            LargeVector<std::uint32_t> numbers;
            thin_skeleton(skeleton, order, thinning_of(level),
                          foliage_shapes(order, user_meshes, levels.levels[0].options.level),
                          foliage_shapes(order, user_meshes, all.level), thin, numbers);
            if (const std::optional<Stop> stop = make_mesh(thin, user_meshes, all, mesh)) {
                return stop;
            }
            colour_materials(level, mesh);
            for (VertexSegments& pair : mesh.segments) {
                for (std::uint32_t& segment : pair) {
                    segment = segment < numbers.size() ? numbers[segment] : kNoSegment;
                }
            }
            return std::nullopt;
        },
        [&] {
            mesh = {};
            return Stop::OutOfMemory;
        });
}

} // namespace lsys
