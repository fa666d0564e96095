// SPDX-License-Identifier: MIT
// AddedTrees: trees added to a forest after it was sorted into cells, for example by painting. They
// lie in square cells of their own; adding a tree takes the same time for any number of trees. A
// slot is the index of an added tree, in the order of addition.
#pragma once

#include "runtime/forest/tree.h"
#include "runtime/terrain/region.h"
#include "runtime/turtle/skeleton.h"

#include <cstdint>
#include <deque>
#include <vector>

namespace lsys::view {

/// A tree as ForestLod stores it.
struct LodTree {
    /// Bit of `impostor` that is set if the tree is removed.
    static constexpr std::uint16_t kRemoved = 0x8000;

    glm::vec3 position{};
    float scale = 1.0F;
    std::uint32_t tree = 0; // index in Forest::trees
    std::uint16_t form = 0;
    // Index in TreeForm::impostor_trees; for a removed tree also the bit kRemoved.
    std::uint16_t impostor = 0;

    [[nodiscard]] bool is_removed() const { return (impostor & kRemoved) != 0; }
};
static_assert(sizeof(LodTree) == 24);

class AddedTrees {
public:
    struct Cell {
        std::vector<std::uint32_t> trees; // slots of its trees
        glm::vec3 low{};                  // box around its trees, including removed ones
        glm::vec3 high{};
    };

    explicit AddedTrees(const Region& region) : region_(region) {}

    /// Whether the slot is empty or has a tree other than `tree`.
    [[nodiscard]] bool differs(std::uint32_t slot, const Tree& tree) const;
    /// Puts a tree into a slot; slots must be used in order. `box`: bounding box of the tree.
    void put(std::uint32_t slot, const Tree& tree, const LodTree& lod_tree, const Bounds& box);
    void set_alive(std::uint32_t slot, bool alive);
    [[nodiscard]] bool is_alive(std::uint32_t slot) const {
        return slot < added_.size() && !added_[slot].lod_tree.is_removed();
    }

    /// Number of slots, including those of removed trees.
    [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(added_.size()); }
    [[nodiscard]] const LodTree& at(std::uint32_t slot) const { return added_[slot].lod_tree; }
    [[nodiscard]] const Tree& tree(std::uint32_t slot) const { return added_[slot].tree; }

    /// Calls visit(slot) for each living tree in the cells for which wants(cell) returns true.
    template <typename Wants, typename Visit>
    void visit(const Wants& wants, const Visit& visit) const {
        for (const std::uint32_t used : used_) {
            const Cell& cell = cells_[used];
            if (!wants(cell)) {
                continue;
            }
            for (const std::uint32_t slot : cell.trees) {
                if (!added_[slot].lod_tree.is_removed()) {
                    visit(slot);
                }
            }
        }
    }

private:
    struct Added {
        Tree tree;
        LodTree lod_tree;
    };

    [[nodiscard]] std::uint32_t cell_of(const glm::vec3& place) const; // of a place in region_

    Region region_;                   // region of the forest
    std::deque<Added> added_;         // by slot
    std::vector<Cell> cells_;         // kSide by kSide
    std::vector<std::uint32_t> used_; // indices of cells that have had trees
};

} // namespace lsys::view
