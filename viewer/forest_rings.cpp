// Which trees are in which ring of a picture: ForestView::select().
#include "viewer/forest_view.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace lsys::view {

namespace {

constexpr std::uint32_t kFewTrees = 8; // a cell of fewer is never drawn as one
constexpr std::uint32_t kTurnsKept = 32;
constexpr float kDetailStep = 0.87F;
constexpr float kNearest = 0.1F; // m: distances below count as this

float pixels_of(const ViewVolume& volume, const glm::vec3& place, float height) {
    return height * volume.pixels / std::max(glm::distance(volume.eye, place), kNearest);
}

} // namespace

Sway sway_in(const Wind& wind) {
    // The largest values of the terms of in_wind() in shaders/forest.glsl.
    constexpr float kPush = 0.004F;
    constexpr float kTrunk = 1.35F * 1.2F * 1.2F;
    constexpr float kBoughs = 0.35F * 1.54F;
    constexpr float kMostFlutter = 0.05F;
    const float gust = 1.0F + std::abs(wind.gust);
    const float push = kPush * glm::length(wind.velocity) * gust;
    return {push * kTrunk, push * gust * kBoughs,
            std::min(push, kMostFlutter) * std::numbers::sqrt3_v<float>};
}

const ForestLists& ForestView::select(const ViewVolume& volume, const RingOptions& options) {
    lists_.branches.clear();
    lists_.runs.clear();
    lists_.trees.clear();
    lists_.clumps.clear();
    lists_.trees_of_level = {};
    lists_.clumped_trees = 0;
    lists_.triangles = 0;
    lists_.expanded = 0;
    lists_.waiting = 0;
    sway_ = sway_in(options.wind);
    candidates_.clear();
    far_.clear();
    seen_cells_.clear();
    for (std::uint32_t c = 0; c < cells_.size(); ++c) {
        const ForestCell& cell = cells_[c];
        if (cell.count == 0) {
            continue;
        }
        const glm::vec3 size = cell.high - cell.low;
        const Ball ball = {0.5F * (cell.low + cell.high),
                           0.5F * glm::length(size) +
                               sway_.of(cell.tallest, std::max(size.x, size.z))};
        if (volume.meets(ball)) {
            seen_cells_.emplace_back(
                glm::distance(volume.eye, glm::clamp(volume.eye, cell.low, cell.high)), c);
        }
    }
    std::sort(seen_cells_.begin(), seen_cells_.end());
    for (const auto& [distance, c] : seen_cells_) {
        const ForestCell& cell = cells_[c];
        if (cell.count >= kFewTrees && cell.gone == 0 &&
            cell.tallest * volume.pixels / std::max(distance, kNearest) < options.horizon_pixels) {
            lists_.clumps.push_back(c);
            lists_.clumped_trees += cell.count;
        } else {
            for (std::uint32_t t = cell.first; t < cell.first + cell.count; ++t) {
                if (!trees_[t].gone()) {
                    visit_tree(t, volume, options);
                }
            }
        }
    }
    added_.visit(
        [&](const AddedTrees::Cell& cell) {
            return volume.meets(
                {0.5F * (cell.low + cell.high), 0.5F * glm::distance(cell.low, cell.high)});
        },
        [&](std::uint32_t slot) { visit_tree(first_added() + slot, volume, options); });
    lists_.detail = fitting_detail(options);
    pool_.begin_turn(kTurnsKept);
    list_branches(volume, options);
    lists_.trees.insert(lists_.trees.end(), far_.begin(), far_.end());
    return lists_;
}

Ball ForestView::swaying(const Ball& ball, const ViewTree& tree) const {
    const TreeForm& form = model_.forms[tree.form];
    const float width = glm::length(form.reach.centre) + form.reach.radius;
    return {ball.centre, ball.radius + sway_.of(tree.scale * form.height(), tree.scale * width)};
}

void ForestView::visit_tree(std::uint32_t number,
                            const ViewVolume& volume,
                            const RingOptions& options) {
    const ViewTree& tree = view_tree(number);
    const Ball portrait = portrait_ball(tree);
    const float pixels =
        pixels_of(volume, portrait.centre, tree.scale * model_.forms[tree.form].height());
    if (pixels >= options.level_pixels.back()) {
        if (volume.meets(swaying(reach_of(tree, tree_of(number).yaw), tree))) {
            candidates_.push_back({number, pixels});
        }
    } else if (volume.meets(swaying(portrait, tree))) {
        far_.push_back(number);
    }
}

std::uint32_t ForestView::level_of(float pixels, const RingOptions& options) {
    std::uint32_t level = 0;
    while (level < kTreeLevels && pixels < options.level_pixels[level]) {
        ++level;
    }
    return level;
}

