// SPDX-License-Identifier: MIT
// SquareSource: computes the trees of any part of the ground independently of all other parts, so
// that a forest of any size can be shown square by square. Only for placement methods that choose
// each tree within a cell of an unbounded grid.
#pragma once

#include "runtime/pipeline/forest.h"
#include "runtime/placement/density_field.h"
#include "viewer/scene/forest_model.h"
#include "viewer/scene/streamed_trees.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace lsys::view {

/// A forest with more expected trees is streamed if its placement method allows it.
inline constexpr double kMaxHeldTrees = 2e6;
/// Default visibility in a streamed forest, km.
inline constexpr double kStreamedVisibility = 100.0;

class SquareSource {
public:
    /// Whether the forest of a scene is streamed: the placement is on an unbounded grid, no tree is
    /// painted or erased, and more than kMaxHeldTrees trees are expected. `grown`: the forest
    /// without trees.
    [[nodiscard]] static bool
    is_needed(const Scene& scene, const Project& project, const GrownForest& grown);

    /// Precondition: is_needed() returns true. `grown` must outlive the source. Errors: the errors
    /// of place_trees(), except too many trees in total.
    [[nodiscard]] static Result<std::shared_ptr<const SquareSource>>
    make(const Scene& scene, const Project& project, const GrownForest& grown);

    SquareSource(const Scene& scene, const Project& project, const GrownForest& grown);

    /// All trees of a part of the ground, with their final scales, sorted by number. May be called
    /// from several threads. Throws std::bad_alloc.
    [[nodiscard]] std::vector<Tree> trees_of(const Region& region) const;
    /// Upper estimate of the number of trees of a region. Where the density varies, it is sampled
    /// at 16 points.
    [[nodiscard]] double expected_trees(const Region& region) const;
    /// Expected number of places on the whole ground; a place has at most one tree.
    [[nodiscard]] double all_places() const { return all_places_; }
    /// Layout of the squares, sizes of trees, and cover, for a model whose forms are made. The
    /// source must outlive the result.
    [[nodiscard]] std::shared_ptr<const StreamedTrees> describe(const ForestModel& model) const;

private:
    PlacementOptions options_;
    const Terrain& terrain_;
    const Forest& kinds_; // the species
    TreeSizer sizer_;
    DensityField field_;
    double all_places_ = 0.0; // expected places in the whole region
    double halo_ = 0.0;       // m, width of a border in which neighbours can stand
};

} // namespace lsys::view
