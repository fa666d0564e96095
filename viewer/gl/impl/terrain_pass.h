// SPDX-License-Identifier: MIT
// TerrainPass: draws the ground of a forest with a texture of heights around the camera, and one
// small grid that is drawn once per patch of a TerrainLod.
#pragma once

#include "grammar/base/result.h"
#include "viewer/gl/impl/material_textures.h"
#include "viewer/gl/impl/objects.h"
#include "viewer/gl/renderer.h"
#include "viewer/scene/terrain_lod.h"

#include <array>
#include <cstdint>
#include <memory>

namespace lsys::view {

class TerrainPass {
public:
    explicit TerrainPass(Device& device);

    /// Error: a shader does not compile; the old shader stays in use.
    [[nodiscard]] Result<void> reload(const ShaderSource& shaders);
    /// Replaces the ground. `cover` may be empty. `terrain` must live until the next call or the
    /// end of the pass. Pictures that are already shown are not uploaded again.
    void show(const Terrain& terrain,
              const GroundPictures& pictures,
              float view_distance,
              GroundCover cover,
              const MaterialTextures& textures);
    /// Sets the place in the world to which cameras are relative, as TerrainLod::set_origin() does.
    void set_origin(const glm::dvec3& origin);
    /// Selects patches for a camera and uploads new heights. Ground with cover that is farther away
    /// than `tree_range` (m) gets the colour of the canopy; infinity: no ground does.
    void prepare(const Frustum& frustum, float tree_range);
    /// Sets the colour of the canopy, linear RGB.
    void set_canopy(const glm::vec3& colour) { canopy_ = colour; }
    /// Draws the selected patches, and grass near the eye.
    FrameStats draw();
    /// Draws the selected patches with `program`, whose vertex shader is terrain.vert.glsl.
    FrameStats draw_with(const ProgramObject& program);

    [[nodiscard]] const TerrainLod* lod() const { return lod_.get(); }
    /// Name of the texture of heights; it has a layer for each level of lod().
    [[nodiscard]] GLuint heights() const { return heights_.name(); }
    [[nodiscard]] std::uint64_t texture_bytes() const;
    /// Heights of a level, read back from the device row by row.
    [[nodiscard]] std::vector<float> read_heights(std::uint32_t level) const;

private:
    void set_noise() const; // binds the noise texture and sets its shifts
    void draw_grass(FrameStats& stats) const;

    Device* device_;
    std::unique_ptr<TerrainLod> lod_;
    /// Programs of the ground: those with odd indices use pictures, those from index 2 on draw a
    /// canopy.
    std::array<ProgramObject, 4> programs_;
    ProgramObject grass_program_; // from QUALITY 1 on
    glm::vec3 eye_{0.0F};         // eye for which patches were selected
    GroundPictures pictures_;     // of the ground shown
    TextureObject colour_;
    TextureObject normals_;
    glm::vec3 mean_{0.0F}; // linear RGB, mean of the ground's colour picture
    TextureObject heights_;
    TextureObject covers_; // by level: fraction of the ground below crowns; empty: no GroundCover
    glm::vec3 canopy_{0.0F};
    glm::dvec3 origin_{};
    float tree_range_ = 0.0F; // m
    TextureObject noise_;
    VertexArray array_;
    VertexArray grass_array_; // without attributes
    Buffer corners_;          // of a patch, in cells
    Buffer indices_;
    Buffer patches_; // the selected patches
};

} // namespace lsys::view
