// ForestPass: draws a forest: branches of trees that are near, pictures of those that are far, the
// ground, and the shadows of all of them. At most 16 draws for any number of trees.
#pragma once

#include "grammar/base/result.h"
#include "viewer/gl/impl/forest_buffers.h"
#include "viewer/gl/impl/forest_programs.h"
#include "viewer/gl/impl/material_textures.h"
#include "viewer/gl/impl/portraits.h"
#include "viewer/gl/impl/terrain_pass.h"
#include "viewer/gl/renderer.h"
#include "viewer/scene/forest_view.h"
#include "viewer/scene/ground_horizon.h"

#include <glm/mat4x4.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace lsys::view {

class ForestPass {
public:
    explicit ForestPass(Device& device);

    /// Error: a shader does not compile; those before stay.
    [[nodiscard]] Result<void> reload(const ShaderSource& shaders);
    /// The forest that is drawn from now on, with the portraits that were there until others are
    /// made. Forest and terrain outlive the pass or the next call.
    void show(ForestModel model);
    /// Draws portraits that are missing, for about so long. Whether all are there.
    [[nodiscard]] bool make_portraits(double seconds, MaterialTextures& textures);
    /// A tree comes or goes, as ForestView::change_tree() has it.
    void change_tree(std::uint32_t index, const Tree& tree, bool alive);
    [[nodiscard]] bool shows() const { return view_ != nullptr; }
    [[nodiscard]] const Bounds& bounds() const { return view_->bounds(); }

    /// What the sun is asked for around a camera. The same until the camera has gone some way.
    [[nodiscard]] Bounds lit_bounds(const Frame& frame) const;
    /// Chooses what is drawn for the frame and uploads it.
    void prepare(const Frame& frame);
    /// Into the shadow map that is bound: all that casts shadows there.
    void draw_shadows(const glm::mat4& shadow_from_world, ForestFrameStats& stats);
    /// Into the picture that is bound. Uses the texture unit 0 for the shadow map.
    void draw(MaterialTextures& textures, ForestFrameStats& stats);

    [[nodiscard]] ForestSizes sizes() const;

private:
    [[nodiscard]] const ForestPrograms& programs() const { return programs_[is_windy_ ? 1 : 0]; }
    void draw_branches(const BranchPrograms& programs, bool blends, FrameStats& stats);
    /// The pictures of trees, or of cells.
    void draw_impostors(std::span<const Listed> trees, FrameStats& stats);
    /// Quads of what quad_trees_ holds; returns draws.
    std::uint64_t draw_quads(const ProgramObject& program, std::size_t first, std::size_t count);

    Device* device_;
    std::array<ForestPrograms, 2> programs_; // still, and windy
    bool is_windy_ = false;
    ForestModel model_;
    std::unique_ptr<ForestView> view_;
    ForestBuffers buffers_;
    Portraits portraits_;
    TerrainPass terrain_;
    VertexArray quads_;
    Buffer quad_trees_;
    ViewVolume volume_;
    GroundHorizon horizon_;
    const ForestLists* lists_ = nullptr;
    bool has_cells_ = false; // as pictures of their own, for the horizon
    double bake_seconds_ = 0.0;
    double upload_seconds_ = 0.0;
    double cull_seconds_ = 0.0;
};

} // namespace lsys::view