float ForestView::fitting_detail(const RingOptions& options) const {
    float detail = 1.0F;
    for (;; detail *= kDetailStep) {
        double triangles = 0.0;
        bool any = false;
        for (const Candidate& candidate : candidates_) {
            const std::uint32_t level = level_of(candidate.pixels * detail, options);
            if (level < kTreeLevels) {
                triangles += model_.forms[view_tree(candidate.tree).form].triangles[level];
                any = true;
            }
        }
        if (!any || triangles <= static_cast<double>(options.most_triangles)) {
            return detail;
        }
    }
}

void ForestView::see_branches(const PoolSpan& span,
                              const ViewTree& tree,
                              float yaw,
                              const ViewVolume& volume) {
    const Ball whole = swaying(reach_of(tree, yaw), tree);
    const bool is_within = volume.holds(whole);
    const float sway = whole.radius - tree.scale * model_.forms[tree.form].reach.radius;
    const std::vector<Ball>& balls = model_.forms[tree.form].mesh_balls;
    for (std::uint32_t place = span.first; place < span.first + span.count; ++place) {
        const PoolBranch& branch = pool_.branches()[place];
        const Ball& ball = balls[branch.mesh];
        if (ball.radius < 0.0F) {
            continue;
        }
        if (is_within ||
            volume.meets({branch.at(ball.centre), branch.scale * ball.radius + sway})) {
            seen_branches_.push_back(place);
        }
    }
}

void ForestView::list_branches(const ViewVolume& volume, const RingOptions& options) {
    struct Drawn {
        std::uint32_t first = 0; // in seen_branches_
        std::uint32_t end = 0;
        std::uint32_t first_mesh = 0;
    };
    seen_branches_.clear();
    std::vector<Drawn> drawn;
    std::vector<PoolBranch> made;
    std::fill(mesh_counts_.begin(), mesh_counts_.end(), 0);
    for (const Candidate& candidate : candidates_) {
        const ViewTree& tree = view_tree(candidate.tree);
        const std::uint32_t level = level_of(candidate.pixels * lists_.detail, options);
        if (level == kTreeLevels) {
            lists_.trees.push_back(candidate.tree);
            continue;
        }
        PoolSpan span = pool_.find(candidate.tree);
        if (span.count == 0 && lists_.expanded < options.most_expansions) {
            const InstanceCache& cache = *model_.forms[tree.form].cache;
            made.clear();
            expanders_[tree.form].expand(
                tree_of(candidate.tree), [&](const BranchInstance& branch) {
                    made.push_back(
                        pool_branch(branch, cache.instances[branch.instance], candidate.tree));
                });
            span = pool_.add(candidate.tree, made);
            lists_.expanded += span.count != 0 ? 1 : 0;
        }
        if (span.count == 0) {
            lists_.trees.push_back(candidate.tree);
            ++lists_.waiting;
            continue;
        }
        const auto instances =
            static_cast<std::uint32_t>(model_.forms[tree.form].cache->instances.size());
        const auto first = static_cast<std::uint32_t>(seen_branches_.size());
        see_branches(span, tree, tree_of(candidate.tree).yaw, volume);
        if (seen_branches_.size() == first) {
            continue;
        }
        ++lists_.trees_of_level[level];
        drawn.push_back({first, static_cast<std::uint32_t>(seen_branches_.size()),
                         first_mesh_[tree.form] + level * instances});
        for (std::uint32_t i = first; i < seen_branches_.size(); ++i) {
            ++mesh_counts_[drawn.back().first_mesh + pool_.branches()[seen_branches_[i]].mesh];
        }
    }
    // Finer levels first: they are nearer, and hide what comes behind.
    std::uint32_t first = 0;
    for (std::uint32_t level = 0; level < kTreeLevels; ++level) {
        for (std::uint32_t f = 0; f < model_.forms.size(); ++f) {
            const TreeForm& form = model_.forms[f];
            const auto instances = static_cast<std::uint32_t>(form.cache->instances.size());
            for (std::uint32_t i = 0; i < instances; ++i) {
                std::uint32_t& place = mesh_counts_[first_mesh_[f] + level * instances + i];
                const std::uint32_t count = std::exchange(place, first); // where its list goes on
                if (count != 0) {
                    lists_.runs.push_back({f, level, i, first, count});
                    lists_.triangles += std::uint64_t{count} * form.mesh_triangles[level][i];
                    first += count;
                }
            }
        }
    }
    lists_.branches.resize(seen_branches_.size());
    for (const Drawn& tree : drawn) {
        for (std::uint32_t i = tree.first; i < tree.end; ++i) {
            const std::uint32_t place = seen_branches_[i];
            lists_.branches[mesh_counts_[tree.first_mesh + pool_.branches()[place].mesh]++] = place;
        }
    }
}

} // namespace lsys::view
