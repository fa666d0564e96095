// Portraits: pictures of trees from many sides, which stand for trees that are far away. A layer
// for each portrait of a form, kYaws by kElevations tiles in it; shaders/impostor.glsl has the same
// numbers.
#pragma once

#include "grammar/base/result.h"
#include "viewer/gl/impl/forest_buffers.h"
#include "viewer/gl/impl/material_textures.h"
#include "viewer/gl/renderer.h"
#include "viewer/scene/forest_model.h"
#include "viewer/scene/portrait_picture.h"
#include "viewer/scene/portrait_plan.h"

#include <glm/vec4.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace lsys::view {

class Portraits {
public:
    static constexpr std::uint32_t kYaws = 8;
    static constexpr std::uint32_t kElevations = 3;
    static constexpr std::uint32_t kTile = 128; // texels

    explicit Portraits(Device& device) : device_(&device), box_buffer_(device) {}

    /// Portraits that are there stay until they are drawn anew.
    [[nodiscard]] Result<void> reload(const ShaderSource& shaders);
    /// From now on the layers are those of a plan. What is in them stays until it is drawn anew;
    /// layers that were not there are empty. Those that are as before are not drawn.
    void begin(const ForestModel& model, PortraitPlan plan, const ForestBuffers& buffers);
    [[nodiscard]] bool is_done() const { return pending_.empty(); }
    /// Draws a part of what is missing: one elevation of a layer. Other shaders, programs and
    /// targets are bound afterwards.
    void step(const ForestModel& model, ForestBuffers& buffers, MaterialTextures& textures);

    [[nodiscard]] GLuint albedos() const { return albedos_.name(); }
    [[nodiscard]] GLuint normals() const { return normals_.name(); }
    /// What is there of each tile: box_of(), by layer, elevation and yaw.
    [[nodiscard]] GLuint boxes() const { return box_buffer_.name(); }
    [[nodiscard]] std::uint64_t texture_bytes() const { return texture_bytes_; }
    [[nodiscard]] std::uint32_t layers() const { return layers_; }

private:
    /// What is needed while layers are missing.
    struct Work {
        Framebuffer target;
        std::array<Renderbuffer, 3> storage; // albedos, normals, depths
        Buffer frame;
        PortraitPicture row; // of an elevation, finer
        PortraitPicture all; // of the layer, as far as it is made
        std::uint32_t elevation = 0;
    };

    using LayerBoxes = std::array<glm::vec4, std::size_t{kYaws} * kElevations>;

    void look_for_missing();
    void make_layers(const std::vector<std::uint64_t>& keys);
    [[nodiscard]] Work make_work() const;
    /// The meshes and commands of a layer.
    void begin_layer(std::uint32_t layer, const ForestModel& model, ForestBuffers& buffers) const;
    /// The tiles of one elevation.
    void draw_row(const Cylinder& form,
                  std::uint32_t elevation,
                  const ForestBuffers& buffers,
                  Buffer& frame) const;
    void upload_layer(std::uint32_t layer, PortraitPicture picture);
    void find_boxes(std::uint32_t layer, std::span<const std::uint8_t> albedos);

    Device* device_;
    ProgramObject solid_;
    ProgramObject cut_out_;
    TextureObject albedos_;
    TextureObject normals_;
    std::vector<LayerBoxes> boxes_; // by layer
    Buffer box_buffer_;
    PortraitPlan plan_;
    std::vector<std::uint64_t> keys_;    // of what is in each layer; 0: nothing
    std::vector<std::uint64_t> wanted_;  // of what is to be in it
    std::vector<std::uint32_t> pending_; // layers, the next one last
    std::optional<Work> work_;
    std::uint32_t layers_ = 0;
    std::uint64_t texture_bytes_ = 0;
};

} // namespace lsys::view
