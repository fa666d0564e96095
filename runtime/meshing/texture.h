// Textures: small pictures that are computed, the same on every machine, and those of files. The
// former are made to be multiplied by the colour of a material, so they are near white where the
// surface is plain. Read by exporters and viewers.
#pragma once

#include "grammar/base/result.h"
#include "runtime/meshing/mesh.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

/// Rows from v = 0 on, four bytes a texel: sRGB and opacity. For normals: x, y, z and 255, where
/// -1 ... 1 is 0 ... 255, x points along u and y against v, as in glTF.
struct Texture {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::uint8_t> texels;
};

/// Bark and Leaf.
[[nodiscard]] bool has_texture(MaterialKind kind);
/// Bark: fissures along v; repeats in both directions. Leaf: opaque within the rounded outline of
/// LEAF, whose base is at v = 1 and tip at v = 0, as wide as the picture; a midrib and side veins.
/// Empty for other kinds.
[[nodiscard]] Texture material_texture(MaterialKind kind);
/// The relief of the bark as normals.
[[nodiscard]] Texture bark_normals();

/// Most texels of a picture that is read, and along a side.
inline constexpr std::uint64_t kMaxTexels = std::uint64_t{1} << 26;
inline constexpr std::uint32_t kMaxTextureSide = 16384;
/// Reads a PNG file whose texels take at most `max_bytes`. Other formats are refused by name.
[[nodiscard]] Result<Texture> read_picture(std::string_view bytes, std::uint64_t max_bytes);
/// Whether any texel is less than half opaque.
[[nodiscard]] bool has_holes(const Texture& texture);
/// Of what is at least half opaque, linear; white if nothing is.
[[nodiscard]] glm::vec3 mean_colour(const Texture& texture);

/// The bytes of a PNG file; without opacity where all is opaque. Empty if there is no memory.
[[nodiscard]] std::string encode_png(const Texture& texture);

} // namespace lsys
