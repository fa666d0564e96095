// SPDX-License-Identifier: MIT
#include "runtime/cli/tileset_record.h"

#include "grammar/base/paths.h"
#include "runtime/program/files.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

namespace lsys::lsc {

namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t kMaxRecordBytes = 256;

std::string path_of_record(const std::string& folder) {
    return folder + "/" + std::string(kTilesetRecord);
}

std::string record_text(std::uint64_t digest) {
    return fmt::format("lsc tiles {:016x}\n", digest);
}

Result<void> write_record(Result<Output> output, std::uint64_t digest) {
    Result<void> written =
        output ? output.value().write(record_text(digest)) : Result<void>(output.error());
    return written ? output.value().commit() : written;
}

/// Whether a folder has a tileset, or a part of one: its files and the folders of its levels.
bool has_tiles(const std::string& folder) {
    const auto is_digit = [](char letter) { return letter >= '0' && letter <= '9'; };
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(path_of(folder), error)) {
        const std::string name = path_text(entry.path().filename());
        if (name == "tileset.json" || name == "models" || name == "pictures" ||
            std::all_of(name.begin(), name.end(), is_digit)) {
            return true;
        }
    }
    return false;
}

} // namespace

TilesetRecord find_tileset_record(const std::string& folder, std::uint64_t digest) {
    // The tiles first: a process that begins the tileset now writes the record before its tiles.
    const bool tiles = has_tiles(folder);
    const std::string path = path_of_record(folder);
    std::error_code error;
    if (!fs::exists(fs::symlink_status(path_of(path), error))) {
        return tiles ? TilesetRecord::Missing : TilesetRecord::NoTiles;
    }
    const Result<std::string> text =
        read_bytes(path, FileKind::Regular, {kMaxRecordBytes, ~std::uint64_t{0}}, nullptr);
    return text && text.value() == record_text(digest) ? TilesetRecord::Same : TilesetRecord::Other;
}

Result<TilesetRecord>
begin_tileset_record(const std::string& folder, std::uint64_t digest, const Console& console) {
    const Result<void> written =
        write_record(Output::create(path_of_record(folder), console), digest);
    if (written) {
        return TilesetRecord::Same;
    }
    const TilesetRecord record = find_tileset_record(folder, digest);
    const bool is_of_another_run = record == TilesetRecord::Same || record == TilesetRecord::Other;
    return is_of_another_run ? Result<TilesetRecord>(record) : written.error();
}

Result<void>
write_tileset_record(const std::string& folder, std::uint64_t digest, const Console& console) {
    return write_record(Output::open_one_of_many(path_of_record(folder), console), digest);
}

Result<void> remove_tileset_record(const std::string& folder) {
    std::error_code error;
    fs::remove(path_of(path_of_record(folder)), error);
    if (error) {
        return Error{
            fmt::format("cannot remove `{}`: {}", path_of_record(folder), error.message())};
    }
    return {};
}

Error other_tiles_error(const std::string& folder, TilesetRecord record) {
    const std::string_view advice = "write into another folder, or replace the files by --force "
                                    "without --resume";
    if (record == TilesetRecord::Missing) {
        return Error{fmt::format("`{}` has tiles without `{}`, which says of which scene and "
                                 "options they are: an earlier version of lsc wrote them, or a run "
                                 "with --force was stopped; {}",
                                 folder, kTilesetRecord, advice)};
    }
    return Error{fmt::format("`{}` has tiles of another scene, of other options or of another "
                             "version of lsc: `{}` has another digest; {}",
                             folder, kTilesetRecord, advice)};
}

} // namespace lsys::lsc
