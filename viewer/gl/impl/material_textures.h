// MaterialTextures: the pictures of runtime/meshing/texture.h on the device, made when first asked
// for.
#pragma once

#include "runtime/meshing/texture.h"
#include "viewer/gl/impl/objects.h"

#include <array>

namespace lsys::view {

class MaterialTextures {
public:
    explicit MaterialTextures(Device& device) : device_(&device) {}

    /// Of a kind that has_texture().
    [[nodiscard]] GLuint base(MaterialKind kind);
    [[nodiscard]] GLuint bark_normals();
    /// A picture of a file, with coverage kept if it has holes.
    [[nodiscard]] TextureObject make(const Texture& picture) const;

private:
    Device* device_;
    std::array<TextureObject, 4> bases_; // by MaterialKind
    TextureObject normals_;
};

} // namespace lsys::view
