// Impostors: the pictures that stand for trees that are far away: of some trees of each form, and
// of a whole cell of trees of each form for the horizon. What is in them; gl/ draws them.
#pragma once

#include "viewer/scene/forest_lod.h"

#include <cstdint>
#include <vector>

namespace lsys::view {

/// Around +Y, m.
struct Cylinder {
    float radius = 0.0F;
    float low = 0.0F;
    float high = 0.0F;
};

/// One layer of pictures, from many sides.
struct ImpostorLayer {
    std::uint32_t form = 0;
    std::uint32_t level = 0; // of the branches that it is drawn of
    std::vector<Tree> trees;
};

/// What an impostor of a tree, or of a cell, has to know. Lengths are of scale 1.
struct ImpostorForm {
    Cylinder cylinder;
    std::uint32_t first_layer = 0;
};

struct ImpostorPlan {
    std::vector<ImpostorLayer> layers;
    /// Of each form of trees, then of a cell of each.
    std::vector<ImpostorForm> forms;
    bool has_clusters = false;
};

/// By which impostors are larger than what they show; shaders/impostor.glsl has the same.
inline constexpr float kImpostorMargin = 1.04F;

/// Cells are drawn only where a forest has so many trees.
inline constexpr std::size_t kMinTreesForClusters = 2000;

[[nodiscard]] ImpostorPlan plan_impostors(const ForestLod& lod);

} // namespace lsys::view
