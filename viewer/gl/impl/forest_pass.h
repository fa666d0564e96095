// SPDX-License-Identifier: MIT
// ForestPass: draws a forest: branches of near trees, impostors of far ones, ground and shadows. At
// most 16 draw calls for any number of trees, and two for each picture of a mesh file.
#pragma once

#include "grammar/base/result.h"
#include "viewer/gl/impl/forest_buffers.h"
#include "viewer/gl/impl/forest_programs.h"
#include "viewer/gl/impl/impostor_atlas.h"
#include "viewer/gl/impl/material_textures.h"
#include "viewer/gl/impl/terrain_pass.h"
#include "viewer/gl/renderer.h"
#include "viewer/scene/forest_lod.h"
#include "viewer/scene/forest_square.h"
#include "viewer/scene/ground_horizon.h"

#include <glm/mat4x4.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace lsys::view {

class ForestPass {
public:
    explicit ForestPass(Device& device);

    /// Error: a shader does not compile; the old ones stay in use.
    [[nodiscard]] Result<void> reload(const ShaderSource& shaders);
    /// Replaces the forest. Old impostors stand in until new ones are baked. Forest and terrain
    /// must outlive the pass or the next call.
    void show(ForestModel model, const MaterialTextures& textures);
    /// Updates the trees of the forest after a change. Clusters are drawn once their new impostors
    /// are baked.
    void show_trees();
    /// Bakes missing impostors for about `seconds`. Returns whether all are done.
    [[nodiscard]] bool bake_impostors(double seconds, MaterialTextures& textures);
    /// Colours the branches of this forest and of all later ones.
    void set_colours(BranchColours by);
    /// Adds or removes a tree: ForestLod::change_tree().
    void change_tree(std::uint32_t index, const Tree& tree, bool alive);
    /// Adds and removes squares of a streamed forest. Returns the box of the trees that changed.
    [[nodiscard]] Bounds change_squares(const SquareChanges& changes);
    /// The frame with a camera relative to the origin of the forest. In a streamed forest, moves the
    /// origin to the nearest_origin() of the eye first; returns in `moved` whether it did.
    [[nodiscard]] Frame localised(const Frame& frame, bool& moved);
    /// The place of the world, m, to which all places of the forest are relative.
    [[nodiscard]] glm::dvec3 origin() const { return lod_->origin(); }
    [[nodiscard]] const Bounds& bounds() const { return lod_->bounds(); }

    /// Box of the shadow map for a camera; changes only in large steps of the camera.
    [[nodiscard]] Bounds shadow_bounds(const Frame& frame);
    /// Selects trees and branches for the frame and uploads them.
    void prepare(const Frame& frame);
    /// Draws all casters into the bound shadow map.
    void draw_shadows(const glm::mat4& shadow_from_world, ForestFrameStats& stats);
    /// Draws into the bound framebuffer. Texture unit 0 must hold the shadow map.
    void draw(MaterialTextures& textures, ForestFrameStats& stats);

    /// Compiles the programs of draw_picked() at the first call. Error: a shader does not compile.
    [[nodiscard]] Result<void> compile_pick_programs(const ShaderSource& shaders);
    /// Draws the kind and index of the part that each pixel shows into the bound framebuffer. Call
    /// after prepare().
    void draw_picked(MaterialTextures& textures);
    /// The part for a kind and an index that draw_picked() has written.
    [[nodiscard]] Picked picked(PickedKind kind, std::uint32_t item) const;
    /// Numbers of the living trees of a form.
    [[nodiscard]] std::vector<std::uint32_t> trees_of(std::uint32_t form) const;

    [[nodiscard]] ForestSizes sizes() const;

private:
    /// Lowest and highest place of ground and trees near the middle of a shadow map.
    [[nodiscard]] std::array<float, 2> altitudes_near(const glm::vec2& middle, float half) const;
    [[nodiscard]] const ForestPrograms& programs() const { return programs_[is_windy_ ? 1 : 0]; }
    void draw_branches(const BranchPrograms& programs, bool blends, FrameStats& stats);
    /// Draws impostors of trees or clusters.
    void draw_impostors(std::span<const ImpostorEntry> trees, FrameStats& stats);
    /// Draws quads of quad_trees_; returns the count of draw calls.
    std::uint64_t draw_quads(const ProgramObject& program, std::size_t first, std::size_t count);

    Device* device_;
    std::array<ForestPrograms, 2> programs_; // without wind, with wind
    struct PickPrograms {
        std::array<ForestPickPrograms, 2> forest; // without wind, with wind
        ProgramObject ground;
    };
    std::optional<PickPrograms> pick_programs_;
    BranchColours colours_ = BranchColours::Natural;
    bool is_windy_ = false;
    ForestModel model_;
    std::unique_ptr<ForestLod> lod_;
    ForestBuffers buffers_;
    ImpostorAtlas impostors_;
    TerrainPass terrain_;
    VertexArray quads_;
    Buffer quad_trees_;
    Frustum frustum_;
    GroundHorizon horizon_;
    const DrawLists* lists_ = nullptr;
    bool has_clusters_ = false; // the atlas has cluster impostors
    // The cluster impostors show the previous trees until all are baked again.
    bool has_old_clusters_ = false;
    std::array<float, 2> caster_altitudes_{}; // of the last shadow_bounds() of a streamed forest
    double bake_seconds_ = 0.0;
    double upload_seconds_ = 0.0;
    double cull_seconds_ = 0.0;
};

} // namespace lsys::view
