// ForestBuffers: a forest's meshes, trees and forms on the device, as shaders/forest.glsl reads
// them. One buffer of vertices and one of indices for all forms, levels and instances.
#pragma once

#include "viewer/gl/impl/objects.h"
#include "viewer/scene/forest_lod.h"
#include "viewer/scene/impostor_plan.h"

#include <glm/vec4.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace lsys::view {

/// What is drawn in one go.
enum class BranchClass : std::uint8_t {
    OneSided,
    TwoSided,
    Plain,  // two-sided leaves of one colour
    CutOut, // two-sided leaves, cut out of a picture
};
inline constexpr std::size_t kBranchClasses = 4;

/// What trees, branches and commands are of: impostors are drawn between pictures of the forest.
enum class BufferSet : std::uint8_t { Forest, Impostor };

struct DrawCommand { // as OpenGL has it
    std::uint32_t count = 0;
    std::uint32_t instance_count = 0;
    std::uint32_t first_index = 0;
    std::int32_t base_vertex = 0;
    std::uint32_t base_instance = 0;
};
static_assert(sizeof(DrawCommand) == 20);

class ForestBuffers {
public:
    explicit ForestBuffers(Device& device);
    ForestBuffers(const ForestBuffers&) = delete;
    ForestBuffers& operator=(const ForestBuffers&) = delete;

    /// What the calls that follow are about.
    void use(BufferSet set);

    /// Gives the meshes of the model back.
    void upload(ForestModel& model, const ImpostorPlan& plan);
    /// With the cells as trees of the forms that stand for them.
    void upload_trees(const ForestLod& lod);
    /// Puts branches that the pool has written where shaders find them.
    void upload_branches(BranchPool& pool);
    /// One tree, of those that were added too.
    void upload_tree(const ForestLod& lod, std::uint32_t number);
    /// Trees from elsewhere than a forest, for impostors.
    void set_trees(std::span<const Tree> trees, std::uint32_t form);
    /// Branches from elsewhere than a pool, for impostors.
    void set_branches(std::span<const PoolBranch> branches);
    /// The commands of each class for lists of branches; uploads both.
    void upload_commands(const DrawLists& lists);

    /// With a program of branch.*.glsl bound; returns draws. `blends`: those of trees that are
    /// drawn as impostors too, whose program has BLENDS.
    std::uint64_t draw(BranchClass kind, bool blends = false) const;
    void bind_storage() const;
    /// After bind_storage(): numbers of trees are those of cells from now on.
    void bind_clusters() const;

    [[nodiscard]] std::uint64_t mesh_bytes() const { return mesh_bytes_; }
    [[nodiscard]] std::uint64_t tree_bytes() const {
        return forest_.trees.capacity() + clusters_.capacity();
    }
    [[nodiscard]] std::uint64_t branch_bytes() const { return forest_.branches.capacity(); }
    /// Changes with any mesh of a form.
    [[nodiscard]] std::uint64_t mesh_digest(std::uint32_t form) const {
        return mesh_digests_[form];
    }

private:
    /// Triangles of an instance at a level.
    struct IndexRanges {
        std::array<std::uint32_t, kBranchClasses> first{};
        std::array<std::uint32_t, kBranchClasses> count{};
    };
    struct FormLevel {
        std::int32_t base_vertex = 0;
        std::vector<IndexRanges> ranges; // by instance
    };

    struct Commands {
        Buffer buffer;
        std::uint32_t count = 0;
    };
    /// What is drawn of a set.
    struct DrawBuffers {
        Buffer trees;
        Buffer branches;
        Buffer lists;
        std::array<Commands, 2 * kBranchClasses> commands; // by class, then of what blends
    };
    [[nodiscard]] static DrawBuffers make_draw_buffers(Device& device);

    VertexArray array_;
    Buffer vertices_;
    Buffer indices_;
    Buffer materials_;
    Buffer forms_;
    Buffer clusters_;
    DrawBuffers forest_;
    DrawBuffers impostor_;
    DrawBuffers* current_ = &forest_;
    std::vector<std::uint64_t> mesh_digests_; // by form
    std::vector<std::array<FormLevel, kTreeLevels>> form_levels_;
    std::uint64_t mesh_bytes_ = 0;
};

} // namespace lsys::view
