// SPDX-License-Identifier: MIT
// ForestPass: draws a forest: branches of near trees, impostors of far ones, ground and shadows. At
// most 16 draw calls for any number of trees, and two for each picture of a mesh file.
#pragma once

#include "grammar/base/result.h"
#include "viewer/gl/impl/forest_buffers.h"
#include "viewer/gl/impl/forest_culling.h"
#include "viewer/gl/impl/forest_programs.h"
#include "viewer/gl/impl/gpu_timer.h"
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

/// Count of the shadow maps near the eye.
inline constexpr std::size_t kNearMaps = 2;

class ForestPass {
public:
    explicit ForestPass(Device& device);

    /// Error: a shader does not compile; the old ones stay in use.
    [[nodiscard]] Result<void> reload(const ShaderSource& shaders);
    /// Replaces the forest. Old impostors stand in until new ones are baked. Forest and terrain
    /// must live until the next call or the end of the pass.
    void show(ForestModel model, const MaterialTextures& textures);
    /// Chooses trees and branches of later forests by compute shaders, or on the CPU. Error: a
    /// shader does not compile.
    [[nodiscard]] Result<void> cull_on_device(bool on_device, const ShaderSource& shaders);
    /// Whether compute shaders choose the trees of the forest shown. Streamed forests and forests
    /// with deeply nested instances are left to the CPU.
    [[nodiscard]] bool is_culled_on_device() const { return is_culled_on_device_; }
    /// Updates the trees of the forest after a change. Clusters are drawn once their new impostors
    /// are baked.
    void update_trees();
    /// Bakes missing impostors for about `seconds`. Returns whether all are done.
    [[nodiscard]] bool bake_impostors(double seconds, MaterialTextures& textures);
    [[nodiscard]] bool has_stand_ins() const { return impostors_.is_filled(); }
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
    /// Selects trees and branches for the frame and uploads them, unless compute shaders select
    /// them later.
    void prepare(const Frame& frame);
    /// Draws all casters into the bound shadow map.
    void draw_shadows(const glm::mat4& shadow_from_world, ForestFrameStats& stats);
    /// Draws the crowns around the eye, seen from above, into a texture for shaders/crowns.glsl, and
    /// binds it. Call after prepare(). Returns FrameBlock::crowns.
    [[nodiscard]] glm::vec4 draw_crowns(const glm::vec3& eye);
    /// Factor of the exposure for an eye below crowns, which adapts to their shade. Call after
    /// prepare().
    [[nodiscard]] float exposure_below_crowns(const glm::vec3& eye) const;
    /// FrameBlock::hills: hills stand beyond the forest, none beyond a streamed one.
    [[nodiscard]] glm::vec4 hills() const;
    /// Draws the trees in shadow map number `map` (below kNearMaps) as branches of a level into the
    /// bound framebuffer, moved by the wind of the prepared frame. The bound FrameBlock must have
    /// `shadow_from_world` as its view_projection.
    void draw_near_shadows(std::size_t map,
                           const glm::mat4& shadow_from_world,
                           std::uint32_t level,
                           MaterialTextures& textures);
    /// Draws into the bound framebuffer. Texture unit 0 must hold the shadow map.
    void draw(MaterialTextures& textures, ForestFrameStats& stats);

    /// Compiles the programs of draw_picked() at the first call. Error: a shader does not compile.
    [[nodiscard]] Result<void> compile_pick_programs(const ShaderSource& shaders);
    /// Draws the kind and index of the part that each pixel shows into the bound framebuffer. Call
    /// after prepare().
    void draw_picked(MaterialTextures& textures);
    /// The part for a kind and an index that draw_picked() has written.
    [[nodiscard]] Picked picked(PickedKind kind, std::uint32_t index) const;
    /// Numbers of the living trees of a form.
    [[nodiscard]] std::vector<std::uint32_t> trees_of(std::uint32_t form) const;

