// SPDX-License-Identifier: MIT
// Texels of TGA files: "Truevision TGA File Format Specification", version 2.0.
#pragma once

#include "grammar/base/result.h"
#include "runtime/base/picture_texels.h"

#include <cstdint>
#include <optional>
#include <string_view>

namespace lsys {

/// Reads a picture of 15, 16, 24 or 32 bits per pixel, of 8 bits of grey, perhaps with 8 bits of
/// opacity, or of 8 bits with a colour map, with or without run-length encoding. It is opaque
/// unless the file has opacities. A picture of more than `max_pixels`, or whose texels need more
/// than `max_bytes`, is refused before memory is allocated. nullopt: the header is not of a TGA
/// file that can be read. The format has no magic number, so other formats are tried first.
[[nodiscard]] std::optional<Result<PictureTexels>>
read_targa_texels(std::string_view bytes, std::uint64_t max_pixels, std::uint64_t max_bytes);

} // namespace lsys
