// ForestLod: which trees of a forest are drawn as what, for a camera. Trees lie in cells of the
// ground; each tree in view is in one ring, by how large it is in the picture:
//   near     its branches, finest level
//   middle   its branches, coarser levels
//   far      one picture of a tree (impostor)
//   horizon  one picture for all trees of a cell
// Branches are made when a tree comes near and forgotten after it has left. What is listed is a
// function of forest and camera alone, whatever was looked at before.
#pragma once

#include "runtime/physics/physics.h"
#include "viewer/scene/added_trees.h"
#include "viewer/scene/branch_pool.h"
#include "viewer/scene/forest_model.h"
#include "viewer/scene/frustum.h"
#include "viewer/scene/ground_horizon.h"

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace lsys::view {

struct LodOptions {
    /// Heights of a tree in pixels from which on it is drawn as each level of branches.
    std::array<float, kTreeLevels> level_pixels{860.0F, 430.0F, 260.0F, 150.0F};
    /// Below this, cells are drawn as one.
    float cluster_pixels = 8.0F; // 0: never
    /// What is up to so many times as large as impostors, or cells, may be is drawn as both: a part
    /// of the pixels as each, so that none comes or goes at once.
    float blend = 1.25F;
    /// Of branches; with more, all trees count as smaller than they are.
    std::uint64_t most_triangles = 1'500'000;
    /// Trees whose branches are made for one picture; others have to wait, as impostors.
    std::uint32_t most_expansions = ~0U;
    /// That trees are moved by: what is not in view may come there.
    Wind wind;
};

/// How far wind moves what there is of a tree, as shaders/forest.glsl has it.
struct Sway {
    float of_height = 0.0F; // m, for each metre of the tree's height and of what it is wide
    float of_width = 0.0F;
    float flutter = 0.0F; // m

    [[nodiscard]] float of(float height, float width) const {
        return of_height * height + of_width * width + flutter;
    }
};
[[nodiscard]] Sway sway_in(const Wind& wind);

/// Pixels that an object draws while it blends with another: those whose number, 0 to 1, lies in
/// [low, high). pixel_number() in shaders/blend.glsl numbers the pixels.
struct BlendRange {
    float low = 0.0F;
    float high = 1.0F;

    [[nodiscard]] bool is_whole() const { return low <= 0.0F && high >= 1.0F; }
    friend bool operator==(const BlendRange&, const BlendRange&) = default;
};

/// An impostor of a tree, or of a cell.
struct DrawEntry {
    std::uint32_t index = 0;
    BlendRange range;

    friend bool operator==(const DrawEntry&, const DrawEntry&) = default;
};

/// A branch: its slot in the pool and the weight of its blending, packed as
/// shaders/branch.vert.glsl reads them.
class BranchEntry {
public:
    static constexpr std::uint32_t kSlotBits = 24;
    static constexpr std::uint32_t kBlendSteps = 255;

    BranchEntry() = default;
    /// `steps`: weight in 1/kBlendSteps; pixels with numbers below it are drawn.
    explicit BranchEntry(std::uint32_t slot, std::uint32_t steps = kBlendSteps)
        : bits_(steps << kSlotBits | slot) {}
    [[nodiscard]] std::uint32_t slot() const { return bits_ & ((1U << kSlotBits) - 1); }
    [[nodiscard]] std::uint32_t steps() const { return bits_ >> kSlotBits; }

    friend bool operator==(const BranchEntry&, const BranchEntry&) = default;

private:
    std::uint32_t bits_ = 0;
};
static_assert(sizeof(BranchEntry) == 4);
static_assert(BranchPool::kMaxBranches <= 1U << BranchEntry::kSlotBits);

/// Branches of one instance and level.
struct BranchRun {
    std::uint32_t form = 0;
    std::uint32_t level = 0;
    std::uint32_t instance = 0;
    std::uint32_t first = 0; // in DrawLists::branches
    std::uint32_t count = 0;
    bool blends = false; // of trees that are drawn as impostors too
};

struct DrawLists {
    std::vector<BranchEntry> branches; // by run
    std::vector<BranchRun> runs;
    // Whole ones first, of those near ones first.
    std::vector<DrawEntry> trees;                            // far: numbers of ForestLod::trees()
    std::vector<DrawEntry> clusters;                         // horizon: cells
    std::array<std::uint32_t, kTreeLevels> trees_of_level{}; // with branches in view
    std::uint64_t far_trees = 0;       // of `trees`, without those that have branches too
    std::uint64_t clustered_trees = 0; // of `clusters`, without those of `trees`
    std::uint64_t blended = 0;         // trees that are drawn as two things
    std::uint64_t hidden = 0;          // behind the ground
    std::uint64_t triangles = 0;       // of branches
    std::uint32_t expanded = 0;        // trees whose branches were made for this
    std::uint32_t waiting = 0;         // that should have branches but are far for now
    float detail = 1.0F;               // factor of sizes, so that most_triangles is kept
};

/// A square of the ground.
struct ForestCell {
    std::uint32_t first = 0; // in ForestLod::trees()
    std::uint32_t count = 0;
    glm::vec3 low{}; // around its trees, radii included
    glm::vec3 high{};
    glm::vec3 middle{};     // mean of its trees' places
    float scale = 1.0F;     // mean of theirs
    float tallest = 0.0F;   // m
    std::uint16_t form = 0; // that most of its trees are of
    std::uint32_t gone = 0; // trees that were taken away; with any, all are drawn by themselves
};

class ForestLod {
public:
    /// The model outlives the view.
    explicit ForestLod(const ForestModel& model);

    /// A tree comes or goes, in time that does not grow with the forest. `index`: in Forest::trees,
    /// or behind them, of trees that are added one after the other; one that is gone may be
    /// replaced. Returns its number here.
    std::uint32_t change_tree(std::uint32_t index, const Tree& tree, bool alive);

    /// What `ground` hides is left out.
    [[nodiscard]] const DrawLists&
    select(const Frustum& frustum, const LodOptions& options, GroundHorizon* ground = nullptr);

    [[nodiscard]] const ForestModel& model() const { return model_; }
    /// Those of the forest. Numbers of trees go on behind them: of trees that were added.
    [[nodiscard]] std::span<const LodTree> trees() const { return trees_; }
    [[nodiscard]] const LodTree& lod_tree(std::uint32_t number) const {
        return number < trees_.size() ? trees_[number] : added_.at(number - first_added());
    }
    [[nodiscard]] const Tree& tree_of(std::uint32_t number) const {
        return number < trees_.size() ? model_.forest->trees[trees_[number].tree]
                                      : added_.tree(number - first_added());
    }
    /// That are not gone.
    [[nodiscard]] std::uint64_t alive_count() const { return alive_count_; }
    [[nodiscard]] std::span<const ForestCell> cells() const { return cells_; }
    [[nodiscard]] const Bounds& bounds() const { return bounds_; }
    [[nodiscard]] double cell_size() const { return cell_size_; } // m
    [[nodiscard]] BranchPool& pool() { return pool_; }
    /// Trees that stand in cells that meet a box seen from above, by cell.
    void find_within(const Bounds& box, std::vector<std::uint32_t>& trees) const;
    /// Around a tree, whatever branches it has.
    [[nodiscard]] Sphere bounding_sphere(const LodTree& tree, float yaw) const;
    /// Around its impostor.
    [[nodiscard]] Sphere impostor_sphere(const LodTree& tree) const;
    [[nodiscard]] std::uint64_t byte_count() const;

private:
    /// A tree that is large enough for branches.
    struct Candidate {
        std::uint32_t tree = 0;
        float pixels = 0.0F;
    };

    /// A tree with branches in view.
    struct SeenTree {
        std::uint32_t first = 0; // in seen_branches_
        std::uint32_t end = 0;
        std::uint32_t first_mesh = 0; // in mesh_counts_
    };
    /// Levels in mesh_counts_: after the last one, the same once more for trees that blend.
    static constexpr std::uint32_t kBlending = kTreeLevels;

    void sort_into_cells();
    [[nodiscard]] std::uint32_t first_added() const {
        return static_cast<std::uint32_t>(trees_.size());
    }
    [[nodiscard]] std::uint64_t cell_of(const glm::vec3& place) const;
    [[nodiscard]] LodTree make_lod_tree(const Tree& tree, std::uint32_t index);
    /// `weight`: of its impostor, if it is drawn as one.
    void visit_tree(std::uint32_t number,
                    const Frustum& frustum,
                    const LodOptions& options,
                    float weight = 1.0F);
    /// Lists a cell as one, or its trees, or both.
    void visit_cell(std::uint32_t index,
                    float distance,
                    const Frustum& frustum,
                    const LodOptions& options);
    /// A tree's branches in the pool; they are made if need be. Count 0: they have to wait.
    [[nodiscard]] PoolSpan branches_of(std::uint32_t number, const LodOptions& options);
    /// The branches that are seen, sorted into runs.
    void list_runs();
    [[nodiscard]] float sway_of(const LodTree& tree) const; // m
    /// Around its impostor as it is seen from `eye`.
    [[nodiscard]] Bounds impostor_box(const LodTree& tree, const glm::vec3& eye) const;
    [[nodiscard]] bool is_behind_ground(const Bounds& box, float sway) const;
    /// What a sphere around a part of a tree becomes in the wind.
    [[nodiscard]] Sphere swaying(const Sphere& sphere, const LodTree& tree) const;
    /// Lists the branches of a tree that are in view in seen_branches_.
    void see_branches(const PoolSpan& span,
                      const LodTree& tree,
                      float yaw,
                      std::uint32_t blend_steps,
                      const Frustum& frustum);
    /// kTreeLevels: none, an impostor.
    [[nodiscard]] static std::uint32_t level_of(float pixels, const LodOptions& options);
    [[nodiscard]] float fitting_detail(const LodOptions& options) const;
    void list_branches(const Frustum& frustum, const LodOptions& options);

    const ForestModel& model_;
    LargeVector<LodTree> trees_;
    std::vector<ForestCell> cells_;
    Bounds bounds_;
    double cell_size_ = 1.0;
    glm::vec2 cells_low_{}; // the corner of the first cell, and how many there are
    std::uint64_t columns_ = 0;
    std::uint64_t rows_ = 0;
    AddedTrees added_;
    std::uint64_t alive_count_ = 0;
    BranchPool pool_;
    std::vector<TreeExpander> expanders_;   // by form
    std::vector<std::uint32_t> first_mesh_; // of each form: instances times levels and one
    DrawLists lists_;
    std::vector<Candidate> candidates_;
    std::vector<DrawEntry> far_;
    std::vector<BranchEntry> seen_branches_;
    std::vector<PoolBranch> made_branches_;
    std::vector<SeenTree> seen_trees_; // whose branches those are
    Sway sway_;
    GroundHorizon* ground_ = nullptr;                         // of the select() that runs
    std::vector<std::pair<float, std::uint32_t>> seen_cells_; // by distance
    std::vector<std::uint32_t> mesh_counts_;
};

} // namespace lsys::view
