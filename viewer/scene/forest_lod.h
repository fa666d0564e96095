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
    /// Min height in pixels of a tree that is drawn in each level of branches.
    std::array<float, kTreeLevels> level_pixels{860.0F, 430.0F, 260.0F, 150.0F};
    /// Height in pixels of the tallest tree of a cell below which the cell is drawn as a cluster.
    float cluster_pixels = 8.0F; // 0: never
    /// From the limit of a coarser band up to `blend` times this limit, both bands are drawn, each
    /// in a part of the pixels, so that trees change gradually.
    float blend = 1.25F;
    /// Like `blend`, between two levels of branches, whose shapes differ less than those of a tree
    /// and its impostor.
    float level_blend = 1.04F;
    /// Max triangles of branches. If there are more, the heights in pixels of all trees are
    /// multiplied by DrawLists::detail, which is then below 1.
    std::uint64_t max_triangles = 1'500'000;
    /// Max number of trees that are expanded into branches per picture; further trees stay
    /// impostors until the next picture.
    std::uint32_t max_expansions = ~0U;
    /// Distance from the eye, in m, beyond which no trees are drawn. Trees fade over the last fifth
    /// of it.
    float tree_range = std::numeric_limits<float>::infinity();
    /// Wind, which moves parts of trees out of the bounds that the trees have at rest.
    Wind wind;
};

/// Max displacement of trees by wind. An upper bound of swayed() in shaders/forest.glsl.
struct Sway {
    float height_factor = 0.0F; // m per metre of the tree's height
    float width_factor = 0.0F;  // m per metre of the tree's width
    float flutter = 0.0F;       // m, max additional displacement of leaves

    /// Max displacement in m of a tree with the given height and width in m.
    [[nodiscard]] float displacement(float height, float width) const {
        return height_factor * height + width_factor * width + flutter;
    }
};
/// The largest displacements in a wind.
[[nodiscard]] Sway sway_in(const Wind& wind);

/// Range [low, high) of dither thresholds: while an object blends with another object, it draws
/// only pixels whose threshold is in this range. shaders/blend.glsl assigns each pixel, or each
/// sample of a pixel, a threshold, 0 to 1.
struct BlendRange {
    float low = 0.0F;
    float high = 1.0F;

    [[nodiscard]] bool is_whole() const { return low <= 0.0F && high >= 1.0F; }
    friend bool operator==(const BlendRange&, const BlendRange&) = default;
};

/// An impostor of a tree or of a cell.
struct ImpostorEntry {
    std::uint32_t index = 0; // of the tree (lod_tree()) or of the cell
    BlendRange range;

    friend bool operator==(const ImpostorEntry&, const ImpostorEntry&) = default;
};

/// A branch: its slot in the pool, and the pixels that it draws while its tree blends. Packed as
/// shaders/branch.vert.glsl reads it.
class BranchEntry {
public:
    static constexpr std::uint32_t kSlotBits = 24;
    static constexpr std::uint32_t kBlendSteps = 127;

