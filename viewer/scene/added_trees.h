// AddedTrees: trees that came to a forest after it was sorted into cells, as by painting. They lie
// in squares of their own; what it costs to add one does not depend on how many trees there are.
#pragma once

#include "runtime/forest/tree.h"
#include "runtime/terrain/region.h"
#include "runtime/turtle/skeleton.h"

#include <cstdint>
#include <deque>
#include <vector>

namespace lsys::view {

/// A tree as it is looked for.
struct LodTree {
    /// In `impostor`: the tree was taken away.
    static constexpr std::uint16_t kGone = 0x8000;

    glm::vec3 position{};
    float scale = 1.0F;
    std::uint32_t tree = 0; // in Forest::trees
    std::uint16_t form = 0;
    std::uint16_t impostor = 0; // in TreeForm::impostor_trees; and kGone

    [[nodiscard]] bool gone() const { return (impostor & kGone) != 0; }
};
static_assert(sizeof(LodTree) == 24);

class AddedTrees {
public:
    struct Cell {
        std::vector<std::uint32_t> trees; // slots
        glm::vec3 low{};                  // around its trees, of all that were ever there
        glm::vec3 high{};
    };

    explicit AddedTrees(const Region& region) : region_(region) {}

    /// One that has no place yet, or whose place another tree has now.
    [[nodiscard]] bool is_another(std::uint32_t slot, const Tree& tree) const;
    /// Slots are used one after the other. `box`: around the tree.
    void put(std::uint32_t slot, const Tree& tree, const LodTree& made, const Bounds& box);
    void set_alive(std::uint32_t slot, bool alive);
    [[nodiscard]] bool is_alive(std::uint32_t slot) const {
        return slot < added_.size() && !added_[slot].made.gone();
    }

    [[nodiscard]] const LodTree& at(std::uint32_t slot) const { return added_[slot].made; }
    [[nodiscard]] const Tree& tree(std::uint32_t slot) const { return added_[slot].tree; }

    /// visit(slot) of those that are alive in cells of which `wants` is true.
    template <typename Wants, typename Visit>
    void visit(const Wants& wants, const Visit& visit) const {
        for (const std::uint32_t used : used_) {
            const Cell& cell = cells_[used];
            if (!wants(cell)) {
                continue;
            }
            for (const std::uint32_t slot : cell.trees) {
                if (!added_[slot].made.gone()) {
                    visit(slot);
                }
            }
        }
    }

private:
    struct Added {
        Tree tree;
        LodTree made;
    };

    [[nodiscard]] std::uint32_t cell_of(const glm::vec3& place) const;

    Region region_;
    std::deque<Added> added_;
    std::vector<Cell> cells_;
    std::vector<std::uint32_t> used_; // cells with trees
};

} // namespace lsys::view
