// SPDX-License-Identifier: MIT
// ForestPlan: counts the instances in each cell of the ground by expanding all trees once.
// Transforms are not stored: writers that need transforms expand the trees again.
#pragma once

#include "runtime/export/export_forest.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace lsys {

/// A stage of a species: plants with one number of generations, see ForestSpecies::stages.
struct ExportedStage {
    std::uint32_t species = 0;
    std::uint32_t stage_index = 0; // index in ForestSpecies::stages
    std::uint32_t first = 0;       // number of its first instance among all stages
    const InstanceCache* cache = nullptr;
    const InstanceMeshes* meshes = nullptr;
    std::uint64_t trees = 0; // number of trees
};

/// All copies of one instance in one cell.
struct ForestGroup {
    std::uint32_t instance = 0; // number among all stages
    std::uint64_t first = 0;    // number of instances in all earlier groups
    std::uint64_t count = 0;
};

/// Consecutive trees of one cell: the unit of work of a thread.
struct ForestPiece {
    std::uint64_t first_tree = 0; // index in the order of the plan, which is cell by cell
    std::uint64_t tree_count = 0;
    /// Pairs (instance, its count in earlier pieces of the cell) for the instances of this piece,
    /// sorted by instance.
    std::vector<std::pair<std::uint32_t, std::uint64_t>> counts_before;
};

struct ForestCell {
    std::int64_t x = 0; // in units of the side of a cell
    std::int64_t z = 0;
    std::uint64_t first_tree = 0; // index in the order of the plan
    std::uint64_t tree_count = 0;
    std::size_t first_piece = 0;
    std::size_t piece_count = 0;
    std::size_t first_group = 0;
    std::size_t group_count = 0;
    std::uint64_t branches = 0; // branch instances with triangles
};

class ForestPlan {
public:
    /// `cell`: side in m; 0: there is one cell. `threads`: 0: as many as the machine has.
    ForestPlan(const ForestScene& scene, float cell, std::uint32_t threads);

    [[nodiscard]] std::span<const ExportedStage> stages() const { return stages_; }
    /// Cells with triangles, by z, then x.
    [[nodiscard]] std::span<const ForestCell> cells() const { return cells_; }
    /// Groups of all cells, within a cell by ascending number of the instance.
    [[nodiscard]] std::span<const ForestGroup> groups() const { return groups_; }
    [[nodiscard]] std::span<const ForestPiece> pieces_of(const ForestCell& cell) const {
        return std::span(pieces_).subspan(cell.first_piece, cell.piece_count);
    }
    /// Count of each instance in the forest; 0 for instances without triangles.
    [[nodiscard]] const std::vector<std::uint64_t>& instance_counts() const {
        return instance_counts_;
    }
    [[nodiscard]] const ExportedStage& stage_of_instance(std::uint32_t instance) const;
    /// Branch instances with triangles.
    [[nodiscard]] std::uint64_t branch_count() const { return branch_count_; }
    [[nodiscard]] std::uint64_t triangle_count() const { return triangle_count_; }

    /// Calls visit(stage, number of the instance among all stages, branch) for all branches of a
    /// cell, even without triangles, tree by tree in the order of the forest.
    template <typename Visit>
    void for_each_branch(const ForestCell& cell, const Visit& visit) const {
        for_each_branch_of(cell.first_tree, cell.tree_count, visit);
    }
    template <typename Visit>
    void for_each_branch(const ForestPiece& piece, const Visit& visit) const {
        for_each_branch_of(piece.first_tree, piece.tree_count, visit);
    }

private:
    /// Sorts trees by cells, within a cell in the order of the forest.
    void sort_trees(float cell);
    void split_cells_into_pieces();
    /// Sets ForestPiece::counts_before to the counts of the piece itself; find_groups() then
    /// replaces them by the counts in earlier pieces.
    void count_pieces(std::uint32_t threads);
    /// Sets the groups of all cells, the counts of instances and the final
    /// ForestPiece::counts_before; removes cells without groups.
    void find_groups();
    /// Calls visit(stage, number of the instance among all stages, branch) for each branch of the
    /// `count` trees from the tree `first` of the plan on.
    template <typename Visit>
    void for_each_branch_of(std::uint64_t first, std::uint64_t count, const Visit& visit) const;
    [[nodiscard]] std::vector<TreeExpander> make_expanders() const;
    /// The tree at a place in the order of the plan.
    [[nodiscard]] const Tree& tree_at(std::uint64_t place) const {
        return scene_.forest.trees[tree_of_place_.empty() ? place : tree_of_place_[place]];
    }
    [[nodiscard]] const ExportedStage& stage_of(const Tree& tree) const {
        return stages_[first_stage_[tree.species] + scene_.forest.stage_of(tree)];
    }

    const ForestScene& scene_;
    std::vector<ExportedStage> stages_;
    std::vector<std::uint32_t> first_stage_;   // by species
    LargeVector<std::uint32_t> tree_of_place_; // in the order of the plan; empty: as the forest
    std::vector<ForestCell> cells_;
    std::vector<ForestPiece> pieces_;
    std::vector<ForestGroup> groups_;
    std::vector<std::uint64_t> instance_counts_;
    std::uint64_t branch_count_ = 0;
    std::uint64_t triangle_count_ = 0;
};

template <typename Visit>
void ForestPlan::for_each_branch_of(std::uint64_t first,
                                    std::uint64_t count,
                                    const Visit& visit) const {
    std::vector<TreeExpander> expanders = make_expanders();
    for (std::uint64_t i = first; i < first + count; ++i) {
        const Tree& tree = tree_at(i);
        const ExportedStage& stage = stage_of(tree);
        expanders[static_cast<std::size_t>(&stage - stages_.data())].expand(
            tree, [&](const BranchInstance& branch) {
                visit(stage, stage.first + branch.instance, branch);
            });
    }
}

/// Distinct materials of a scene. `of_stages` and `of_ground` have the number of the distinct
/// material for each material of a mesh.
struct ForestMaterials {
    Mesh samples; // of material_samples.h: a part for each material
    std::vector<std::vector<std::uint32_t>> of_stages;
    std::vector<std::uint32_t> of_ground;
};
[[nodiscard]] ForestMaterials find_forest_materials(const ForestScene& scene,
                                                    const ForestPlan& plan);

/// Vertices of each used instance, numbered from 0 within the instance.
struct InstanceVertices {
    std::vector<std::uint64_t> first;    // index in `vertices`, by instance; then vertices.size()
    LargeVector<std::uint32_t> vertices; // indices in the mesh
    LargeVector<std::uint32_t>
        indices; // parallel to the indices of the mesh, numbered within the instance

    [[nodiscard]] std::span<const std::uint32_t> of(std::uint32_t instance) const {
        return std::span(vertices).subspan(first[instance], first[instance + 1] - first[instance]);
    }
};
/// The vertices of the used instances of a stage.
[[nodiscard]] InstanceVertices number_vertices(const ExportedStage& stage, const ForestPlan& plan);

} // namespace lsys
