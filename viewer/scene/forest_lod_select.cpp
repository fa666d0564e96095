// SPDX-License-Identifier: MIT
// ForestLod::select(): finds the LOD band of each tree of a picture.
#include "viewer/scene/forest_lod.h"
#include "viewer/scene/forest_square.h"
#include "viewer/scene/impostor_plan.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace lsys::view {

namespace {

constexpr std::uint32_t kMinClusterTrees = 8; // min trees of a cluster
constexpr std::uint32_t kFramesKept = 32;     // frames for which unused branches stay in the pool
constexpr int kDetailSteps = 24;              // number of bisections
constexpr float kNearest = 0.1F;              // m; shorter distances count as this one

float pixels_of(const Frustum& frustum, const glm::vec3& place, float height) {
    return height * frustum.pixels / std::max(glm::distance(frustum.eye, place), kNearest);
}

/// Weight of the finer of two LOD bands at a height of `pixels`: 0 up to `limit`, the limit of the
/// coarser band, and 1 from `blend` * `limit` on.
float finer_weight(float pixels, float limit, float blend) {
    return blend > 1.0F ? std::clamp((pixels / limit - 1.0F) / (blend - 1.0F), 0.0F, 1.0F) : 1.0F;
}

/// Fraction of a tree's pixels that are drawn at `distance` (m) from the eye: 1 up to four fifths
/// of `range`, decreasing to 0 at `range`.
float presence_at(float distance, float range) {
    constexpr float kFading = 0.2F;
    return std::isfinite(range) ? std::clamp((range - distance) / (kFading * range), 0.0F, 1.0F)
                                : 1.0F;
}

/// Max displacement by wind, in m, of trees that are as high and wide as a box, or smaller.
float sway_within(const glm::vec3& low, const glm::vec3& high, const Sway& sway) {
    const glm::vec3 size = high - low;
    return sway.displacement(size.y, std::max(size.x, size.z));
}

/// Bounding sphere of a box of trees, enlarged by their max displacement by wind.
Sphere swaying_box(const glm::vec3& low, const glm::vec3& high, const Sway& sway) {
    return {0.5F * (low + high), 0.5F * glm::distance(low, high) + sway_within(low, high, sway)};
}

} // namespace

Sway sway_in(const Wind& wind) {
    // Max values of the terms of swayed() in shaders/forest.glsl.
    constexpr float kPush = 0.004F;
    constexpr float kTrunk = 1.35F * 1.2F * 1.2F;
    constexpr float kBoughs = 0.35F * 1.54F;
    constexpr float kMaxFlutter = 0.05F;
    const float gust = 1.0F + std::abs(wind.gust);
    const float push = kPush * glm::length(wind.velocity) * gust;
    return {push * kTrunk, push * gust * kBoughs,
            std::min(push, kMaxFlutter) * std::numbers::sqrt3_v<float>};
}

const DrawLists&
ForestLod::select(const Frustum& frustum, const LodOptions& options, GroundHorizon* ground) {
    lists_.branches.clear();
    lists_.runs.clear();
    lists_.trees.clear();
    lists_.clusters.clear();
    lists_.trees_of_level = {};
    lists_.far_trees = 0;
    lists_.clustered_trees = 0;
    lists_.blended = 0;
    lists_.occluded = 0;
    lists_.triangles = 0;
    lists_.expanded = 0;
    lists_.waiting = 0;
    sway_ = sway_in(options.wind);
    ground_ = ground;
    candidates_.clear();
    far_.clear();
    visible_cells_.clear();
    list_visible_cells(frustum);
    for (const auto& [distance, order, c] : visible_cells_) {
        const ForestCell& cell = cells_[c];
        if (is_occluded({cell.low, cell.high, false}, sway_within(cell.low, cell.high, sway_))) {
            lists_.occluded += cell.count;
            continue;
        }
        visit_cell(c, distance, frustum, options);
    }
    added_.visit(
        [&](const AddedTrees::Cell& cell) {
            return frustum.intersects(swaying_box(cell.low, cell.high, sway_));
        },
        [&](std::uint32_t slot) { visit_tree(first_added() + slot, frustum, options); });
    lists_.detail = detail_in_budget(options);
    pool_.begin_frame(kFramesKept);
    list_branches(frustum, options);
    lists_.far_trees += far_.size();
    lists_.trees.insert(lists_.trees.end(), far_.begin(), far_.end());
    for (std::vector<ImpostorEntry>* list : {&lists_.trees, &lists_.clusters}) {
        std::stable_partition(list->begin(), list->end(),
                              [](const ImpostorEntry& each) { return each.range.is_whole(); });
    }
    return lists_;
}

