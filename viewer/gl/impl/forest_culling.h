// SPDX-License-Identifier: MIT
// ForestCulling: chooses the trees and branches of a picture on the device, as ForestLod::select()
// does on the CPU. Compute shaders (shaders/culling*.comp.glsl) cull cells and trees by frustum and
// horizon, find the LOD band of each tree, expand near trees into branches, and write the commands
// of indirect draws. The CPU time of a picture does not depend on the number of trees.
#pragma once

#include "grammar/base/result.h"
#include "viewer/gl/impl/culling_tables.h"
#include "viewer/gl/impl/forest_buffers.h"
#include "viewer/gl/impl/gpu_timer.h"
#include "viewer/gl/impl/mapped_buffer.h"
#include "viewer/gl/impl/objects.h"
#include "viewer/gl/renderer.h"
#include "viewer/scene/forest_lod.h"
#include "viewer/scene/terrain_lod.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lsys::view {

/// Limits of the OpenGL context on which it depends whether compute shaders can choose trees.
struct CullingLimits {
    std::int32_t storage_bindings = 0; // GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS
    std::int32_t storage_blocks = 0;   // GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS
    std::int32_t invocations = 0;      // GL_MAX_COMPUTE_WORK_GROUP_INVOCATIONS
};
/// A text that names the first limit that is too low for the compute shaders; nullopt: all limits
/// suffice.
[[nodiscard]] std::optional<std::string> lacking_for_culling(const CullingLimits& limits);
/// Limits of the current context.
[[nodiscard]] CullingLimits culling_limits();

/// Counts that the shaders compute, in the layout of State in shaders/culling.glsl, which also
/// describes the members that have no comment here.
struct CullingState {
    std::array<std::uint32_t, 24> dispatches{};
    std::array<std::uint32_t, 16> draws{};
    std::array<std::uint32_t, 4> cell_totals{};
    std::array<std::uint32_t, 4> tree_totals{};
    std::array<std::uint32_t, 4> near_totals{};
    std::uint32_t pool_used = 0;
    std::uint32_t waiting = 0;
    std::uint32_t occluded = 0;
    std::uint32_t clustered = 0;
    std::uint32_t cluster_blended = 0; // trees drawn both alone and in a cluster
    std::uint32_t branch_blended = 0;  // trees drawn both as branches and as an impostor
    std::uint32_t drawn_branches = 0;
    float detail = 1.0F; // DrawLists::detail
    std::array<std::uint32_t, kTreeLevels> level_counts{};
    std::array<std::uint32_t, 2> triangles{};
    std::uint32_t coarser_used = 0;  // branches that are also drawn in a coarser level
    std::uint32_t level_blended = 0; // trees drawn in two levels of branches

    [[nodiscard]] std::uint64_t triangle_count() const {
        return std::uint64_t{triangles[1]} << 32U | triangles[0];
    }
    /// Number of impostors of trees, or with `clusters` of clusters.
    [[nodiscard]] std::uint64_t impostor_count(bool clusters) const {
        const std::size_t at = clusters ? 8 : 0;
        return std::uint64_t{draws[at + 1]} + draws[at + 5];
    }
};

/// Lists of a picture, read back from the device for tests.
struct CulledLists {
    CullingState state;
    std::vector<ImpostorEntry> trees;
    std::vector<ImpostorEntry> clusters;
    std::vector<PoolBranch> pool;
    std::vector<BranchEntry> branches; // in the order of their keys
};

class ForestCulling {
public:
    explicit ForestCulling(Device& device);

    /// Error: a shader does not compile; the old shaders stay in use.
    [[nodiscard]] Result<void> reload(const ShaderSource& shaders);
    [[nodiscard]] bool has_programs() const { return static_cast<bool>(programs_.sum); }
    /// Uploads cells, trees and tables. Returns false if instances are nested deeper than
    /// kMaxWalkDepth. `buffers`: the buffers of the same forest.
    [[nodiscard]] bool show(const ForestLod& lod, ForestBuffers& buffers);
    /// Records a change of a tree, which the next select() uploads.
    void change_tree(std::uint32_t number);

    /// Parameters of a picture. `ground`: the occluder, or null. `heights`: texture with the
    /// heights of the ground.
    struct View {
        Frustum frustum;
        LodOptions options;
        const TerrainLod* ground = nullptr;
        GLuint heights = 0;
    };
    /// Computes the lists of a picture on the device.
    void select(const ForestLod& lod, const ForestBuffers& buffers, const View& view);
    /// Lists the trees of all cells that overlap a box, seen from above. Overwrites the lists of
    /// select().
    void select_casters(const ForestLod& lod, const ForestBuffers& buffers, const Bounds& box);

