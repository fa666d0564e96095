// SPDX-License-Identifier: MIT
// ForestSquare: the trees of one square of a streamed forest, sorted into cells, so that a
// ForestLod can add them. A function of the model and the trees alone. Can be made on any thread.
#pragma once

#include "viewer/scene/forest_lod.h"
#include "viewer/scene/streamed_trees.h"

#include <glm/ext/vector_double2.hpp>

#include <cstdint>
#include <memory>
#include <vector>

namespace lsys::view {

struct ForestSquare {
    SquareId id;
    glm::dvec2 corner{};            // m; origin of `lod_trees` and `cells` along X and Z
    std::vector<Tree> trees;        // sorted by cell; in world coordinates
    std::vector<LodTree> lod_trees; // `trees` in the same order; LodTree::tree: index in `trees`
    std::vector<ForestCell> cells;  // `first`: index in `trees`

    [[nodiscard]] std::uint64_t byte_count() const;
};

/// Squares to show, and squares to hide, which are hidden first.
struct SquareChanges {
    std::vector<SquareId> removed;
    std::vector<std::shared_ptr<const ForestSquare>> added;

    [[nodiscard]] bool empty() const { return removed.empty() && added.empty(); }
};

/// Makes the squares of a streamed forest. Use one for each thread.
class SquareMaker {
public:
    /// Precondition: `model` belongs to a streamed forest, and outlives the maker.
    explicit SquareMaker(const ForestModel& model);

    /// `trees`: all trees of the square, with their final scales.
    [[nodiscard]] ForestSquare make(const SquareId& id, std::vector<Tree> trees);

private:
    const ForestModel& model_;
    std::vector<TreeExpander> expanders_; // by form
};

/// Bytes of a shown tree: in its ForestSquare, in ForestLod and on the device.
inline constexpr std::uint64_t kBytesPerStreamedTree = sizeof(Tree) + 2 * sizeof(LodTree) + 24;
/// Bytes of a cell of a shown square: in its ForestSquare, in ForestLod and on the device.
inline constexpr std::uint64_t kBytesPerStreamedCell = 2 * sizeof(ForestCell) + 24;

} // namespace lsys::view
