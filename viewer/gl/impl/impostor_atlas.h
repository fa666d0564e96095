// SPDX-License-Identifier: MIT
// ImpostorAtlas: the texture array of impostors. Each impostor of a form has a layer, with tiles
// for kYaws directions at kElevations elevations; shaders/impostor.glsl has the same numbers.
#pragma once

#include "grammar/base/result.h"
#include "viewer/gl/impl/forest_buffers.h"
#include "viewer/gl/impl/material_textures.h"
#include "viewer/gl/renderer.h"
#include "viewer/scene/forest_model.h"
#include "viewer/scene/impostor_plan.h"
#include "viewer/scene/impostor_texels.h"

#include <glm/vec4.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace lsys::view {

class ImpostorAtlas {
public:
    static constexpr std::uint32_t kYaws = 8;       // directions around the tree
    static constexpr std::uint32_t kElevations = 3; // of the camera, for each yaw
    static constexpr std::uint32_t kTile = 128;     // texels

    explicit ImpostorAtlas(Device& device) : device_(&device), box_buffer_(device) {}

    /// Recompiles the shaders; impostors stay until they are baked again.
    [[nodiscard]] Result<void> reload(const ShaderSource& shaders);
    /// Starts a new plan. Unchanged layers stay and are not baked again; new layers are empty until
    /// they or other layers of their form are baked. The first missing layer of each form is baked
    /// first.
    void begin(const ForestModel& model, ImpostorPlan plan, const ForestBuffers& buffers);
    /// All layers are baked.
    [[nodiscard]] bool is_done() const { return pending_.empty(); }
    /// Whether each layer has a picture: its own or, until this is baked, that of another layer of
    /// its form.
    [[nodiscard]] bool is_filled() const;
    /// Bakes one elevation of one missing layer. Changes the bound programs, textures and
    /// framebuffer.
    void step(const ForestModel& model, ForestBuffers& buffers, MaterialTextures& textures);

    [[nodiscard]] GLuint albedos() const { return albedos_.name(); }
    [[nodiscard]] GLuint normals() const { return normals_.name(); }
    /// Name of the buffer that has opaque_box() of each tile, by layer, elevation and yaw.
    [[nodiscard]] GLuint boxes() const { return box_buffer_.name(); }
    /// Mean colour (linear RGB) of trees seen from above. `parts`: weight of each form.
    /// Precondition: is_done().
    [[nodiscard]] glm::vec3 mean_colour_from_above(std::span<const float> parts) const;
    [[nodiscard]] std::uint64_t texture_bytes() const { return texture_bytes_; }
    /// Number of layers.
    [[nodiscard]] std::uint32_t layers() const { return layers_; }

private:
    /// Textures and framebuffers for baking; they exist while layers are missing.
    struct BakeState {
        Framebuffer target;
        std::array<Renderbuffer, 3> storage; // albedos, normals, depths
        Buffer frame;
        ImpostorTexels row;          // one elevation, supersampled
        ImpostorTexels finished;     // the baked elevations of the layer
        std::uint32_t elevation = 0; // the next to bake
    };

    using LayerBoxes = std::array<glm::vec4, std::size_t{kYaws} * kElevations>;

    void list_missing(); // sets pending_
    /// Resizes the atlas; layers whose key is in `keys` keep their pictures.
    void make_layers(const std::vector<std::uint64_t>& keys);
    [[nodiscard]] BakeState make_bake_state() const;
    /// Sets up meshes and draw commands for a layer.
    void begin_layer(std::uint32_t layer, const ForestModel& model, ForestBuffers& buffers) const;
    /// Draws the tiles of one elevation.
    void draw_elevation(const Cylinder& form,
                        std::uint32_t elevation,
                        const ForestBuffers& buffers,
                        MaterialTextures& textures,
                        Buffer& frame) const;
    /// Uploads all mip levels of a layer, and sets its boxes.
    void upload_layer(std::uint32_t layer, ImpostorTexels picture);
    /// Sets boxes_ of the layer.
    void set_boxes(std::uint32_t layer, std::span<const std::uint8_t> albedos);
    /// Copies a baked layer to the layers of its form that are empty.
    void stand_in(std::uint32_t layer);
    /// Whether two layers show trees of the same form, or clusters of the same form.
    [[nodiscard]] bool are_alike(std::uint32_t a, std::uint32_t b) const;

    Device* device_;
    ProgramObject solid_;
    ProgramObject cut_out_;
    TextureObject albedos_;
    TextureObject normals_;
    std::vector<LayerBoxes> boxes_; // by layer
    Buffer box_buffer_;
    ImpostorPlan plan_;
    std::vector<std::uint64_t> keys_;        // by layer: hash of what it shows; 0: empty
    std::vector<std::uint64_t> target_keys_; // by layer: hash of what it shall show
    std::vector<std::uint8_t> filled_;       // by layer: whether it has a picture
    std::vector<std::uint32_t> pending_;     // layers to bake; the next is last
    std::optional<BakeState> bake_;
    std::uint32_t layers_ = 0; // layers()
    std::uint64_t texture_bytes_ = 0;
};

} // namespace lsys::view
