// SPDX-License-Identifier: MIT
// USDZ (OpenUSD, "USDZ file format specification"): an archive of a layer and its pictures.
#pragma once

#include "runtime/export/impl/pictures.h"
#include "runtime/export/impl/piece_writer.h"

#include <functional>
#include <string>
#include <vector>

namespace lsys {

/// Contents of an archive.
struct UsdzContents {
    ExportSubject subject = ExportSubject::Plant;
    std::string name; // of the layer
    /// Writes the layer. Called twice, as the archive states size and checksum before the bytes.
    std::function<void(PieceWriter&)> put_layer;
    std::vector<Picture> pictures;
    std::uint32_t threads = 0; // that encode pictures; 0: as many as the machine has
};
/// Stops: Failed for more than 4 GiB, before the first byte; Cancelled.
Outcome<void> write_usdz_archive(const UsdzContents& contents, PieceWriter& out);

} // namespace lsys
