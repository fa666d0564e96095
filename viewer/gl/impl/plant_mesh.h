// PlantMesh: the triangles of one plant on the device, a draw for each material.
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

    /// Memory that is large enough is used again.
    void upload(const Mesh& mesh, const MaterialTextures& textures);
    /// With the program of shaders/mesh or shaders/shadow bound; returns the number of draws.
    std::uint64_t draw(MaterialTextures& textures, bool shaded) const;

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
    std::vector<TextureObject> pictures_; // of files, by material
    std::uint64_t triangles_ = 0;
    Bounds bounds_;
};

} // namespace lsys::view
