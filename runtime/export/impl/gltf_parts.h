// Pieces of glTF that its writers share: materials, images, the headers of a GLB.
#pragma once

#include "runtime/export/impl/pictures.h"
#include "runtime/export/impl/piece_writer.h"
#include "runtime/meshing/mesh.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace lsys {

inline constexpr std::uint64_t kMostGltfBytes = 0xFFFFFFFFu; // of a GLB, and of any buffer

/// `coloured`: vertices have colours of their own in place of the material's.
[[nodiscard]] std::string
material_json(const Material& material, const MaterialPictures& shown, bool coloured);
/// Samplers, textures and images, with a comma behind them. The images lie in buffer views from
/// `first_view` on.
[[nodiscard]] std::string images_json(const std::vector<Picture>& list, std::size_t first_view);

/// What stands before the document and before the buffer, whose sizes are multiples of 4. False:
/// the file would be too large, nothing was written.
[[nodiscard]] bool
put_glb_header(std::uint64_t json_bytes, std::uint64_t data_bytes, PieceWriter& out);
void put_glb_data_header(std::uint64_t data_bytes, PieceWriter& out);

} // namespace lsys
