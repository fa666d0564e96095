// SPDX-License-Identifier: MIT
// ForestBuffers: meshes, trees and forms of a forest on the device, in the layout of
// shaders/forest.glsl. All forms, levels and instances share one vertex buffer and one index
// buffer.
#pragma once

#include "viewer/gl/impl/material_textures.h"
#include "viewer/gl/impl/objects.h"
#include "viewer/gl/impl/picture_arrays.h"
#include "viewer/scene/branch_colours.h"
#include "viewer/scene/forest_lod.h"
#include "viewer/scene/impostor_plan.h"

#include <glm/vec4.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace lsys::view {

/// Class of branch triangles that are drawn by one program.
enum class BranchClass : std::uint8_t {
    OneSided,
    TwoSided,
    Plain,  // two-sided leaves of one colour
    CutOut, // two-sided leaves with an alpha mask
};
/// Number of these classes; each array of pictures is a further class.
inline constexpr std::size_t kBranchClasses = 4;

/// Set of buffers that uploads and draws use. Impostor: for baking, which happens between pictures
/// of the forest. Shadow: for branches that cast shadows near the eye; its trees are those of
/// the set Forest.
enum class BufferSet : std::uint8_t { Forest, Impostor, Shadow };

struct DrawCommand {         // layout of glMultiDrawElementsIndirect
    std::uint32_t count = 0; // number of indices
    std::uint32_t instance_count = 0;
    std::uint32_t first_index = 0;
    std::int32_t base_vertex = 0;
    std::uint32_t base_instance = 0;
};
static_assert(sizeof(DrawCommand) == 20);

/// Range of the commands of a draw class in a common buffer.
struct CommandRange {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

/// Commands of all branches that a picture may draw, with instance counts of 0.
struct CommandTemplates {
    std::vector<DrawCommand> commands;
    std::vector<std::uint32_t> keys;  // by command: key as in CullingTables
    std::vector<CommandRange> ranges; // by ForestBuffers::command_index()
};

/// Buffers that compute shaders have written and draws of a forest read.
struct DeviceDraws {
    GLuint branches = 0;              // buffer of PoolBranch
    GLuint entries = 0;               // buffer of pairs of a key and a BranchEntry
    GLuint commands = 0;              // buffer of DrawCommand
    std::vector<CommandRange> ranges; // as CommandTemplates::ranges
};

class ForestBuffers {
public:
    explicit ForestBuffers(Device& device);
    ForestBuffers(const ForestBuffers&) = delete;
    ForestBuffers& operator=(const ForestBuffers&) = delete;

    /// Selects the set of buffers that all further calls use.
    void use(BufferSet set);

    /// Uploads meshes, forms, materials and pictures; frees the meshes of the model.
    void upload(ForestModel& model, const ImpostorPlan& plan, const MaterialTextures& textures);
    /// Uploads forms again if only trees have changed. Precondition: upload() was called.
    void upload_forms(const ForestModel& model, const ImpostorPlan& plan);
    /// Sets the colours of the branches. Precondition: upload() was called.
    void set_colours(const ForestModel& model, BranchColours by);
    /// Uploads all trees; clusters are uploaded as trees of their cluster forms.
    void upload_trees(const ForestLod& lod);
    /// Uploads the changed trees and all clusters of a streamed forest.
    void upload_changed_trees(const ForestLod& lod, std::span<const TreeSpan> changed);
    /// Uploads the branches that the pool has written since the last call.
    void upload_branches(BranchPool& pool);
    /// Uploads one tree, which may be an added tree.
    void upload_tree(const ForestLod& lod, std::uint32_t number);
    /// Replaces the trees, for baking of impostors.
    void set_trees(std::span<const Tree> trees, std::uint32_t form);
    /// Replaces the branches, for baking of impostors.
    void set_branches(std::span<const PoolBranch> branches);
    /// Uploads the lists of branches, and the draw commands of each class.
    void upload_commands(const DrawLists& lists);
    /// Makes the commands. `first_keys`: CullingTables::first_keys.
    [[nodiscard]] CommandTemplates
    command_templates(const std::vector<std::uint32_t>& first_keys) const;
    /// Draws forests with these commands instead of the uploaded commands, until it is called with
    /// null.
    void use_device_draws(const DeviceDraws* draws) { device_draws_ = draws; }
    /// Name of the buffer with the records of trees.
    [[nodiscard]] GLuint trees() const { return forest_.trees.name(); }