    BranchEntry() = default;
    /// `steps`: weight of the finer band in 1/kBlendSteps. The finer band draws the pixels with the
    /// lower dither thresholds, a coarser level of branches (`is_coarser`) the others.
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

/// Consecutive entries of DrawLists::branches for one instance at one level.
struct BranchRun {
    std::uint32_t form = 0;
    std::uint32_t level = 0;
    std::uint32_t instance = 0;
    std::uint32_t first = 0; // index in DrawLists::branches
    std::uint32_t count = 0;
    bool blends = false; // whether the trees blend with another LOD band
};

struct DrawLists {
    std::vector<BranchEntry> branches; // grouped by run
    std::vector<BranchRun> runs;
    // In `trees` and `clusters`, entries with the whole blend range come before blended entries.
    std::vector<ImpostorEntry> trees;    // `index`: as for ForestLod::lod_tree()
    std::vector<ImpostorEntry> clusters; // impostors of cells; their index is that of the cell
    std::array<std::uint32_t, kTreeLevels> trees_of_level{}; // trees with branches in view
    std::uint64_t far_trees = 0;                             // trees in `trees` without branches
    std::uint64_t clustered_trees = 0; // number of trees in `clusters` that are not in `trees`
    std::uint64_t blended = 0;         // number of trees drawn in two bands
    std::uint64_t occluded = 0;        // number of trees that the ground occludes
    std::uint64_t triangles = 0;       // triangles of the branches
    std::uint32_t expanded = 0;        // number of trees expanded for this picture
    std::uint32_t waiting = 0;         // near trees without branches yet, drawn as impostors
    float detail = 1.0F;               // factor of heights in pixels; below 1 to keep max_triangles
};

/// A square of the ground with its trees.
struct ForestCell {
    std::uint32_t first = 0; // index in ForestLod::trees()
    std::uint32_t count = 0;
    glm::vec3 low{}; // bounding box of its trees
    glm::vec3 high{};
    glm::vec3 middle{};        // mean position of its trees
    float scale = 1.0F;        // mean scale of its trees
    float tallest = 0.0F;      // m
    std::uint16_t form = 0;    // most frequent form of its trees
    std::uint32_t seed = 0;    // in a streamed forest, number of the first tree of the cell
    std::uint32_t removed = 0; // number of removed trees; with any, the cell is no cluster
};

/// Bounding sphere of a tree, whatever branches are chosen for it.
[[nodiscard]] Sphere bounding_sphere(const ForestModel& model, const LodTree& tree, float yaw);
/// Bounding sphere of the impostor of a tree.
[[nodiscard]] Sphere impostor_sphere(const ForestModel& model, const LodTree& tree);
/// Sets those members of a cell that its trees determine. `all`: the array to which LodTree::tree
/// refers.
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
    /// `model` must outlive this object.
    explicit ForestLod(const ForestModel& model);

    /// Adds or removes a tree, in time independent of the size of the forest. `index`: index in
    /// Forest::trees; added trees have the indices after these, in the order of addition. An added
    /// tree that was removed may be replaced. For a tree of the forest, only yaw and the form that
    /// its surroundings select may change. Returns the index of the tree for lod_tree().
    std::uint32_t change_tree(std::uint32_t index, const Tree& tree, bool alive);

    /// For a streamed forest: sets the place of the world, in m, to which all places are relative,
    /// and updates the places of all trees.
    void set_origin(const glm::dvec3& origin);
    /// Adds or removes the trees of a square of a streamed forest. Time is linear in the number of
    /// trees of the square.
    void add_square(std::shared_ptr<const ForestSquare> square);
    void remove_square(const SquareId& id);
    /// Ranges of trees that were added or moved since the last call.
    [[nodiscard]] std::vector<TreeSpan> take_changed_trees();
    /// Bounding box of all trees that were added or removed since the last call.
    [[nodiscard]] Bounds take_changed_box();
    [[nodiscard]] const glm::dvec3& origin() const { return origin_; }
    /// By form: mean scale of its trees; 0 if it has none.
    [[nodiscard]] std::vector<float> mean_scales() const;

    /// Draw lists for a camera. `ground`: the occluder, or null.
    [[nodiscard]] const DrawLists&
    select(const Frustum& frustum, const LodOptions& options, GroundHorizon* ground = nullptr);

    [[nodiscard]] const ForestModel& model() const { return model_; }
    /// Trees of the forest, sorted by cell. Indices for lod_tree() from trees().size() on are those
    /// of added trees.
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
    /// Number of trees that are not removed.
    [[nodiscard]] std::uint64_t alive_count() const { return alive_count_; }
    [[nodiscard]] std::span<const ForestCell> cells() const { return cells_; }
    [[nodiscard]] const Bounds& bounds() const { return bounds_; }
    /// Index of the cell of a tree of the forest; not for added trees. Precondition: there are
    /// cells.
    [[nodiscard]] std::uint32_t cell_number(const glm::vec3& place) const {
        return static_cast<std::uint32_t>(cell_of(place));
    }
    /// Number of the trees of the forest and of added trees, including removed ones.
    [[nodiscard]] std::uint32_t tree_count() const { return first_added() + added_.size(); }
    [[nodiscard]] double cell_size() const { return cell_size_; } // m
    [[nodiscard]] BranchPool& pool() { return pool_; }
    [[nodiscard]] const BranchPool& pool() const { return pool_; }
    /// Lists all branches of trees, in one level. Overwrites `branches`, and the branches and runs
    /// of `lists`; the slots in the entries of `lists` are indices in `branches`.
    void list_whole_trees(std::span<const std::uint32_t> trees,
                          std::uint32_t level,
                          std::vector<PoolBranch>& branches,
                          DrawLists& lists);
    /// Appends to `trees` the trees in all cells that overlap a box, seen from above.
    void find_within(const Bounds& box, std::vector<std::uint32_t>& trees) const;
    /// Fraction of the sky above `eye` that crowns hide, 0 to 1. Near crowns count more. Crowns
    /// whose tops are less than a metre above the eye do not count.
    [[nodiscard]] float crown_cover(const glm::vec3& eye) const;
    [[nodiscard]] Sphere bounding_sphere(const LodTree& tree, float yaw) const {
        return view::bounding_sphere(model_, tree, yaw);
    }
    [[nodiscard]] Sphere impostor_sphere(const LodTree& tree) const {
        return view::impostor_sphere(model_, tree);
    }
    [[nodiscard]] std::uint64_t byte_count() const;

private:
    /// A tree that is high enough in the picture to be drawn as branches.
    struct BranchCandidate {
        std::uint32_t tree = 0;
        float pixels = 0.0F; // height in the picture at detail 1
    };

