// SPDX-License-Identifier: MIT
// ImpostorPlan: contents of the impostor atlas. Each form has impostors of single trees and, for
// the horizon, an impostor of a cluster, a cell full of trees. ImpostorAtlas draws the impostors.
#pragma once

#include "viewer/scene/forest_lod.h"

#include <cstdint>
#include <vector>

namespace lsys::view {

/// A cylinder around +Y; lengths in m.
struct Cylinder {
    float radius = 0.0F;
    float low = 0.0F;
    float high = 0.0F;
};

/// The contents of one layer of the atlas.
struct ImpostorLayer {
    std::uint32_t form = 0;
    std::uint32_t level = 0; // level of the branches
    std::vector<Tree> trees; // one tree, or the trees of a cluster
};

/// Size and layers of an impostor form. Lengths are those of trees of scale 1.
struct ImpostorForm {
    Cylinder cylinder;
    std::uint32_t first_layer = 0; // index in ImpostorPlan::layers
};

struct ImpostorPlan {
    std::vector<ImpostorLayer> layers;
    /// For each tree form an impostor form of single trees, then for each tree form an impostor
    /// form of a cluster.
    std::vector<ImpostorForm> forms;
    bool has_clusters = false;
};

/// Ratio of the size of impostors to the size of what they show; also in shaders/impostor.glsl.
inline constexpr float kImpostorMargin = 1.04F;

/// Min number of trees in a forest that is drawn with clusters.
inline constexpr std::size_t kMinTreesForClusters = 2000;

/// Plans the layers for the forms of a forest; with clusters if it has many trees.
[[nodiscard]] ImpostorPlan plan_impostors(const ForestLod& lod);

} // namespace lsys::view