    /// Draws a class with the bound program of branch.*.glsl; returns the number of draw calls.
    /// `blends`: draws runs of blended trees; the program must be compiled with BLENDS.
    std::uint64_t draw(BranchClass kind, bool blends = false) const;
    /// Draws the branches whose material has a picture file, with one call per array of pictures.
    /// Uses the program `cut_out` if the pictures have transparent texels, `bumpy_cut_out` if they
    /// also have normal maps, else `solid`. Binds these programs, and the textures of bark, leaves
    /// and normal maps. Returns the number of draw calls.
    std::uint64_t draw_pictures(GLuint solid,
                                GLuint cut_out,
                                GLuint bumpy_cut_out,
                                MaterialTextures& textures,
                                bool blends) const;
    /// Binds the buffers that the shaders of branches and impostors read.
    void bind_storage() const;
    /// Rebinds storage so that in later draws the index of a tree means a cluster. Call it after
    /// bind_storage().
    void bind_clusters() const;

    [[nodiscard]] std::uint64_t mesh_bytes() const { return mesh_bytes_; }
    /// Bytes of memory of the textures of picture files.
    [[nodiscard]] std::uint64_t texture_bytes() const { return pictures_.texture_bytes(); }
    [[nodiscard]] std::uint64_t tree_bytes() const {
        return forest_.trees.capacity() + clusters_.capacity();
    }
    [[nodiscard]] std::uint64_t branch_bytes() const { return forest_.branches.capacity(); }
    /// Hash of all meshes of a form and of the colours of its branches.
    [[nodiscard]] std::uint64_t mesh_digest(std::uint32_t form) const {
        return mesh_digests_[form] ^ colour_digests_[form];
    }

private:
    /// The indices of the triangles of an instance in a class.
    struct IndexRange {
        std::uint32_t first = 0;
        std::uint32_t count = 0;
    };
    struct FormLevel {
        std::int32_t base_vertex = 0;
        std::vector<IndexRange> ranges; // by instance, then by class
    };
    struct Commands {
        Buffer buffer;           // of DrawCommand
        std::uint32_t count = 0; // number of commands
    };
    /// The buffers of a BufferSet.
    struct DrawBuffers {
        Buffer trees;
        Buffer branches;
        Buffer lists;                   // entries of branches
        std::vector<Commands> commands; // by command_index()
    };
    [[nodiscard]] static DrawBuffers make_draw_buffers(Device& device);
    /// Class of the branches with this material.
    [[nodiscard]] std::size_t class_of(const Material& material) const;
    [[nodiscard]] static std::size_t command_index(std::size_t kind, bool blends) {
        return 2 * kind + (blends ? 1 : 0);
    }
    [[nodiscard]] std::size_t class_count() const {
        return kBranchClasses + pictures_.arrays().size();
    }
    [[nodiscard]] const Commands& commands_of(std::size_t kind, bool blends) const {
        return current_->commands[command_index(kind, blends)];
    }
    std::uint64_t draw(std::size_t kind, bool blends) const; // `kind`: index of a class
    [[nodiscard]] bool uses_device_draws() const {
        return device_draws_ != nullptr && current_ == &forest_;
    }
    void upload_clusters(const ForestLod& lod);

    VertexArray array_;
    Buffer vertices_;
    Buffer indices_;
    Buffer materials_;
    Buffer forms_;
    Buffer branch_colours_;
    Buffer clusters_;
    DrawBuffers forest_;
    DrawBuffers impostor_;
    DrawBuffers shadow_;                        // for shadow maps near the eye
    DrawBuffers* current_ = &forest_;           // the set chosen by use()
    std::vector<float> boxes_;                  // m, by form: half side of its vertices' box
    std::vector<std::uint64_t> mesh_digests_;   // by form
    std::vector<std::uint64_t> colour_digests_; // by form; 0: natural
    std::vector<std::array<FormLevel, kTreeLevels>> form_levels_; // by form
    PictureArrays pictures_;
    Device* device_;
    const DeviceDraws* device_draws_ = nullptr;
    std::uint64_t mesh_bytes_ = 0;
};

} // namespace lsys::view