    /// A tree in one level that has branches in view.
    struct VisibleTree {
        std::uint32_t first = 0; // index in visible_branches_
        std::uint32_t end = 0;
        std::uint32_t first_mesh = 0; // index in mesh_counts_
    };
    /// Number of groups in mesh_counts_: trees of each level, then blended trees of each level.
    static constexpr std::uint32_t kGroups = 2 * kTreeLevels;

    /// A square of a streamed forest that is shown. The cells of square i begin at index i *
    /// (number of cells of a square) in cells_.
    struct ShownSquare {
        std::shared_ptr<const ForestSquare> square; // null: the entry is free
        std::uint32_t first = 0;                    // index in trees_
        glm::vec3 low{};                            // bounding box of its trees
        glm::vec3 high{};
    };
    /// A cell in view. `order` and `cell` define the order of cells at the same distance, wherever
    /// the cells are stored.
    struct VisibleCell {
        float distance = 0.0F; // m, from the eye
        std::uint64_t order = 0;
        std::uint32_t cell = 0; // index in cells_

        friend auto operator<=>(const VisibleCell&, const VisibleCell&) = default;
    };

    void sort_into_cells(); // makes cells_ and trees_ from the placed trees
    [[nodiscard]] const Tree& placed_tree(std::uint32_t number) const {
        const auto turned = turned_.empty() ? turned_.end() : turned_.find(number);
        return turned == turned_.end() ? model_.forest->trees[trees_[number].tree] : turned->second;
    }
    /// Sets yaw and form of a tree in `cell` whose surroundings have changed.
    void replace_yaw_and_form(std::uint32_t number, const Tree& tree, ForestCell& cell);
    [[nodiscard]] Tree streamed_tree(std::uint32_t number) const; // from its square
    /// Finds a free range of `count` trees in trees_. Returns its first index.
    [[nodiscard]] std::uint32_t allocate_trees(std::uint32_t count);
    void release_trees(std::uint32_t first, std::uint32_t count); // makes a range of trees_ free
    /// Copies the trees and cells of a shown square, with places relative to origin_.
    void place_square(std::uint32_t index);
    void list_visible_cells(const Frustum& frustum);
    /// Lists the visible cells among the `count` cells from index `first` on. `order`: their
    /// VisibleCell::order.
    void list_visible_cells(const Frustum& frustum,
                            std::uint32_t first,
                            std::uint32_t count,
                            std::uint64_t order);
    [[nodiscard]] std::uint32_t first_added() const {
        return static_cast<std::uint32_t>(trees_.size());
    }
    [[nodiscard]] std::uint64_t cell_of(const glm::vec3& place) const; // of a tree of the forest
    /// `index`: LodTree::tree.
    [[nodiscard]] LodTree make_lod_tree(const Tree& tree, std::uint32_t index);
    /// Lists a tree. `weight`: weight of its impostor; the cluster of its cell has the weight 1 -
    /// `weight`.
    void visit_tree(std::uint32_t number,
                    const Frustum& frustum,
                    const LodOptions& options,
                    float weight = 1.0F);
    /// Length in m that decides whether a cell is drawn as a cluster: the length must be small on
    /// the screen. It is the largest of: the height of the trees; twice the max error of the height
    /// at which the cluster shows trees at its edges, because its picture is taken from one of few
    /// elevations; and, seen from above, about the side of the cell.
    [[nodiscard]] float cluster_size(const ForestCell& cell, const glm::vec3& eye) const;
    /// Lists a cell as a cluster, as single trees, or as both.
    void visit_cell(std::uint32_t index,
                    float distance,
                    const Frustum& frustum,
                    const LodOptions& options);
    /// The branches of a tree in the pool; they are made if the pool does not have them. Count 0:
    /// they are not drawn in this picture.
    [[nodiscard]] PoolSpan branches_of(std::uint32_t number, const LodOptions& options);
    /// Sorts the visible branches into runs.
    void list_runs();
    [[nodiscard]] float sway_of(const LodTree& tree) const; // m, max displacement by wind
    /// Bounding box of the impostor of `tree` as seen from `eye`.
    [[nodiscard]] Bounds impostor_box(const LodTree& tree, const glm::vec3& eye) const;
    [[nodiscard]] bool is_occluded(const Bounds& box, float sway) const; // by ground_
    /// The sphere around a part of a tree, enlarged by the max displacement by wind.
    [[nodiscard]] Sphere swaying(const Sphere& sphere, const LodTree& tree) const;
    /// Appends the branches of a tree that are in view to visible_branches_.
    void cull_branches(const PoolSpan& span,
                       const LodTree& tree,
                       float yaw,
                       std::uint32_t blend_steps,
                       const Frustum& frustum);
    /// Weight, in 1/BranchEntry::kBlendSteps, of a level of branches while it blends with the next
    /// LOD band.
    [[nodiscard]] static std::uint32_t
    blend_steps(float pixels, std::uint32_t level, const LodOptions& options);
    /// Level of branches of a tree with a height in pixels; kTreeLevels: the tree is an impostor.
    [[nodiscard]] static std::uint32_t level_of(float pixels, const LodOptions& options);
    /// The largest DrawLists::detail at which the branches stay within max_triangles.
    [[nodiscard]] float detail_in_budget(const LodOptions& options) const;
    void list_branches(const Frustum& frustum, const LodOptions& options); // of all candidates_

