// SPDX-License-Identifier: MIT
// Textures: pictures of materials, computed or read from files. Computed ones are equal on every
// machine and near white, to be multiplied by the colour of a material. Used by exporters and
// viewers.
#pragma once

#include "grammar/base/result.h"
#include "runtime/meshing/mesh.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

/// Rows from v = 0 on, four bytes per texel: sRGB and opacity. Normal maps: x, y, z (-1 to 1 as 0
/// to 255) and 255; x points along u and y against v, as in glTF.
struct Texture {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::uint8_t> texels;
};

/// True for Bark and Leaf.
[[nodiscard]] bool has_texture(MaterialKind kind);
/// Bark: fissures along v; repeats in both directions. Leaf: opaque within the rounded outline of
/// LEAF, whose base is at v = 1 and tip at v = 0, as wide as the picture; a midrib and side veins.
/// Empty for other kinds.
[[nodiscard]] Texture material_texture(MaterialKind kind);
/// The normal map of the bark.
[[nodiscard]] Texture bark_normals();

/// Max texels of a picture file.
inline constexpr std::uint64_t kMaxTexels = std::uint64_t{1} << 26; // in total
inline constexpr std::uint32_t kMaxTextureSide = 16384;             // along a side
/// Reads a PNG, JPEG, SGI or TGA file whose texels take at most `max_bytes`. The error names any
/// other known format.
[[nodiscard]] Result<Texture> read_picture(std::string_view bytes, std::uint64_t max_bytes);
/// A normal map is returned unchanged; its mean near (0, 0, 1) identifies it. Any other picture is
/// a height map, from which normals are computed: white is higher than black by `bump` times 2 % of
/// the width.
[[nodiscard]] Texture normals_of(const Texture& picture, float bump);
/// `colour` with the opacity of the picture `opacity`: its alpha if it has holes, else its red
/// channel. Precondition: both have the same size.
[[nodiscard]] Texture with_opacity(Texture colour, const Texture& opacity);
/// Whether any texel is less than half opaque.
[[nodiscard]] bool has_holes(const Texture& texture);
/// The sRGB byte nearest to a linear value (IEC 61966-2-1). Equal on every machine.
[[nodiscard]] std::uint8_t nearest_srgb_byte(float linear);
/// Mean linear colour of texels that are at least half opaque; white without such texels.
[[nodiscard]] glm::vec3 mean_colour(const Texture& texture);

/// The bytes of a PNG file; without opacity if all texels are opaque. Empty if memory runs out.
[[nodiscard]] std::string encode_png(const Texture& texture);

} // namespace lsys
