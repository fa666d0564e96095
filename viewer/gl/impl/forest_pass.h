// SPDX-License-Identifier: MIT
// ForestPass: draws a forest: branches of near trees, impostors of far trees, ground and shadows.
// For any number of trees it needs at most 16 draw calls, and two more for each array of pictures
// of mesh files (PictureArrays).
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

/// Number of shadow maps near the eye.
inline constexpr std::size_t kNearMaps = 2;

class ForestPass {
public:
    explicit ForestPass(Device& device);

    /// Error: a shader does not compile; the old shaders stay in use.
    [[nodiscard]] Result<void> reload(const ShaderSource& shaders);
    /// Replaces the forest. Old impostors are drawn until new ones are baked. The forest and the
    /// terrain of `model` must live until the next call or the end of the pass.
    void show(ForestModel model, const MaterialTextures& textures);
    /// Sets whether compute shaders or the CPU choose trees and branches of later forests. Error: a
    /// shader does not compile.
    [[nodiscard]] Result<void> cull_on_device(bool on_device, const ShaderSource& shaders);
    /// Whether compute shaders choose the trees of the forest that is shown. The CPU chooses the
    /// trees of streamed forests and of forests with deeply nested instances.
    [[nodiscard]] bool is_culled_on_device() const { return is_culled_on_device_; }
    /// Updates the trees of the forest after a change. Clusters are drawn again when their new
    /// impostors are baked.
    void update_trees();
    /// Bakes missing impostors for about `seconds`. Returns whether all are done.
    [[nodiscard]] bool bake_impostors(double seconds, MaterialTextures& textures);
    /// Whether trees move in the wind of the prepared frame.
    [[nodiscard]] bool is_windy() const { return is_windy_; }
    /// See Renderer::has_stand_ins().
    [[nodiscard]] bool has_stand_ins() const { return impostors_.is_filled(); }
    /// Colours the branches of this forest and of all later ones.
    void set_colours(BranchColours by);
    /// Adds or removes a tree, as ForestLod::change_tree() does.
    void change_tree(std::uint32_t index, const Tree& tree, bool alive);
    /// Adds and removes squares of a streamed forest. Returns the box of the trees that were added
    /// or removed.
    [[nodiscard]] Bounds change_squares(const SquareChanges& changes);
    /// The frame with its camera relative to the origin of the forest. In a streamed forest, first
    /// moves the origin to nearest_origin() of the eye; sets `moved` to whether the origin has
    /// changed.
    [[nodiscard]] Frame localised(const Frame& frame, bool& moved);
    /// The place of the world, m, to which all places of the forest are relative.
    [[nodiscard]] glm::dvec3 origin() const { return lod_->origin(); }
    [[nodiscard]] const Bounds& bounds() const { return lod_->bounds(); }

    /// Box that the shadow map must show for the camera of a frame; it changes only when the camera
    /// has moved far.
    [[nodiscard]] Bounds shadow_bounds(const Frame& frame);
    /// Selects trees and branches for a frame and uploads them. If compute shaders select, only
    /// sets their parameters.
    void prepare(const Frame& frame);
    /// Draws all casters into the bound shadow map.
    void draw_shadows(const glm::mat4& shadow_from_world, ForestFrameStats& stats);
    /// Draws the crowns around the eye, seen from above, into a texture for shaders/crowns.glsl,
    /// and binds this texture. Call it after prepare(). Returns the value of FrameBlock::crowns.
    [[nodiscard]] glm::vec4 draw_crowns(const glm::vec3& eye);
    /// Factor of the exposure for an eye below crowns, which has adapted to their shade. Call it
    /// after prepare().
    [[nodiscard]] float exposure_below_crowns(const glm::vec3& eye) const;
    /// The value of FrameBlock::hills. Hills stand beyond a forest, none beyond a streamed forest.
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

    /// Compiles the programs of draw_picked() in the first call. Error: a shader does not compile.
    [[nodiscard]] Result<void> compile_pick_programs(const ShaderSource& shaders);
    /// Draws into the bound framebuffer, for each pixel, kind and index of the part that the pixel
    /// shows. Call it after prepare().
    void draw_picked(MaterialTextures& textures);
    /// The part whose kind and index draw_picked() has written.
    [[nodiscard]] Picked picked(PickedKind kind, std::uint32_t index) const;
    /// As Renderer::trees_of().
    [[nodiscard]] std::vector<std::uint32_t> trees_of(std::uint32_t form) const;

    [[nodiscard]] ForestSizes sizes() const;
    /// If compute shaders have selected the trees, sets counts and times of the last picture that
    /// the device has finished.
    void collect_device_stats(ForestFrameStats& stats);

private:
    /// Branches in a shadow map near the eye; they stay valid until map, wind or trees change.
    struct NearCasters {
        glm::mat4 shadow_from_world{0.0F};
        Wind wind;
        std::vector<PoolBranch> branches;
        DrawLists lists;
    };

