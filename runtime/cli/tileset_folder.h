// SPDX-License-Identifier: MIT
// TilesetFolder: the files of a tileset, numbered, and their writer. Numbers let threads and
// processes share out the work; the bytes of a file do not depend on who writes it. Used by
// `lsc tiles` and lsc-mpi.
#pragma once

#include "grammar/base/result.h"
#include "runtime/cli/options.h"
#include "runtime/program/console.h"
#include "runtime/program/files.h"
#include "runtime/tiles/tiles.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace lsys::lsc {

/// Counts of written files, their bytes and their trees.
struct TileTotals {
    std::uint64_t files = 0;
    std::uint64_t bytes = 0;
    std::uint64_t trees = 0; // number of trees in the tiles of the finest level
};

/// A source of work: the number of the next file to write, or none when all are taken. Called from
/// several threads at once.
using NextFile = std::function<std::optional<std::uint64_t>()>;

/// The file numbers of a part: every `part.count`-th number from `part.index` - 1 on, below `end`.
[[nodiscard]] NextFile files_of_part(const TilePart& part, std::uint64_t end);

/// Returns an error if the output is a file, or a folder that has files without --force, --resume
/// or --part.
[[nodiscard]] Result<void> check_tileset_folder(const TilesCommand& command);

/// The text of --stats. `is_whole`: whether the totals are those of all files.
[[nodiscard]] std::string
tileset_stats(const TileForest& forest, const TileTotals& totals, bool is_whole);

/// Writes numbered files. After an error or an interruption it writes no further file.
class TilesetFolder {
public:
    /// All arguments must outlive the object.
    TilesetFolder(const TilesCommand& command, const TileForest& forest, const Console& console);

    /// Number of files: shared files, tiles level by level from the root, tilesets or subtrees from
    /// the finest level up. At least one.
    [[nodiscard]] std::uint64_t count() const { return sections_.back().end; }
    /// Number of the last file, tileset.json of the root. If it is written after all others, it
    /// shows that the tileset is complete.
    [[nodiscard]] std::uint64_t root() const { return count() - 1; }

    /// Makes the folder of the tileset, and records `digest` in it: TileForest::digest(). Stops
    /// the writer if the folder has tiles of another digest, or of none, which the command keeps.
    void make(std::uint64_t digest);
    /// Writes a file, unless the folder has it and the command resumes. May be called from several
    /// threads with different numbers. Throws std::bad_alloc.
    void write(std::uint64_t number);
    /// Writes files until none is left. May be called from several threads. Throws std::bad_alloc.
    void write_from(const NextFile& next);

    /// Stops the writer, for example when another rank of `lsc-mpi` has failed. The first error is
    /// kept.
    void stop(const Error& error);
    [[nodiscard]] bool is_stopped() const { return is_stopped_ || console_.interrupted(); }
    /// The error that has stopped the writer.
    [[nodiscard]] Result<void> result() const;
    [[nodiscard]] TileTotals totals() const { return {files_, bytes_, trees_}; }

private:
    enum class Kind : std::uint8_t { Shared, Content, Subtree, Tileset };
    /// Files of one kind with consecutive numbers.
    struct Section {
        Kind kind = Kind::Shared;
        std::uint32_t level = 0;   // level of the quadtree; 0 for Shared
        std::uint32_t columns = 0; // tiles of a row
        std::uint64_t end = 0;     // one more than the number of its last file
    };

    /// Adds the files of one kind and level, with the next numbers.
    void add_section(Kind kind, std::uint32_t level);
    void write_numbered(std::uint64_t number);
    /// Writes the bytes that make() returns, unless the file exists and the command resumes.
    template <typename Make>
    void write_file_at(const std::string& path, const Make& make);
    /// Makes a folder below the folder of the tileset.
    void make_folder(std::string_view path);
    /// Stops the writer if `done` is an error.
    void take(const Result<void>& done);
    /// Stores the files of `outputs_` on the disk, then gives them their names.
    void name_files();

    const TilesCommand& command_;
    const TileForest& forest_;
    const Console& console_;
    std::vector<Section> sections_; // by number of their files
    // The totals so far.
    std::atomic<std::uint64_t> files_{0};
    std::atomic<std::uint64_t> bytes_{0};
    std::atomic<std::uint64_t> trees_{0};
    std::atomic<bool> is_stopped_{false};
    mutable std::mutex mutex_;      // guards folders_, result_ and outputs_
    std::set<std::string> folders_; // folders that exist
    Result<void> result_;
    std::vector<Output> outputs_; // complete files under temporary names
    /// The digest to record when all files are written, because the folder has other tiles, which
    /// the command replaces.
    std::optional<std::uint64_t> late_digest_;
};

} // namespace lsys::lsc
