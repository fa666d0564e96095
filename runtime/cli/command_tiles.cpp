// SPDX-License-Identifier: MIT
#include "runtime/base/workers.h"
#include "runtime/cli/commands.h"
#include "runtime/cli/load_tile_forest.h"
#include "runtime/cli/tileset_folder.h"
#include "runtime/tiles/tiles.h"

#include <cstdint>
#include <optional>

namespace lsys::lsc {

namespace {

/// Writes the files of this part in ascending order of their numbers. The last one is tileset.json
/// of the root, if it belongs to the part.
void write_part(TilesetFolder& folder, const TilesCommand& command, std::uint64_t digest) {
    folder.make(digest);
    Workers workers(command.run.threads);
    const NextFile next = files_of_part(command.part, folder.root());
    workers.for_each(workers.count(), [&](std::uint64_t) { folder.write_from(next); });
    const bool has_root = folder.root() % command.part.count == command.part.index - 1;
    if (has_root && !folder.is_stopped()) {
        folder.write(folder.root());
    }
}

} // namespace

ExitStatus run_command(const TilesCommand& command, const Console& console) {
    if (const Result<void> usable = check_tileset_folder(command); !usable) {
        return report_error(usable.error(), console);
    }
    std::optional<TileForest> forest;
    const ExitStatus status = load_tile_forest(command, TilePlacements::All, console, forest);
    if (status != ExitStatus::Ok) {
        return status;
    }
    TilesetFolder folder(command, *forest, console);
    write_part(folder, command, forest->digest());
    if (console.interrupted()) {
        return ExitStatus::Interrupted;
    }
    if (const Result<void> written = folder.result(); !written) {
        return report_error(written.error(), console);
    }
    const bool is_whole = command.part.count == 1 && !command.resume;
    return command.stats
               ? report_result(console.write(tileset_stats(*forest, folder.totals(), is_whole)),
                               console)
               : ExitStatus::Ok;
}

} // namespace lsys::lsc