void ForestLod::list_visible_cells(const Frustum& frustum) {
    if (model_.streamed == nullptr) {
        list_visible_cells(frustum, 0, static_cast<std::uint32_t>(cells_.size()), 0);
    }
    for (std::uint32_t index = 0; index < squares_.size(); ++index) {
        const ShownSquare& shown = squares_[index];
        if (shown.square == nullptr || shown.square->trees.empty() ||
            !frustum.intersects(swaying_box(shown.low, shown.high, sway_))) {
            continue;
        }
        const auto count = static_cast<std::uint32_t>(shown.square->cells.size());
        const SquareId& id = shown.square->id;
        list_visible_cells(frustum, index * count, count,
                           std::uint64_t{static_cast<std::uint32_t>(id.row)} << 32U |
                               static_cast<std::uint32_t>(id.column));
    }
    std::sort(visible_cells_.begin(), visible_cells_.end());
}

void ForestLod::list_visible_cells(const Frustum& frustum,
                                   std::uint32_t first,
                                   std::uint32_t count,
                                   std::uint64_t order) {
    for (std::uint32_t c = first; c < first + count; ++c) {
        const ForestCell& cell = cells_[c];
        if (cell.count != 0 && frustum.intersects(swaying_box(cell.low, cell.high, sway_))) {
            visible_cells_.push_back(
                {glm::distance(frustum.eye, glm::clamp(frustum.eye, cell.low, cell.high)), order,
                 c});
        }
    }
}

float ForestLod::sway_of(const LodTree& tree) const {
    const TreeForm& form = model_.forms[tree.form];
    const float width = glm::length(form.sphere.centre) + form.sphere.radius;
    return sway_.displacement(tree.scale * form.height(), tree.scale * width);
}

Sphere ForestLod::swaying(const Sphere& sphere, const LodTree& tree) const {
    return {sphere.centre, sphere.radius + sway_of(tree)};
}

Bounds ForestLod::impostor_box(const LodTree& tree, const glm::vec3& eye) const {
    // Impostors have a margin, and impostors seen from above lean back, see shaders/impostor.glsl.
    constexpr float kLevel = 0.15F; // sine of the max elevation at which no impostor leans back
    const Sphere sphere = impostor_sphere(tree);
    const float wide = kImpostorMargin * sphere.radius;
    const bool is_level =
        std::abs(eye.y - sphere.centre.y) < kLevel * glm::distance(eye, sphere.centre);
    const float high =
        is_level ? kImpostorMargin * 0.5F * tree.scale * model_.forms[tree.form].height() : wide;
    const glm::vec3 half(wide, high, wide);
    return {sphere.centre - half, sphere.centre + half, false};
}

bool ForestLod::is_occluded(const Bounds& box, float sway) const {
    return ground_ != nullptr && ground_->occludes(box.low - sway, box.high + sway);
}

float ForestLod::cluster_size(const ForestCell& cell, const glm::vec3& eye) const {
    // Elevations of the pictures of clusters, and the limits between them, see
    // shaders/impostor.vert.glsl.
    constexpr std::array<float, 3> kSines = {0.0F, 0.573576F, 0.965926F};
    constexpr std::array<float, 2> kLimits = {0.300676F, 0.819127F};
    const float away = std::max(glm::distance(eye, cell.middle), kNearest);
    const float sine = std::clamp((eye.y - cell.middle.y) / away, 0.0F, 1.0F);
    const std::size_t picture = sine < kLimits[0] ? 0 : sine < kLimits[1] ? 1 : 2;
    // Twice the error in height of trees at the edges, in sides of the cell, for the elevation of
    // the picture.
    const float height_error = std::abs(sine - kSines[picture]);
    // Min height of trees, in sides of the cell. The picture is as wide as the cell, so lower trees
    // would cover only few of its texels.
    constexpr float kMinHeight = 1.0F / 6.0F;
    // Seen from above, no cell hides the borders of the next one, which would show as a grid. So the
    // result grows to 1.9 sides, and cells are pictures only where they are small on the screen.
    constexpr float kSideView = 0.25F; // sine of the max elevation of a view from the side
    constexpr float kFootprint = 2.5F;
    const float footprint = kFootprint * (sine - kSideView);
    const float per_side = std::max({height_error, kMinHeight, footprint});
    return std::max(cell.tallest, per_side * static_cast<float>(cell_size_));
}

