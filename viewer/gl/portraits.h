// Portraits: pictures of trees from many sides, which stand for trees that are far away. A layer
// for each portrait of a form, kYaws by kElevations tiles in it; shaders/impostor.glsl has the same
// numbers.
#pragma once

#include "grammar/result.h"
#include "viewer/forest_model.h"
#include "viewer/gl/forest_buffers.h"
#include "viewer/gl/material_textures.h"
#include "viewer/portrait_plan.h"
#include "viewer/renderer.h"

#include <cstdint>
#include <vector>

namespace lsys::view {

/// Texels of tiles side by side, RGBA.
struct PortraitPicture {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::uint8_t> albedos; // square roots of linear RGB; opacity
    std::vector<std::uint8_t> normals; // octahedral, depth, of light through it
};

class Portraits {
public:
    static constexpr std::uint32_t kYaws = 8;
    static constexpr std::uint32_t kElevations = 3;
    static constexpr std::uint32_t kTile = 128; // texels

    explicit Portraits(Device& device) : device_(&device) {}

    [[nodiscard]] Result<Done> reload(const ShaderSource& shaders);
    /// Draws the layers of a plan, with the meshes in `buffers`.
    void make(const ForestModel& model,
              const PortraitPlan& plan,
              ForestBuffers& buffers,
              MaterialTextures& textures);

    [[nodiscard]] GLuint albedos() const { return albedos_.name(); }
    [[nodiscard]] GLuint normals() const { return normals_.name(); }
    [[nodiscard]] std::uint64_t texture_bytes() const { return texture_bytes_; }
    [[nodiscard]] std::uint32_t layers() const { return layers_; }

private:
    /// The tiles of one elevation.
    void draw_row(const Cylinder& form,
                  std::uint32_t elevation,
                  const ForestBuffers& buffers,
                  Buffer& frame) const;
    void upload_layer(std::uint32_t layer, PortraitPicture picture);

    Device* device_;
    ProgramObject solid_;
    ProgramObject cut_out_;
    TextureObject albedos_;
    TextureObject normals_;
    std::uint32_t layers_ = 0;
    std::uint64_t texture_bytes_ = 0;
};

} // namespace lsys::view
