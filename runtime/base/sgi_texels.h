// SPDX-License-Identifier: MIT
// Texels of SGI files (.rgb, .rgba, .bw), the pictures of textures of cpfg: "The SGI Image File
// Format", version 1.00, Paul Haeberli, Silicon Graphics.
#pragma once

#include "grammar/base/result.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace lsys {

/// RGBA texels by rows from the top; opaque without a fourth channel.
struct SgiTexels {
    std::uint32_t columns = 0;
    std::uint32_t rows = 0;
    std::vector<std::uint8_t> bytes;
};

[[nodiscard]] bool is_sgi(std::string_view bytes);
/// Reads a picture of one to four channels, with or without run-length encoding; of samples of two
/// bytes the first is used. A picture of more than `max_pixels`, or whose texels need more than
/// `max_bytes`, is refused before memory is allocated.
[[nodiscard]] Result<SgiTexels>
read_sgi_texels(std::string_view bytes, std::uint64_t max_pixels, std::uint64_t max_bytes);

} // namespace lsys