    const ForestModel& model_;
    LargeVector<LodTree> trees_;
    std::map<std::uint32_t, Tree> turned_; // trees of the forest whose yaw was changed
    std::vector<ForestCell> cells_;
    Bounds bounds_;
    double cell_size_ = 1.0; // m, side of a cell
    glm::vec2 cells_low_{};  // lowest corner of the first cell
    std::uint64_t columns_ = 0;
    std::uint64_t rows_ = 0;
    AddedTrees added_;
    std::uint64_t alive_count_ = 0;
    BranchPool pool_;
    std::vector<TreeExpander> expanders_;     // by form
    std::vector<std::uint32_t> first_mesh_;   // by form: index of its first group in mesh_counts_
    DrawLists lists_;                         // result of select()
    std::vector<BranchCandidate> candidates_; // of the current select()
    std::vector<ImpostorEntry> far_;          // impostors of trees that are too low for branches
    std::vector<BranchEntry> visible_branches_;
    std::vector<PoolBranch> made_branches_;  // branches of the tree that is being expanded
    std::vector<VisibleTree> visible_trees_; // trees of visible_branches_
    Sway sway_;
    GroundHorizon* ground_ = nullptr; // the occluder, during select()
    std::vector<VisibleCell> visible_cells_;
    std::vector<std::uint32_t>
        mesh_counts_; // visible branches by form, group (see kGroups) and instance
    // The members below are used in streamed forests only.
    glm::dvec3 origin_{};
    std::vector<ShownSquare> squares_;
    std::vector<std::uint32_t> free_squares_;               // indices in squares_ for new squares
    std::map<std::uint32_t, std::uint32_t> square_of_tree_; // by first tree: index in squares_
    std::map<std::uint32_t, std::uint32_t>
        free_trees_;                      // free ranges of trees_; adjacent ranges are merged
    std::vector<TreeSpan> changed_trees_; // for take_changed_trees()
    Bounds changed_box_;                  // for take_changed_box()
};

} // namespace lsys::view