void ForestLod::visit_cell(std::uint32_t index,
                           float distance,
                           const Frustum& frustum,
                           const LodOptions& options) {
    const ForestCell& cell = cells_[index];
    const float presence = presence_at(distance, options.tree_range);
    if (presence <= 0.0F) {
        return;
    }
    float weight = 1.0F; // weight of single trees, as opposed to the cluster
    if (cell.count >= kMinClusterTrees && cell.removed == 0 && options.cluster_pixels > 0.0F) {
        const float scale = frustum.pixels / std::max(distance, kNearest); // pixels per metre
        const float pixels = scale * cluster_size(cell, frustum.eye);
        weight = pixels < options.cluster_pixels
                     ? 0.0F
                     : finer_weight(pixels, options.cluster_pixels, options.blend);
    }
    if (weight < 1.0F) {
        lists_.clusters.push_back({index, {weight, weight + (1.0F - weight) * presence}});
    }
    if (weight <= 0.0F) {
        lists_.clustered_trees += cell.count;
        return;
    }
    lists_.blended += weight < 1.0F ? cell.count : 0;
    for (std::uint32_t t = cell.first; t < cell.first + cell.count; ++t) {
        if (!trees_[t].is_removed()) {
            visit_tree(t, frustum, options, weight * presence);
        }
    }
}

void ForestLod::visit_tree(std::uint32_t number,
                           const Frustum& frustum,
                           const LodOptions& options,
                           float weight) {
    const LodTree& tree = lod_tree(number);
    const Sphere impostor = impostor_sphere(tree);
    const float pixels =
        pixels_of(frustum, impostor.centre, tree.scale * model_.forms[tree.form].height());
    if (pixels >= options.level_pixels.back()) {
        if (frustum.intersects(swaying(bounding_sphere(tree, tree_of(number).yaw), tree))) {
            candidates_.push_back({number, pixels});
        }
    } else if (frustum.intersects(swaying(impostor, tree))) {
        if (is_occluded(impostor_box(tree, frustum.eye), sway_of(tree))) {
            ++lists_.occluded;
            return;
        }
        far_.push_back({number, {0.0F, weight}});
    }
}

std::uint32_t ForestLod::level_of(float pixels, const LodOptions& options) {
    std::uint32_t level = 0;
    while (level < kTreeLevels && pixels < options.level_pixels[level]) {
        ++level;
    }
    return level;
}

std::uint32_t ForestLod::blend_steps(float pixels, std::uint32_t level, const LodOptions& options) {
    const float blend = level + 1 == kTreeLevels ? options.blend : options.level_blend;
    const float weight = finer_weight(pixels, options.level_pixels[level], blend);
    return static_cast<std::uint32_t>(
        std::lround(weight * static_cast<float>(BranchEntry::kBlendSteps)));
}

float ForestLod::detail_in_budget(const LodOptions& options) const {
    const auto fits = [&](float detail) {
        std::uint64_t triangles = 0;
        for (const BranchCandidate& candidate : candidates_) {
            const float pixels = candidate.pixels * detail;
            const std::uint32_t level = level_of(pixels, options);
            if (level < kTreeLevels) {
                const TreeForm& form = model_.forms[lod_tree(candidate.tree).form];
                triangles += form.triangle_count(level);
                if (level + 1 < kTreeLevels &&
                    blend_steps(pixels, level, options) != BranchEntry::kBlendSteps) {
                    triangles += form.triangle_count(level + 1);
                }
            }
        }
        return triangles <= options.max_triangles;
    };
    if (fits(1.0F)) {
        return 1.0F;
    }
    // Bisects for the largest factor with which the triangles are within the limit, so that few
    // trees change their level when the camera moves a little.
    float fitting = 0.0F; // with 0, no tree has branches
    float excessive = 1.0F;
    for (int step = 0; step < kDetailSteps; ++step) {
        const float middle = 0.5F * (fitting + excessive);
        (fits(middle) ? fitting : excessive) = middle;
    }
    return fitting;
}

void ForestLod::cull_branches(const PoolSpan& span,
                              const LodTree& tree,
                              float yaw,
                              std::uint32_t blend_steps,
                              const Frustum& frustum) {
    const Sphere whole = swaying(bounding_sphere(tree, yaw), tree);
    const bool is_within = frustum.contains(whole);
    const float sway = whole.radius - tree.scale * model_.forms[tree.form].sphere.radius;
    const std::vector<Sphere>& spheres = model_.forms[tree.form].mesh_spheres;
    for (std::uint32_t place = span.first; place < span.first + span.count; ++place) {
        const PoolBranch& branch = pool_.branches()[place];
        const Sphere& sphere = spheres[branch.mesh];
        if (sphere.radius < 0.0F) {
            continue;
        }
        if (is_within ||
            frustum.intersects({branch.at(sphere.centre), branch.scale * sphere.radius + sway})) {
            visible_branches_.emplace_back(place, blend_steps);
        }
    }
}