    [[nodiscard]] ForestSizes sizes() const;
    /// Sets counts and times of the last picture that the device has finished, if compute shaders
    /// have selected its trees.
    void collect_device_stats(ForestFrameStats& stats);

private:
    /// Branches of a shadow map near the eye, kept until map, wind or trees change.
    struct NearCasters {
        glm::mat4 shadow_from_world{0.0F};
        Wind wind;
        std::vector<PoolBranch> branches;
        DrawLists lists;
    };

    void
    list_casters(const glm::mat4& shadow_from_world, std::uint32_t level, NearCasters& casters);
    /// Forgets near_casters_ and crown_area_. Call when trees have changed or moved.
    void forget_near_trees();
    /// Lowest and highest place of ground and trees near the middle of a shadow map.
    [[nodiscard]] std::array<float, 2> altitudes_near(const glm::vec2& middle, float half) const;
    [[nodiscard]] const ForestPrograms& programs() const { return programs_[is_windy_ ? 1 : 0]; }
    /// Program of the depth pass of impostors, for the samples of the prepared frame.
    [[nodiscard]] const ProgramObject& impostor_depth(bool blends) const;
    void draw_branches(const BranchPrograms& programs, bool blends, FrameStats& stats);
    /// Draws impostors of trees or clusters.
    void draw_impostors(std::span<const ImpostorEntry> trees, FrameStats& stats);
    /// Draws quads of quad_trees_; returns the count of draw calls.
    std::uint64_t draw_quads(const ProgramObject& program, std::size_t first, std::size_t count);
    /// Draws impostors that compute shaders have listed: `count` commands from `first` on, 0: whole
    /// ones, 1: blended ones. Returns the count of draw calls.
    std::uint64_t draw_device_quads(const ProgramObject& program,
                                    bool clusters,
                                    std::uint32_t first,
                                    std::uint32_t count);
    void bind_quads(const ProgramObject& program, GLuint entries);
    void draw_device_impostors(bool clusters, FrameStats& stats);
    void draw_picked_impostors(const ForestPickPrograms& picks, bool clusters);
    /// Lets compute shaders select the trees and branches of the prepared frame.
    void select_on_device();
    void show_on_device();
    void set_stats(const DrawLists& lists, ForestFrameStats& stats) const;

    Device* device_;
    std::array<ForestPrograms, 2> programs_; // without wind, with wind
    struct PickPrograms {
        std::array<ForestPickPrograms, 2> forest; // without wind, with wind
        ProgramObject ground;
    };
    std::optional<PickPrograms> pick_programs_;
    BranchColours colours_ = BranchColours::Natural;
    bool is_windy_ = false;
    bool has_one_sample_ = false; // whether the prepared frame has one sample per pixel
    Wind wind_;                   // wind of the prepared frame
    std::array<NearCasters, kNearMaps> near_casters_;
    // Map of crowns: made when first needed.
    ProgramObject crown_program_;
    TextureObject crowns_;
    Framebuffer crown_target_;
    glm::vec4 crown_area_{0.0F}; // area that the map shows; 0: out of date
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
    bool has_clusters_ = false; // the atlas has layers of clusters
    // The cluster impostors show the previous trees until all are baked again.
    bool has_old_clusters_ = false;
    GpuTimer branches_timer_;
    GpuTimer impostors_timer_;
    GpuTimer terrain_timer_;
    GpuTimer shadow_timer_;
    std::array<float, 2> caster_altitudes_{}; // lowest, highest, for the last shadow_bounds()
    double bake_seconds_ = 0.0;
    double upload_seconds_ = 0.0;
    double cull_seconds_ = 0.0;
    double cull_cpu_seconds_ = 0.0;
    std::unique_ptr<ForestCulling> culling_; // null until the first cull_on_device(true)
    bool culls_on_device_ = false;           // compute shaders choose the trees of later forests
    bool is_culled_on_device_ = false;       // they choose the trees of the forest shown
    ForestCulling::View view_;               // parameters of the prepared frame
};

} // namespace lsys::view
