// ForestPlan: which instances stand in which cell of the ground, and how many. Found by putting all
// trees together once; they are put together again wherever their transforms are needed.
#pragma once

#include "runtime/export/export_forest.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace lsys {

/// Plants of one species and stage.
struct ForestKind {
    std::uint32_t species = 0;
    std::uint32_t stage = 0;
    std::uint32_t first = 0; // number of its first instance among those of all kinds
    const InstanceCache* cache = nullptr;
    const InstanceMeshes* meshes = nullptr;
    std::uint64_t trees = 0;
};

/// The instances of one number that stand in one cell.
struct ForestGroup {
    std::uint32_t instance = 0; // among those of all kinds
    std::uint64_t first = 0;    // how many are in the groups before
    std::uint64_t count = 0;
};

/// Some trees of one cell. Its branches with triangles can be put where they belong without regard
/// to other pieces.
struct ForestPiece {
    std::uint64_t first_tree = 0; // in the order of the plan
    std::uint64_t tree_count = 0;
    /// How many of an instance stand in the pieces of the cell before, for the instances that stand
    /// here, which have rising numbers.
    std::vector<std::pair<std::uint32_t, std::uint64_t>> before;
};

struct ForestCell {
    std::int64_t x = 0; // in sides of a cell
    std::int64_t z = 0;
    std::uint64_t first_tree = 0; // in the order of the plan
    std::uint64_t tree_count = 0;
    std::size_t first_piece = 0;
    std::size_t piece_count = 0;
    std::size_t first_group = 0;
    std::size_t group_count = 0;
    std::uint64_t branches = 0; // with triangles
};

class ForestPlan {
public:
    /// `cell`: side in m; 0: there is one cell. `threads`: 0: as many as the machine has.
    ForestPlan(const ForestScene& scene, float cell, std::uint32_t threads);

    [[nodiscard]] std::span<const ForestKind> kinds() const { return kinds_; }
    /// Those with triangles, by z, then x.
    [[nodiscard]] std::span<const ForestCell> cells() const { return cells_; }
    /// Of all cells, by rising number of the instance within a cell.
    [[nodiscard]] std::span<const ForestGroup> groups() const { return groups_; }
    [[nodiscard]] std::span<const ForestPiece> pieces_of(const ForestCell& cell) const {
        return std::span(pieces_).subspan(cell.first_piece, cell.piece_count);
    }
    /// How often each instance stands somewhere; 0 where it has no triangles.
    [[nodiscard]] const std::vector<std::uint64_t>& uses() const { return uses_; }
    [[nodiscard]] const ForestKind& kind_of_instance(std::uint32_t instance) const;
    /// Branch instances with triangles.
    [[nodiscard]] std::uint64_t branches() const { return branches_; }
    [[nodiscard]] std::uint64_t triangles() const { return triangles_; }

    /// Calls visit(kind, number among all, branch) for the branches of a cell, tree by tree in
    /// their order in the forest. With triangles or without.
    template <typename Visit>
    void for_each_branch(const ForestCell& cell, const Visit& visit) const {
        for_each_branch_of(cell.first_tree, cell.tree_count, visit);
    }
    template <typename Visit>
    void for_each_branch(const ForestPiece& piece, const Visit& visit) const {
        for_each_branch_of(piece.first_tree, piece.tree_count, visit);
    }

private:
    void sort_trees(float cell);
    void cut_cells();
    void count_pieces(std::uint32_t threads);
    void find_groups();
    template <typename Visit>
    void for_each_branch_of(std::uint64_t first, std::uint64_t count, const Visit& visit) const;
    [[nodiscard]] std::vector<TreeExpander> make_expanders() const;
    [[nodiscard]] const Tree& tree_at(std::uint64_t place) const {
        return scene_.forest.trees[tree_of_place_.empty() ? place : tree_of_place_[place]];
    }
    [[nodiscard]] const ForestKind& kind_of(const Tree& tree) const {
        return kinds_[first_kind_[tree.species] + scene_.forest.stage_of(tree)];
    }

    const ForestScene& scene_;
    std::vector<ForestKind> kinds_;
    std::vector<std::uint32_t> first_kind_;    // of each species
    LargeVector<std::uint32_t> tree_of_place_; // empty: the trees lie as they are
    std::vector<ForestCell> cells_;
    std::vector<ForestPiece> pieces_;
    std::vector<ForestGroup> groups_;
    std::vector<std::uint64_t> uses_;
    std::uint64_t branches_ = 0;
    std::uint64_t triangles_ = 0;
};

template <typename Visit>
void ForestPlan::for_each_branch_of(std::uint64_t first,
                                    std::uint64_t count,
                                    const Visit& visit) const {
    std::vector<TreeExpander> expanders = make_expanders();
    for (std::uint64_t i = first; i < first + count; ++i) {
        const Tree& tree = tree_at(i);
        const ForestKind& kind = kind_of(tree);
        expanders[static_cast<std::size_t>(&kind - kinds_.data())].expand(
            tree, [&](const BranchInstance& branch) {
                visit(kind, kind.first + branch.instance, branch);
            });
    }
}

/// What the materials of a scene are, each once: a mesh of nothing but materials, each with a part,
/// and which of them those of the kinds and of the ground are.
struct ForestMaterials {
    Mesh samples;
    std::vector<std::vector<std::uint32_t>> of_kinds;
    std::vector<std::uint32_t> of_ground;
};
[[nodiscard]] ForestMaterials find_forest_materials(const ForestScene& scene,
                                                    const ForestPlan& plan);

/// The vertices that each used instance has, numbered for itself.
struct InstanceVertices {
    std::vector<std::uint64_t> first;    // of each instance, in `vertices`; one more at the end
    LargeVector<std::uint32_t> vertices; // of the mesh
    LargeVector<std::uint32_t> indices;  // beside those of the mesh: in the instance's own vertices

    [[nodiscard]] std::span<const std::uint32_t> of(std::uint32_t instance) const {
        return std::span(vertices).subspan(first[instance], first[instance + 1] - first[instance]);
    }
};
[[nodiscard]] InstanceVertices number_vertices(const ForestKind& kind, const ForestPlan& plan);

} // namespace lsys
