// SPDX-License-Identifier: MIT
#include "grammar/base/counted_text.h"
#include "grammar/base/paths.h"
#include "runtime/base/size_text.h"
#include "runtime/base/workers.h"
#include "runtime/cli/commands.h"
#include "runtime/cli/load_tile_forest.h"
#include "runtime/program/files.h"
#include "runtime/tiles/tiles.h"

#include <fmt/format.h>

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace lsys::lsc {

namespace {

namespace fs = std::filesystem;

/// Error: `folder` is a file, or it has files and `may_have_files` is false.
Result<void> check_folder(const std::string& folder, bool may_have_files) {
    std::error_code error;
    const fs::file_status status = fs::status(path_of(folder), error);
    if (fs::exists(status) && !fs::is_directory(status)) {
        return Error{fmt::format("`{}` is a file; a tileset is a folder", folder)};
    }
    if (!may_have_files && fs::is_directory(status) &&
        fs::directory_iterator(path_of(folder), error) != fs::directory_iterator()) {
        return Error{fmt::format("`{}` has files already; --force writes there too, --resume adds "
                                 "the files that are missing",
                                 folder)};
    }
    return {};
}

/// Counts of a finished run.
struct TileTotals {
    std::uint64_t files = 0;
    std::uint64_t bytes = 0;
    std::uint64_t trees = 0; // of the finest level
};

/// Writes the files of a tileset. All files are numbered in the order: shared files, tiles level by
/// level, tilesets from the finest up to the root; a part of N writes every Nth.
class TilesetFolder {
public:
    TilesetFolder(const TilesCommand& command, const TileForest& forest, const Console& console)
        : command_(command), forest_(forest), console_(console), workers_(command.run.threads) {}

    Result<void> write() {
        make_folder("");
        const std::vector<TileFile>& shared = forest_.files();
        write_files(shared.size(), [&](std::uint64_t i) {
            write_file_at(shared[i].path, [&] { return shared[i].bytes; });
        });
        const auto levels = static_cast<std::uint32_t>(forest_.levels().size());
        for (std::uint32_t level = 0; level < levels; ++level) {
            const std::vector<TileId> tiles = forest_.tiles(level);
            write_files(tiles.size(), [&](std::uint64_t i) {
                write_file_at(TileForest::content_path(tiles[i]), [&] {
                    TileContent content = forest_.content(tiles[i]);
                    trees_ += level + 1 == levels ? content.trees : 0;
                    return std::move(content.bytes);
                });
            });
        }
        for (std::uint32_t level = levels; level-- > 0;) {
            if (TileForest::has_tileset(level)) {
                const std::vector<TileId> roots = forest_.tiles(level);
                write_files(roots.size(), [&](std::uint64_t i) {
                    write_file_at(TileForest::tileset_path(roots[i]),
                                  [&] { return forest_.tileset(roots[i]); });
                });
            }
        }
        const std::lock_guard<std::mutex> lock(mutex_);
        return result_;
    }
    [[nodiscard]] TileTotals totals() const { return {files_, bytes_, trees_}; }

private:
    /// Calls write(i) for the files of this part, on several threads.
    template <typename Write>
    void write_files(std::uint64_t count, const Write& write) {
        // Index of the first file whose number is part - 1 modulo `parts`.
        const std::uint64_t parts = command_.part.of;
        const std::uint64_t first = (command_.part.number - 1 + parts - number_ % parts) % parts;
        number_ += count;
        workers_.for_each(count > first ? (count - first - 1) / parts + 1 : 0,
                          [&](std::uint64_t i) {
                              if (!is_stopped_ && !console_.interrupted()) {
                                  write(first + parts * i);
                              }
                          });
    }

    template <typename Make>
    void write_file_at(const std::string& path, const Make& make) {
        const std::string whole = command_.output + "/" + path;
        std::error_code error;
        if (command_.resume && fs::exists(path_of(whole), error)) {
            return; // a file has its name only when it is complete
        }
        make_folder(folder_of_path(path));
        const std::string bytes = make();
        if (is_stopped_) {
            return;
        }
        if (const Result<void> written = lsys::write_file(whole, bytes, console_); !written) {
            stop(written.error());
        }
        bytes_ += bytes.size();
        ++files_;
    }

    /// Makes a folder below that of the tileset.
    void make_folder(std::string_view path) {
        const std::lock_guard<std::mutex> lock(mutex_);
        if (!folders_.insert(std::string(path)).second) {
            return;
        }
        const std::string whole = command_.output + (path.empty() ? "" : "/") + std::string(path);
        std::error_code error;
        fs::create_directories(path_of(whole), error);
        if (error && result_) {
            result_ = Error{fmt::format("cannot make the folder `{}`: {}", whole, error.message())};
            is_stopped_ = true;
        }
    }

    void stop(const Error& error) {
        const std::lock_guard<std::mutex> lock(mutex_);
        result_ = result_ ? Result<void>(error) : result_;
        is_stopped_ = true;
    }

    const TilesCommand& command_;
    const TileForest& forest_;
    const Console& console_;
    Workers workers_;
    std::uint64_t number_ = 0; // of the next file
    std::atomic<std::uint64_t> files_{0};
    std::atomic<std::uint64_t> bytes_{0};
    std::atomic<std::uint64_t> trees_{0};
    std::atomic<bool> is_stopped_{false};
    std::mutex mutex_; // guards the members below
    std::set<std::string> folders_;
    Result<void> result_;
};

std::string stats_text(const TileForest& forest, const TileTotals& totals, bool is_whole) {
    std::string text = "level     side m    tiles   error m  a tile shows\n";
    const std::vector<TileLevel>& levels = forest.levels();
    for (std::uint32_t i = 0; i < levels.size(); ++i) {
        const TileLevel& level = levels[i];
        text += fmt::format("{:>5} {:>10.1f} {:>8} {:>9.3f}  {}\n", i, level.side,
                            forest.tiles(i).size(), level.error,
                            level.has_trees ? fmt::format("{:.0f} trees of {} triangles",
                                                          level.trees, level.triangles)
                                            : std::string("ground and crowns as one surface"));
    }
    text +=
        fmt::format("{} written, {}", counted(totals.files, "file"), byte_size_text(totals.bytes));
    if (is_whole && totals.trees != 0) {
        text += fmt::format("; {}, {:.0f} bytes a tree", counted(totals.trees, "tree"),
                            static_cast<double>(totals.bytes) / static_cast<double>(totals.trees));
    }
    return text + "\n";
}

} // namespace

ExitStatus run_command(const TilesCommand& command, const Console& console) {
    const bool is_whole = command.part.of == 1 && !command.resume;
    if (const Result<void> usable = check_folder(command.output, command.force || !is_whole);
        !usable) {
        return report_error(usable.error(), console);
    }
    std::optional<TileForest> forest;
    const ExitStatus status = load_tile_forest(command.files, command.overrides, command.tiles,
                                               command.run, TilePlacements::All, console, forest);
    if (status != ExitStatus::Ok) {
        return status;
    }
    TilesetFolder folder(command, *forest, console);
    const Result<void> written = folder.write();
    if (console.interrupted()) {
        return ExitStatus::Interrupted;
    }
    if (!written) {
        return report_error(written.error(), console);
    }
    return command.stats
               ? report_result(console.write(stats_text(*forest, folder.totals(), is_whole)),
                               console)
               : ExitStatus::Ok;
}

} // namespace lsys::lsc
