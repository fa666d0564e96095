// SPDX-License-Identifier: MIT
// ImpostorPlan: contents of the impostor atlas. Each form has impostors of single trees and, for
// the horizon, of a cluster: a cell full of trees. ImpostorAtlas draws them.
#pragma once

#include "viewer/scene/forest_lod.h"

#include <cstdint>
#include <vector>

namespace lsys::view {

/// A cylinder around +Y, m.
struct Cylinder {
    float radius = 0.0F;
    float low = 0.0F;
    float high = 0.0F;
};

/// Contents of one layer of the atlas.
struct ImpostorLayer {
    std::uint32_t form = 0;
    std::uint32_t level = 0; // level of the branches
    std::vector<Tree> trees;
};

/// Size and layers of an impostor form. Lengths are for trees of scale 1.
struct ImpostorForm {
    Cylinder cylinder;
    std::uint32_t first_layer = 0;
};

struct ImpostorPlan {
    std::vector<ImpostorLayer> layers;
    /// A form of single trees for each tree form, then a form of a cluster for each tree form.
    std::vector<ImpostorForm> forms;
    bool has_clusters = false;
};

/// Size of impostors / size of their contents; also in shaders/impostor.glsl.
inline constexpr float kImpostorMargin = 1.04F;

/// Min trees of a forest with clusters.
inline constexpr std::size_t kMinTreesForClusters = 2000;

[[nodiscard]] ImpostorPlan plan_impostors(const ForestLod& lod);

} // namespace lsys::view
