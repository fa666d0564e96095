// SPDX-License-Identifier: MIT
// LinearTextures: textures of materials with linear colours, for rasterisers. Equal on every
// machine.
#pragma once

#include "runtime/meshing/mesh.h"

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

namespace lsys {

struct LinearTexture {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::array<std::uint8_t, 4>> texels; // sRGB, opacity 0 or 255; empty: white
    std::vector<std::uint8_t> opaque;                // opacities alone: fewer bytes than `texels`

    /// Linear colour and opacity (0 or 1) at texture coordinates.
    [[nodiscard]] glm::vec4 at(const glm::vec2& place) const;
    [[nodiscard]] bool is_opaque(const glm::vec2& place) const;
};

class LinearTextures {
public:
    /// The texture of a material; valid as long as this object, which stores the picture.
    [[nodiscard]] const LinearTexture& texture_of(const Material& material);

private:
    std::map<std::shared_ptr<const Texture>, LinearTexture> files_; // by Material::picture
};

} // namespace lsys
