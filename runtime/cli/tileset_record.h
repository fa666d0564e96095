// SPDX-License-Identifier: MIT
// The record of the tileset of a folder: a file with the digest of all that the tiles depend on.
// It is written before the tiles, so a stopped run is continued only with the same scene and
// options.
#pragma once

#include "grammar/base/result.h"
#include "runtime/program/console.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace lsys::lsc {

/// Name of the file in the folder of a tileset.
inline constexpr std::string_view kTilesetRecord = "tileset.digest";

/// Whether the folder of a tileset has tiles, and whether its record has a given digest.
enum class TilesetRecord : std::uint8_t {
    NoTiles, // no tiles and no record
    Same,    // a record of this digest
    Other,   // a record of another digest, or one that cannot be read
    Missing, // tiles without a record
};

/// Compares the record of `folder` with `digest`.
[[nodiscard]] TilesetRecord find_tileset_record(const std::string& folder, std::uint64_t digest);
/// Writes the record of `folder`, which had none. Returns Same, or Other if another run has written
/// a record of another digest meanwhile.
[[nodiscard]] Result<TilesetRecord>
begin_tileset_record(const std::string& folder, std::uint64_t digest, const Console& console);
/// Writes the record of `folder`, or replaces it.
[[nodiscard]] Result<void>
write_tileset_record(const std::string& folder, std::uint64_t digest, const Console& console);
/// Removes the record of `folder`, if it has one.
[[nodiscard]] Result<void> remove_tileset_record(const std::string& folder);
/// The error for a folder whose tiles must not be kept. Precondition: `record` is Other or Missing.
[[nodiscard]] Error other_tiles_error(const std::string& folder, TilesetRecord record);

} // namespace lsys::lsc
