// SPDX-License-Identifier: MIT
#include "viewer/scene/impostor_plan.h"

#include "grammar/base/hash.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lsys::view {

namespace {

/// Finest level of branches that impostors show; a form whose trees have more than kMaxTriangles
/// gets a coarser level.
constexpr std::uint32_t kFinestLevel = 1;
constexpr double kMaxTriangles = 30'000.0;
constexpr std::uint32_t kClusterRow = 4; // trees along a side of a cluster

/// A pseudo-random number from 0 to 1, the hash of `a` and `b`.
float random_unit(std::uint32_t a, std::uint32_t b) {
    return unit_float(lattice32(a, b));
}

} // namespace

ImpostorPlan plan_impostors(const ForestLod& lod) {
    ImpostorPlan plan;
    const std::vector<TreeForm>& forms = lod.model().forms;
    for (std::uint32_t f = 0; f < forms.size(); ++f) {
        const TreeForm& form = forms[f];
        plan.forms.push_back(
            {{form.radius, form.low, form.high}, static_cast<std::uint32_t>(plan.layers.size())});
        std::uint32_t level = kFinestLevel;
        while (level + 1 < kTreeLevels && form.triangles[level] > kMaxTriangles) {
            ++level;
        }
        for (const Tree& tree : form.impostor_trees) {
            plan.layers.push_back({f, level, {tree}});
        }
    }
    plan.has_clusters =
        lod.model().streamed != nullptr || lod.trees().size() >= kMinTreesForClusters;
    if (!plan.has_clusters) {
        return plan;
    }
    const std::vector<float> scales = lod.mean_scales();
    for (std::uint32_t f = 0; f < forms.size(); ++f) {
        const TreeForm& form = forms[f];
        const float side =
            static_cast<float>(lod.cell_size()) / (scales[f] > 0.0F ? scales[f] : 1.0F);
        const float step = side / static_cast<float>(kClusterRow);
        plan.forms.push_back(
            {{0.5F * side * std::numbers::sqrt2_v<float> + form.radius, form.low, form.high},
             static_cast<std::uint32_t>(plan.layers.size())});
        ImpostorLayer& cell = plan.layers.emplace_back();
        cell.form = f;
        cell.level = kTreeLevels - 1;
        for (std::uint32_t i = 0; i < kClusterRow * kClusterRow; ++i) {
            Tree tree = form.impostor_trees[i % form.impostor_trees.size()];
            const std::uint32_t row = i / kClusterRow;
            tree.yaw = 2.0F * std::numbers::pi_v<float> * random_unit(i, 1);
            tree.position.x =
                step * (static_cast<float>(i % kClusterRow) + 0.1F + 0.8F * random_unit(i, 2)) -
                0.5F * side;
            tree.position.z =
                step * (static_cast<float>(row) + 0.1F + 0.8F * random_unit(i, 3)) - 0.5F * side;
            cell.trees.push_back(tree);
        }
    }
    return plan;
}

} // namespace lsys::view
