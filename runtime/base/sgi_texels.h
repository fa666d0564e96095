// SPDX-License-Identifier: MIT
// Texels of SGI files (.rgb, .rgba, .bw), the pictures of textures of cpfg: "The SGI Image File
// Format", version 1.00, Paul Haeberli, Silicon Graphics.
#pragma once

#include "grammar/base/result.h"
#include "runtime/base/picture_texels.h"

#include <cstdint>
#include <string_view>

namespace lsys {

[[nodiscard]] bool is_sgi(std::string_view bytes);
/// Reads a picture of one to four channels, with or without run-length encoding. The last of two or
/// four channels is the opacity; other pictures are opaque. Of samples of two bytes the first is
/// used. A picture of more than `max_pixels`, or whose texels need more than `max_bytes`, is
/// refused before memory is allocated.
[[nodiscard]] Result<PictureTexels>
read_sgi_texels(std::string_view bytes, std::uint64_t max_pixels, std::uint64_t max_bytes);

} // namespace lsys
