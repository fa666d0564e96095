// SPDX-License-Identifier: MIT
// ForestLod: level of detail of each tree of a forest for a camera. Trees lie in square cells of
// the ground; each tree in view is in one LOD band, by its height in the picture:
//   near     branches of the finest level
//   middle   branches of coarser levels
//   far      an impostor
//   horizon  one cluster impostor for all trees of its cell
// Branches are made when a tree comes near and forgotten after it has left. Draw lists are a
// function of forest and camera alone, not of earlier cameras.
#pragma once

#include "runtime/physics/physics.h"
#include "viewer/scene/added_trees.h"
#include "viewer/scene/branch_pool.h"
#include "viewer/scene/forest_model.h"
#include "viewer/scene/frustum.h"
#include "viewer/scene/ground_horizon.h"

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace lsys::view {

struct LodOptions {
    /// Min height of a tree in pixels for each level of branches.
    std::array<float, kTreeLevels> level_pixels{860.0F, 430.0F, 260.0F, 150.0F};
    /// Height of a cell's tallest tree in pixels below which the cell is drawn as a cluster.
    float cluster_pixels = 8.0F; // 0: never
    /// From the limit of a coarser band up to this multiple of it, both bands are drawn, each in a
    /// part of the pixels, so that trees change gradually.
    float blend = 1.25F;
    /// The multiple between two levels of branches, whose shapes differ less than those of a tree
    /// and its impostor.
    float level_blend = 1.04F;
    /// Max triangles of branches; with more, the heights of all trees in pixels are multiplied by
    /// DrawLists::detail, below 1.
    std::uint64_t max_triangles = 1'500'000;
    /// Max trees expanded into branches per picture; the others stay impostors until the next
    /// picture.
    std::uint32_t max_expansions = ~0U;
    /// Distance from the eye, m, at which the trees end. They fade over the last fifth.
    float tree_range = std::numeric_limits<float>::infinity();
    /// Wind, which moves trees beyond their bounds at rest.
    Wind wind;
};

/// Max displacement of trees by wind; bounds swayed() of shaders/forest.glsl.
struct Sway {
    float height_factor = 0.0F; // m per metre of the tree's height
    float width_factor = 0.0F;  // m per metre of the tree's width
    float flutter = 0.0F;       // m, max displacement of leaves in addition

    /// Max displacement, m, of a tree with height and width in m.
    [[nodiscard]] float displacement(float height, float width) const {
        return height_factor * height + width_factor * width + flutter;
    }
};
[[nodiscard]] Sway sway_in(const Wind& wind);

/// Range [low, high) of the dither thresholds of the pixels that an object draws while it blends
/// with another. dither_threshold() in shaders/blend.glsl gives each pixel a threshold, 0 to 1.
struct BlendRange {
    float low = 0.0F;
    float high = 1.0F;

    [[nodiscard]] bool is_whole() const { return low <= 0.0F && high >= 1.0F; }
    friend bool operator==(const BlendRange&, const BlendRange&) = default;
};

/// An impostor of a tree or of a cell.
struct ImpostorEntry {
    std::uint32_t index = 0;
    BlendRange range;

    friend bool operator==(const ImpostorEntry&, const ImpostorEntry&) = default;
};

/// A branch: slot in the pool and the pixels that it draws while its tree blends, packed as
/// shaders/branch.vert.glsl reads them.
class BranchEntry {
public:
    static constexpr std::uint32_t kSlotBits = 24;
    static constexpr std::uint32_t kBlendSteps = 127;

    BranchEntry() = default;
    /// `steps`: weight of the finer band in 1/kBlendSteps. The finer band draws the pixels with
    /// lower dither thresholds, a coarser level of branches the others.
    explicit BranchEntry(std::uint32_t slot,
                         std::uint32_t steps = kBlendSteps,
                         bool is_coarser = false)
        : bits_((is_coarser ? kCoarser : 0U) | steps << kSlotBits | slot) {}
    [[nodiscard]] std::uint32_t slot() const { return bits_ & ((1U << kSlotBits) - 1); }
    [[nodiscard]] std::uint32_t steps() const { return bits_ >> kSlotBits & kBlendSteps; }
    [[nodiscard]] bool is_coarser() const { return (bits_ & kCoarser) != 0; }

    friend bool operator==(const BranchEntry&, const BranchEntry&) = default;

private:
    static constexpr std::uint32_t kCoarser = 1U << 31U;
    std::uint32_t bits_ = 0;
};
static_assert(sizeof(BranchEntry) == 4);
static_assert(BranchPool::kMaxBranches <= 1U << BranchEntry::kSlotBits);

/// Branches of one instance at one level.
struct BranchRun {
    std::uint32_t form = 0;
    std::uint32_t level = 0;
    std::uint32_t instance = 0;
    std::uint32_t first = 0; // index in DrawLists::branches
    std::uint32_t count = 0;
    bool blends = false; // with another LOD band of the same trees
};

struct DrawLists {
    std::vector<BranchEntry> branches; // grouped by run
    std::vector<BranchRun> runs;
    // In `trees` and `clusters`, entries with the whole blend range precede blended ones.
    std::vector<ImpostorEntry> trees;    // their index is that of ForestLod::lod_tree()
    std::vector<ImpostorEntry> clusters; // impostors of cells; their index is that of the cell
    std::array<std::uint32_t, kTreeLevels> trees_of_level{}; // count of trees with branches in view
    std::uint64_t far_trees = 0;                             // trees in `trees` without branches
    std::uint64_t clustered_trees = 0; // trees of `clusters`, without those in `trees`
    std::uint64_t blended = 0;         // trees drawn in two bands
    std::uint64_t occluded = 0;        // trees occluded by the ground
    std::uint64_t triangles = 0;       // triangles of the branches
    std::uint32_t expanded = 0;        // trees expanded into branches for this picture
    std::uint32_t waiting = 0;         // near trees without branches yet, drawn as impostors
    float detail = 1.0F;               // factor of tree heights; below 1 to keep max_triangles
};

/// A square of the ground.
struct ForestCell {
    std::uint32_t first = 0; // index in ForestLod::trees()
    std::uint32_t count = 0;
    glm::vec3 low{}; // bounding box of its trees
    glm::vec3 high{};
    glm::vec3 middle{};        // mean position of its trees
    float scale = 1.0F;        // mean scale of its trees
    float tallest = 0.0F;      // m
    std::uint16_t form = 0;    // most frequent form of its trees
    std::uint32_t seed = 0;    // in a streamed forest, number of the cell's first tree
    std::uint32_t removed = 0; // count of removed trees; with any, the cell is never a cluster
};

/// Bounding sphere of a tree, for any choice of its branches.
[[nodiscard]] Sphere bounding_sphere(const ForestModel& model, const LodTree& tree, float yaw);
/// Bounding sphere of the impostor of a tree.
[[nodiscard]] Sphere impostor_sphere(const ForestModel& model, const LodTree& tree);
/// Sets the fields of a cell that its trees determine. LodTree::tree is an index in `all`.
void describe_cell(const ForestModel& model,
                   std::span<const LodTree> trees,
                   std::span<const Tree> all,
                   ForestCell& cell);

struct ForestSquare;
struct SquareId;

/// A range of ForestLod::trees().
struct TreeSpan {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

class ForestLod {
public:
    /// The model must outlive this object.
    explicit ForestLod(const ForestModel& model);

    /// Adds or removes a tree, in time independent of the size of the forest. `index`: index in
    /// Forest::trees; the indices of added trees follow, in order of addition. A removed added tree
    /// may be replaced, and a tree of the forest may get another yaw and, with it, surroundings.
    /// Returns the index for lod_tree().
    std::uint32_t change_tree(std::uint32_t index, const Tree& tree, bool alive);

    /// For a streamed forest: sets the place of the world, in m, to which all places are relative,
    /// and updates the places of the trees.
    void set_origin(const glm::dvec3& origin);
    /// Adds the trees of a square of a streamed forest, or removes them. Time is linear in the trees
    /// of the square.
    void add_square(std::shared_ptr<const ForestSquare> square);
    void remove_square(const SquareId& id);
    /// Trees added or moved since the last call.
    [[nodiscard]] std::vector<TreeSpan> take_changed_trees();
    /// Box of all trees that were added or removed since the last call.
    [[nodiscard]] Bounds take_changed_box();
    [[nodiscard]] const glm::dvec3& origin() const { return origin_; }
    /// Mean scale of the trees of each form; 0 without trees.
    [[nodiscard]] std::vector<float> mean_scales() const;

    /// Draw lists of a camera. `ground`: occluder, or null.
    [[nodiscard]] const DrawLists&
    select(const Frustum& frustum, const LodOptions& options, GroundHorizon* ground = nullptr);

    [[nodiscard]] const ForestModel& model() const { return model_; }
    /// Trees of the forest, by cell. Indices of added trees follow.
    [[nodiscard]] std::span<const LodTree> trees() const { return trees_; }
    [[nodiscard]] const LodTree& lod_tree(std::uint32_t number) const {
        return number < trees_.size() ? trees_[number] : added_.at(number - first_added());
    }
    [[nodiscard]] Tree tree_of(std::uint32_t number) const {
        return model_.streamed != nullptr ? streamed_tree(number)
               : number < trees_.size()   ? placed_tree(number)
                                          : added_.tree(number - first_added());
    }
    /// Calls visit(LodTree, Tree) for each tree that was not removed.
    template <typename Visit>
    void for_each_alive(const Visit& visit) const {
        for (std::uint32_t number = 0; number < trees_.size(); ++number) {
            if (!trees_[number].is_removed()) {
                visit(trees_[number], tree_of(number));
            }
        }
        added_.visit([](const AddedTrees::Cell&) { return true; },
                     [&](std::uint32_t slot) { visit(added_.at(slot), added_.tree(slot)); });
    }
    /// Count of trees without removed ones.
    [[nodiscard]] std::uint64_t alive_count() const { return alive_count_; }
    [[nodiscard]] std::span<const ForestCell> cells() const { return cells_; }
    [[nodiscard]] const Bounds& bounds() const { return bounds_; }
    /// Cell of a tree of the forest, not of an added one. Precondition: there are cells.
    [[nodiscard]] std::uint32_t cell_number(const glm::vec3& place) const {
        return static_cast<std::uint32_t>(cell_of(place));
    }
    /// Count of the trees of the forest and of added trees, removed ones included.
    [[nodiscard]] std::uint32_t tree_count() const { return first_added() + added_.size(); }
    [[nodiscard]] double cell_size() const { return cell_size_; } // m
    [[nodiscard]] BranchPool& pool() { return pool_; }
    [[nodiscard]] const BranchPool& pool() const { return pool_; }
    /// Lists all branches of trees in one level. Replaces `branches`, and the branches and runs of
    /// `lists`, whose entries have indices in `branches` as slots.
    void list_whole_trees(std::span<const std::uint32_t> trees,
                          std::uint32_t level,
                          std::vector<PoolBranch>& branches,
                          DrawLists& lists);
    /// Appends the trees of all cells that overlap a box seen from above.
    void find_within(const Bounds& box, std::vector<std::uint32_t>& trees) const;
    /// Fraction of the sky above `eye` that crowns hide, 0 to 1. Near crowns count more; those whose
    /// tops are less than a metre above the eye do not count.
    [[nodiscard]] float crown_cover(const glm::vec3& eye) const;
    [[nodiscard]] Sphere bounding_sphere(const LodTree& tree, float yaw) const {
        return view::bounding_sphere(model_, tree, yaw);
    }
    [[nodiscard]] Sphere impostor_sphere(const LodTree& tree) const {
        return view::impostor_sphere(model_, tree);
    }
    [[nodiscard]] std::uint64_t byte_count() const;

private:
    /// A tree high enough for branches.
    struct BranchCandidate {
        std::uint32_t tree = 0;
        float pixels = 0.0F;
    };

    /// A tree with branches in view, in one level.
    struct VisibleTree {
        std::uint32_t first = 0; // index in visible_branches_
        std::uint32_t end = 0;
        std::uint32_t first_mesh = 0; // index in mesh_counts_
    };
    /// Groups of mesh_counts_: trees of each level, then blended trees of each level.
    static constexpr std::uint32_t kGroups = 2 * kTreeLevels;

    /// A shown square of a streamed forest. The cells of square i begin in cells_ at i times the
    /// count of cells of a square.
    struct ShownSquare {
        std::shared_ptr<const ForestSquare> square; // null: free
        std::uint32_t first = 0;                    // index in trees_
        glm::vec3 low{};                            // bounding box of its trees
        glm::vec3 high{};
    };
    /// A cell in view. `order` and `cell` sort cells at one distance in the same way wherever they
    /// are stored.
    struct VisibleCell {
        float distance = 0.0F; // m, from the eye
        std::uint64_t order = 0;
        std::uint32_t cell = 0; // index in cells_

        friend auto operator<=>(const VisibleCell&, const VisibleCell&) = default;
    };

    void sort_into_cells();
    [[nodiscard]] const Tree& placed_tree(std::uint32_t number) const {
        const auto turned = turned_.empty() ? turned_.end() : turned_.find(number);
        return turned == turned_.end() ? model_.forest->trees[trees_[number].tree] : turned->second;
    }
    void turn_tree(std::uint32_t number, const Tree& tree, ForestCell& cell);
    [[nodiscard]] Tree streamed_tree(std::uint32_t number) const;
    /// Finds room for `count` trees in trees_. Returns the index of the first.
    [[nodiscard]] std::uint32_t allocate_trees(std::uint32_t count);
    void release_trees(std::uint32_t first, std::uint32_t count);
    /// Copies the trees and cells of a shown square relative to origin_.
    void place_square(std::uint32_t index);
    void list_visible_cells(const Frustum& frustum);
    /// Lists the visible cells among `count` from `first` on.
    void list_visible_cells(const Frustum& frustum,
                            std::uint32_t first,
                            std::uint32_t count,
                            std::uint64_t order);
    [[nodiscard]] std::uint32_t first_added() const {
        return static_cast<std::uint32_t>(trees_.size());
    }
    [[nodiscard]] std::uint64_t cell_of(const glm::vec3& place) const;
    [[nodiscard]] LodTree make_lod_tree(const Tree& tree, std::uint32_t index);
    /// `weight`: weight of the tree's impostor; the cluster of its cell has 1 - `weight`.
    void visit_tree(std::uint32_t number,
                    const Frustum& frustum,
                    const LodOptions& options,
                    float weight = 1.0F);
    /// Length in m that must be small on the screen where a cell is drawn as a cluster: the height
    /// of its trees; twice the max error of the height at which it shows trees at its edges, as its
    /// picture is taken from one of few elevations; seen from above, about its side.
    [[nodiscard]] float cluster_size(const ForestCell& cell, const glm::vec3& eye) const;
    /// Lists a cell as a cluster, as its trees, or as both.
    void visit_cell(std::uint32_t index,
                    float distance,
                    const Frustum& frustum,
                    const LodOptions& options);
    /// Branches of a tree in the pool, made if needed. Count 0: none in this picture.
    [[nodiscard]] PoolSpan branches_of(std::uint32_t number, const LodOptions& options);
    /// Sorts visible branches into runs.
    void list_runs();
    [[nodiscard]] float sway_of(const LodTree& tree) const; // m
    /// Bounding box of the impostor of `tree` as seen from `eye`.
    [[nodiscard]] Bounds impostor_box(const LodTree& tree, const glm::vec3& eye) const;
    [[nodiscard]] bool is_occluded(const Bounds& box, float sway) const;
    /// Grows a sphere around a part of a tree by the wind.
    [[nodiscard]] Sphere swaying(const Sphere& sphere, const LodTree& tree) const;
    /// Appends the visible branches of a tree to visible_branches_.
    void cull_branches(const PoolSpan& span,
                       const LodTree& tree,
                       float yaw,
                       std::uint32_t blend_steps,
                       const Frustum& frustum);
    /// Weight of a level of branches against the next LOD band, in 1/BranchEntry::kBlendSteps.
    [[nodiscard]] static std::uint32_t
    blend_steps(float pixels, std::uint32_t level, const LodOptions& options);
    /// Level of branches for a height in pixels; kTreeLevels: an impostor.
    [[nodiscard]] static std::uint32_t level_of(float pixels, const LodOptions& options);
    [[nodiscard]] float detail_in_budget(const LodOptions& options) const;
    void list_branches(const Frustum& frustum, const LodOptions& options);

    const ForestModel& model_;
    LargeVector<LodTree> trees_;
    std::map<std::uint32_t, Tree> turned_; // trees of the forest whose yaw has changed
    std::vector<ForestCell> cells_;
    Bounds bounds_;
    double cell_size_ = 1.0; // m, side of a cell
    glm::vec2 cells_low_{};  // corner of the first cell
    std::uint64_t columns_ = 0;
    std::uint64_t rows_ = 0;
    AddedTrees added_;
    std::uint64_t alive_count_ = 0;
    BranchPool pool_;
    std::vector<TreeExpander> expanders_;   // by form
    std::vector<std::uint32_t> first_mesh_; // by form: index of its first group in mesh_counts_
    DrawLists lists_;
    std::vector<BranchCandidate> candidates_;
    std::vector<ImpostorEntry> far_;
    std::vector<BranchEntry> visible_branches_;
    std::vector<PoolBranch> made_branches_;
    std::vector<VisibleTree> visible_trees_; // owners of visible_branches_
    Sway sway_;
    GroundHorizon* ground_ = nullptr; // during select()
    std::vector<VisibleCell> visible_cells_;
    std::vector<std::uint32_t> mesh_counts_; // visible branches by form, group and instance
    // The members below are used in streamed forests only.
    glm::dvec3 origin_{};
    std::vector<ShownSquare> squares_;
    std::vector<std::uint32_t> free_squares_;
    std::map<std::uint32_t, std::uint32_t> square_of_tree_; // first tree and index in squares_
    std::map<std::uint32_t, std::uint32_t>
        free_trees_; // free ranges of trees_; adjacent ones merged
    std::vector<TreeSpan> changed_trees_;
    Bounds changed_box_;
};

} // namespace lsys::view
