// SPDX-License-Identifier: MIT
#include "runtime/base/deadline.h"
#include "runtime/cli/commands.h"
#include "runtime/cli/load_tile_forest.h"
#include "runtime/program/time_limit.h"
#include "runtime/serve/http_server.h"
#include "runtime/serve/tile_service.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>

namespace lsys::lsc {

namespace {

/// Loads the forest, within `--max-time`.
ExitStatus load_in_time(const ServeCommand& command,
                        const Console& console,
                        std::optional<TileForest>& forest) {
    const double seconds = command.run.max_seconds;
    if (!std::isfinite(seconds)) {
        return load_tile_forest(command, TilePlacements::OnGrids, console, forest);
    }
    Io io = console.io();
    const std::string late = late_message(seconds);
    const Deadline deadline(seconds, io.interrupted, end_process(io, late));
    io.interrupted = deadline.stop();
    const Console limited(io, command.messages);
    const ExitStatus status = load_tile_forest(command, TilePlacements::OnGrids, limited, forest);
    if (!deadline.has_passed()) {
        return status;
    }
    console.error(late);
    return ExitStatus::Limit;
}

} // namespace

ExitStatus run_command(const ServeCommand& command, const Console& console) {
    std::optional<TileForest> forest;
    const ExitStatus status = load_in_time(command, console, forest);
    if (status != ExitStatus::Ok) {
        return status;
    }
    TileService service(*forest, command.cache_bytes);
    ServerOptions options = command.server;
    options.threads = command.run.threads;
    const auto ready = [&console](const std::string& address) {
        static_cast<void>(console.write(fmt::format("serving {}tileset.json\n", address)));
        static_cast<void>(console.flush());
    };
    const Result<void> served =
        serve_tiles(service, options, ready, [&console] { return console.interrupted(); });
    return served ? ExitStatus::Ok : report_error(served.error(), console);
}

} // namespace lsys::lsc
