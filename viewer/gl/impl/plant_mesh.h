// SPDX-License-Identifier: MIT
// PlantMesh: triangles of one plant on the device; one draw call per material.
#pragma once

#include "runtime/meshing/mesh.h"
#include "viewer/gl/impl/material_textures.h"
#include "viewer/gl/impl/objects.h"

#include <cstdint>
#include <vector>

namespace lsys::view {

class PlantMesh {
public:
    explicit PlantMesh(Device& device);

    /// Uploads a mesh; reuses buffers that are large enough.
    void upload(const Mesh& mesh, const MaterialTextures& textures);
    enum class Pass : std::uint8_t { Colour, Shadow, Pick };
    /// Draws with the bound program of shaders/mesh, shadow or pick. Returns the number of draw
    /// calls.
    std::uint64_t draw(MaterialTextures& textures, Pass pass) const;

    [[nodiscard]] std::uint64_t triangles() const { return triangles_; }
    [[nodiscard]] const Bounds& bounds() const { return bounds_; }

private:
    VertexArray array_;
    Buffer positions_;
    Buffer normals_;
    Buffer texture_coordinates_;
    Buffer tangents_;
    Buffer indices_;
    std::vector<MeshPart> parts_;
    std::vector<Material> materials_;
    std::vector<TextureObject> pictures_;    // pictures of files, by material
    std::vector<TextureObject> normal_maps_; // normal maps of files, by material
    std::uint64_t triangles_ = 0;            // number of triangles
    Bounds bounds_;
};

} // namespace lsys::view