    /// The draws, for ForestBuffers::use_device_draws().
    [[nodiscard]] const DeviceDraws& draws() const { return draws_; }
    /// Name of the buffer of ImpostorEntry: of clusters, or of trees.
    [[nodiscard]] GLuint entries(bool clusters) const {
        return clusters ? cluster_entries_.name() : tree_entries_.name();
    }
    /// Name of the buffer with draw commands for impostors.
    [[nodiscard]] GLuint impostor_commands() const { return state_.name(); }
    /// Offset in bytes in impostor_commands() of two commands: for whole impostors and for blended
    /// impostors.
    [[nodiscard]] static std::size_t impostor_command(bool clusters);

    /// Counts of the last picture that the device has finished; null: it has finished none. Does
    /// not wait.
    [[nodiscard]] const CullingState* finished_state() const;
    [[nodiscard]] double gpu_milliseconds() { return timer_.milliseconds(); }
    /// Entry `slot` of the branches of the last picture. Waits until the device has made them.
    [[nodiscard]] PoolBranch branch(std::uint32_t slot) const;
    [[nodiscard]] CulledLists read_lists() const;
    [[nodiscard]] std::uint64_t byte_count() const;

private:
    /// The programs of shaders/culling_*.comp.glsl.
    struct Programs {
        ProgramObject horizon;
        ProgramObject mark_cells;
        ProgramObject list_cells;
        ProgramObject sum;
        ProgramObject mark_trees;
        ProgramObject list_trees;
        ProgramObject detail;
        ProgramObject mark_near;
        ProgramObject list_near;
        ProgramObject nodes;
        ProgramObject branches;
        ProgramObject visible;
        ProgramObject count_digits;
        ProgramObject sum_digits;
        ProgramObject sort;
        ProgramObject finish;
        ProgramObject commands;
    };
    struct Block;

    /// Uploads yaw and number of each tree.
    void upload_identities(const ForestLod& lod);
    /// Makes room in the buffers for the lists of a forest with this many trees.
    void grow_lists(std::uint32_t trees);
    void apply_changes(const ForestLod& lod); // uploads the trees of changed_
    /// Uploads the parameters, and binds all buffers.
    void begin(const ForestLod& lod, const ForestBuffers& buffers, Block& block);
    /// Computes horizon_, unless eye and heights are those of the last picture.
    void make_horizon(const View& view);
    void list_trees(std::uint32_t cells); // visible trees: of the first `cells` cells; added ones
    /// Chooses levels for candidates, then lists and sorts their visible branches.
    void list_branches();

    Device* device_;
    Programs programs_;
    MappedBuffer blocks_; // parameters of pictures
    MappedBuffer states_; // CullingState of pictures, read back
    GpuTimer timer_;
    CullingTables table_layout_; // its member `words` is empty: tables_ has these words
    // Buffers of the blocks of the same names in shaders/culling*.glsl, unless a comment says else.
    Buffer rays_;
    Buffer tables_;
    Buffer identities_;
    Buffer cells_;
    Buffer state_;
    Buffer codes_;
    Buffer sums_;
    Buffer visible_cells_;
    Buffer tree_entries_;
    Buffer cluster_entries_;
    Buffer candidates_;
    Buffer near_; // near trees (culling_near.glsl)
    Buffer nodes_;
    Buffer branches_;
    std::array<Buffer, 2> sorted_; // input and output of a pass of the sort, in turn
    Buffer digits_;
    Buffer keys_;
    Buffer command_keys_;
    Buffer commands_;
    Buffer changes_; // records of changed trees, from which apply_changes() copies
    TextureObject horizon_;
    std::vector<std::uint32_t> changed_; // numbers of trees for apply_changes()
    DeviceDraws draws_;
    std::uint32_t command_count_ = 0;  // number of draw commands of branches
    std::uint32_t tree_capacity_ = 0;  // number of trees for which the buffers have room
    std::uint32_t max_candidates_ = 0; // room in candidates_
    std::uint32_t max_branches_ = 0;   // room in branches_
    std::uint32_t sort_passes_ = 1;    // passes of the radix sort
    // Eye for which the slopes in horizon_ were computed.
    std::optional<glm::vec3> horizon_eye_;
    std::vector<glm::ivec2> horizon_origins_;
};

} // namespace lsys::view