PoolSpan ForestLod::branches_of(std::uint32_t number, const LodOptions& options) {
    const PoolSpan span = pool_.find(number);
    if (span.count != 0 || lists_.expanded >= options.max_expansions) {
        return span;
    }
    const std::uint32_t form = lod_tree(number).form;
    const InstanceCache& cache = *model_.forms[form].cache;
    made_branches_.clear();
    expanders_[form].expand(tree_of(number), [&](const BranchInstance& branch) {
        made_branches_.push_back(pool_branch(branch, cache.instances[branch.instance], number));
    });
    const PoolSpan pool_span = pool_.add(number, made_branches_);
    lists_.expanded += pool_span.count != 0 ? 1 : 0;
    return pool_span;
}

void ForestLod::list_branches(const Frustum& frustum, const LodOptions& options) {
    visible_branches_.clear();
    visible_trees_.clear();
    std::fill(mesh_counts_.begin(), mesh_counts_.end(), 0);
    constexpr std::uint32_t kWholeWeight = BranchEntry::kBlendSteps;
    for (const BranchCandidate& candidate : candidates_) {
        const LodTree& tree = lod_tree(candidate.tree);
        const float pixels = candidate.pixels * lists_.detail;
        const std::uint32_t level = level_of(pixels, options);
        const PoolSpan span =
            level == kTreeLevels ? PoolSpan{} : branches_of(candidate.tree, options);
        if (span.count == 0) {
            lists_.trees.push_back({candidate.tree, {}});
            ++lists_.far_trees;
            lists_.waiting += level == kTreeLevels ? 0 : 1;
            continue;
        }
        const std::uint32_t steps = blend_steps(pixels, level, options);
        const auto instances =
            static_cast<std::uint32_t>(model_.forms[tree.form].cache->instances.size());
        const auto first = static_cast<std::uint32_t>(visible_branches_.size());
        cull_branches(span, tree, tree_of(candidate.tree).yaw, steps, frustum);
        if (visible_branches_.size() == first) {
            continue;
        }
        ++lists_.trees_of_level[level];
        const auto end = static_cast<std::uint32_t>(visible_branches_.size());
        const auto add_level = [&](std::uint32_t begin, std::uint32_t group) {
            const auto after = static_cast<std::uint32_t>(visible_branches_.size());
            visible_trees_.push_back({begin, after, first_mesh_[tree.form] + group * instances});
            for (std::uint32_t i = begin; i < after; ++i) {
                const std::uint32_t mesh = pool_.branches()[visible_branches_[i].slot()].mesh;
                ++mesh_counts_[visible_trees_.back().first_mesh + mesh];
            }
        };
        add_level(first, steps == kWholeWeight ? level : kTreeLevels + level);
        if (steps == kWholeWeight) {
            continue;
        }
        ++lists_.blended;
        if (level + 1 == kTreeLevels) {
            const float weight = static_cast<float>(steps) / static_cast<float>(kWholeWeight);
            lists_.trees.push_back({candidate.tree, {weight, 1.0F}});
            continue;
        }
        for (std::uint32_t i = first; i < end; ++i) {
            visible_branches_.emplace_back(visible_branches_[i].slot(), steps, true);
        }
        add_level(end, kTreeLevels + level + 1);
    }
    list_runs();
}

void ForestLod::list_runs() {
    // Finer levels are drawn first: their trees are nearer, and occlude others.
    std::uint32_t first = 0;
    for (std::uint32_t group = 0; group < kGroups; ++group) {
        const std::uint32_t level = group % kTreeLevels;
        for (std::uint32_t f = 0; f < model_.forms.size(); ++f) {
            const TreeForm& form = model_.forms[f];
            const auto instances = static_cast<std::uint32_t>(form.cache->instances.size());
            for (std::uint32_t i = 0; i < instances; ++i) {
                std::uint32_t& place = mesh_counts_[first_mesh_[f] + group * instances + i];
                // `place` becomes the index after the last entry of the list that is filled below.
                const std::uint32_t count = std::exchange(place, first);
                if (count != 0) {
                    lists_.runs.push_back({f, level, i, first, count, group >= kTreeLevels});
                    lists_.triangles += std::uint64_t{count} * form.mesh_triangles[level][i];
                    first += count;
                }
            }
        }
    }
    lists_.branches.resize(visible_branches_.size());
    for (const VisibleTree& tree : visible_trees_) {
        for (std::uint32_t i = tree.first; i < tree.end; ++i) {
            const BranchEntry branch = visible_branches_[i];
            const std::uint32_t mesh = pool_.branches()[branch.slot()].mesh;
            lists_.branches[mesh_counts_[tree.first_mesh + mesh]++] = branch;
        }
    }
}

} // namespace lsys::view
