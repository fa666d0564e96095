// SPDX-License-Identifier: MIT
#include "grammar/base/counted_text.h"
#include "grammar/base/paths.h"
#include "runtime/base/size_text.h"
#include "runtime/base/workers.h"
#include "runtime/cli/commands.h"
#include "runtime/pipeline/forest.h"
#include "runtime/pipeline/instancing_choice.h"
#include "runtime/program/files.h"
#include "runtime/program/host.h"
#include "runtime/tiles/tiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace lsys::lsc {

namespace {

namespace fs = std::filesystem;

/// Refuses a file, and a folder with files unless `force`.
Result<void> check_folder(const std::string& folder, bool force) {
    std::error_code error;
    const fs::file_status status = fs::status(path_of(folder), error);
    if (fs::exists(status) && !fs::is_directory(status)) {
        return Error{fmt::format("`{}` is a file; a tileset is a folder", folder)};
    }
    if (!force && fs::is_directory(status) &&
        fs::directory_iterator(path_of(folder), error) != fs::directory_iterator()) {
        return Error{fmt::format("`{}` has files already; --force writes there too", folder)};
    }
    return {};
}

/// Writes files below a folder, and makes the folders between.
class FolderWriter {
public:
    FolderWriter(std::string folder, const Console& console)
        : folder_(std::move(folder)), console_(console) {}

    Result<void> write(const std::string& path, const std::string& bytes) {
        const std::string whole = folder_ + "/" + path;
        const std::string folder(folder_of_path(whole));
        if (folders_.insert(folder).second) {
            std::error_code error;
            fs::create_directories(path_of(folder), error);
            if (error) {
                return Error{
                    fmt::format("cannot make the folder `{}`: {}", folder, error.message())};
            }
        }
        bytes_ += bytes.size();
        return write_file(whole, bytes, console_);
    }
    [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

private:
    std::string folder_;
    const Console& console_;
    std::set<std::string> folders_;
    std::uint64_t bytes_ = 0;
};

std::string stats_text(const TileForest& forest,
                       const std::vector<std::vector<TileContent>>& contents,
                       std::uint64_t trees,
                       std::uint64_t bytes) {
    std::string text = "level     side m  tiles   error m  a tile shows\n";
    const std::vector<TileLevel>& levels = forest.levels();
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const TileLevel& level = levels[i];
        text += fmt::format("{:>5} {:>10.1f} {:>6} {:>9.3f}  {}\n", i, level.side,
                            contents[i].size(), level.error,
                            level.has_trees ? fmt::format("{:.0f} trees of {} triangles",
                                                          level.trees, level.triangles)
                                            : std::string("ground and crowns as one surface"));
    }
    text += fmt::format("{}, {} in all", counted(trees, "tree"), byte_size_text(bytes));
    text += trees == 0 ? std::string("\n")
                       : fmt::format(", {:.0f} bytes a tree\n",
                                     static_cast<double>(bytes) / static_cast<double>(trees));
    return text;
}

/// Makes all tiles and writes them. `contents` gets their boxes.
Result<void> write_tiles(const TileForest& forest,
                         std::uint32_t threads,
                         const Console& console,
                         FolderWriter& folder,
                         std::vector<std::vector<TileContent>>& contents) {
    constexpr std::size_t kBatch = 256; // tiles that are in memory at once
    Workers workers(threads);
    for (std::uint32_t level = 0; level < forest.levels().size(); ++level) {
        const std::vector<TileId> ids = forest.tiles(level);
        std::vector<TileContent>& made = contents.emplace_back(ids.size());
        for (std::size_t first = 0; first < ids.size(); first += kBatch) {
            if (console.interrupted()) {
                return {};
            }
            const std::size_t count = std::min(kBatch, ids.size() - first);
            workers.for_each(
                count, [&](std::uint64_t i) { made[first + i] = forest.content(ids[first + i]); });
            for (std::size_t i = first; i < first + count; ++i) {
                if (Result<void> written = folder.write(TileForest::path_of(ids[i]), made[i].bytes);
                    !written) {
                    return written;
                }
                std::string().swap(made[i].bytes); // frees the memory
            }
        }
    }
    return {};
}

} // namespace

ExitStatus run_command(const TilesCommand& command, const Console& console) {
    if (command.overrides.rho) {
        return report_error(Error{"--rho is the part of branches that are instances; tiles hold "
                                  "whole trees, of which --heroes sets the variety"},
                            console);
    }
    if (const Result<void> usable = check_folder(command.output, command.force); !usable) {
        return report_error(usable.error(), console);
    }
    const Project project = make_project(console, command.run);
    SceneOverrides overrides = command.overrides;
    overrides.rho = 0.0F;
    LoadedScene loaded;
    ExitStatus status = console.take(load_scene(command.files, overrides, project), loaded);
    if (status == ExitStatus::Ok) {
        status = console.take(choose_instancing(loaded, project));
    }
    GrownForest grown;
    if (status == ExitStatus::Ok) {
        status = console.take(grow_species(loaded, project, {}), grown);
    }
    if (status == ExitStatus::Ok) {
        status = console.take(place_forest(loaded.scene, project, grown));
    }
    if (status != ExitStatus::Ok) {
        return status;
    }
    const std::uint64_t trees = grown.forest.trees.size();
    TileOptions options = command.tiles;
    options.generator = "lsc " LSC_VERSION;
    Outcome<TileForest> planned =
        make_tile_forest(loaded.scene, std::move(grown), options, project);
    console.show(planned.messages());
    if (!planned) {
        return status_of(planned.stop());
    }
    const TileForest& forest = planned.value();
    Result<void> written;
    FolderWriter folder(command.output, console);
    for (const TileFile& file : forest.files()) {
        written = written ? folder.write(file.path, file.bytes) : written;
    }
    std::vector<std::vector<TileContent>> contents;
    if (written) {
        written = write_tiles(forest, command.run.threads, console, folder, contents);
    }
    if (console.interrupted()) {
        return ExitStatus::Interrupted;
    }
    if (written) {
        for (const TileFile& file : forest.tilesets(contents)) { // the root comes last
            written = written ? folder.write(file.path, file.bytes) : written;
        }
    }
    if (!written) {
        return report_error(written.error(), console);
    }
    return command.stats
               ? report_result(console.write(stats_text(forest, contents, trees, folder.bytes())),
                               console)
               : ExitStatus::Ok;
}

} // namespace lsys::lsc