    /// Sets `casters` to the trees in a shadow map, as branches of a level.
    void
    list_casters(const glm::mat4& shadow_from_world, std::uint32_t level, NearCasters& casters);
    /// Clears near_casters_ and crown_area_. Call it when trees have changed or moved.
    void forget_near_trees();
    /// Lowest and highest altitude in m of ground and trees near the middle of a shadow map.
    [[nodiscard]] std::array<float, 2> altitudes_near(const glm::vec2& middle, float half) const;
    [[nodiscard]] const ForestPrograms& programs() const { return programs_[is_windy_ ? 1 : 0]; }
    /// Program that draws depths of impostors, for the samples per pixel of the prepared frame.
    [[nodiscard]] const ProgramObject& impostor_depth(bool blends) const;
    void draw_branches(const BranchPrograms& programs,
                       MaterialTextures& textures,
                       bool blends,
                       FrameStats& stats);
    /// Draws impostors of trees or, if `trees` are entries of clusters, of clusters.
    void draw_impostors(std::span<const ImpostorEntry> trees, FrameStats& stats);
    /// Draws the quads first ... first + count - 1 of quad_trees_. Returns the number of draw
    /// calls.
    std::uint64_t draw_quads(const ProgramObject& program, std::size_t first, std::size_t count);
    /// Draws impostors that compute shaders have listed: the commands first ... first + count - 1,
    /// where command 0 draws whole impostors and command 1 blended impostors. Returns the number of
    /// draw calls.
    std::uint64_t draw_device_quads(const ProgramObject& program,
                                    bool clusters,
                                    std::uint32_t first,
                                    std::uint32_t count);
    /// Binds the program, textures and buffers for impostors. `entries`: buffer of ImpostorEntry.
    void bind_quads(const ProgramObject& program, GLuint entries);
    void draw_device_impostors(bool clusters, FrameStats& stats); // those listed by compute shaders
    void draw_picked_impostors(const ForestPickPrograms& picks, bool clusters); // for draw_picked()
    /// Makes compute shaders select the trees and branches of the prepared frame.
    void select_on_device();
    /// Decides whether compute shaders choose the trees of the forest shown, and uploads it for
    /// them.
    void show_on_device();
    void set_stats(const DrawLists& lists, ForestFrameStats& stats) const; // counts of `lists`

    Device* device_;
    std::array<ForestPrograms, 2> programs_; // without wind, with wind
    struct PickPrograms {
        std::array<ForestPickPrograms, 2> forest; // without wind, with wind
        ProgramObject ground;
    };
    std::optional<PickPrograms> pick_programs_;
    BranchColours colours_ = BranchColours::Natural;
    bool is_windy_ = false;       // the wind of the prepared frame moves trees
    bool has_one_sample_ = false; // whether the prepared frame has one sample per pixel
    Wind wind_;                   // wind of the prepared frame
    std::array<NearCasters, kNearMaps> near_casters_;
    // The members below belong to the map of crowns, which is made when it is first needed.
    ProgramObject crown_program_;
    TextureObject crowns_;       // the map of crowns
    Framebuffer crown_target_;   // with crowns_
    glm::vec4 crown_area_{0.0F}; // area of the crown map; 0: it must be drawn again
    ForestModel model_;
    std::unique_ptr<ForestLod> lod_;
    ForestBuffers buffers_;
    ImpostorAtlas impostors_;
    TerrainPass terrain_;
    VertexArray quads_;                // attributes of ImpostorEntry
    Buffer quad_trees_;                // entries of impostors that the processor has listed
    Frustum frustum_;                  // of the prepared frame
    GroundHorizon horizon_;            // occluder of the prepared frame
    const DrawLists* lists_ = nullptr; // of the prepared frame; null: none
    bool has_clusters_ = false;        // the atlas has layers of clusters
    // The impostors of clusters show the previous trees until all of them are baked again.
    bool has_old_clusters_ = false;
    GpuTimer branches_timer_;
    GpuTimer impostors_timer_;
    GpuTimer terrain_timer_;
    GpuTimer shadow_timer_;
    std::array<float, 2> caster_altitudes_{}; // m, lowest and highest, in the last shadow_bounds()
    double bake_seconds_ = 0.0;               // time to bake impostors of the forest
    double upload_seconds_ = 0.0;
    double cull_seconds_ = 0.0;              // time to choose trees for the prepared frame
    double cull_cpu_seconds_ = 0.0;          // processor time within cull_seconds_
    std::unique_ptr<ForestCulling> culling_; // null until the first cull_on_device(true)
    bool culls_on_device_ = false;           // compute shaders choose the trees of later forests
    bool is_culled_on_device_ = false;       // for the forest that is shown
    ForestCulling::View view_;               // parameters of the prepared frame
};

} // namespace lsys::view
