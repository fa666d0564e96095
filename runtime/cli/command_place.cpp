// SPDX-License-Identifier: MIT
#include "grammar/base/counted_text.h"
#include "runtime/base/size_text.h"
#include "runtime/cli/commands.h"
#include "runtime/cli/load_tile_forest.h"
#include "runtime/program/files.h"
#include "runtime/program/host.h"
#include "runtime/tiles/tree_file.h"

#include <fmt/format.h>

#include <string_view>

namespace lsys::lsc {

ExitStatus run_command(const PlaceCommand& command, const Console& console) {
    if (command.stats && command.output == "-") {
        return report_error(Error{"--stats prints to standard output, as does `-o -`"}, console);
    }
    const Project project = make_project(console, command.run);
    LoadedScene loaded;
    ExitStatus status = load_tile_scene(command, project, console, loaded);
    if (status != ExitStatus::Ok) {
        return status;
    }
    PlacedScene placed;
    status = console.take(place_scene(loaded, project), placed);
    if (status != ExitStatus::Ok) {
        return status;
    }
    Result<Output> output = Output::open(command.output, console);
    if (!output) {
        return report_error(output.error(), console);
    }
    std::uint64_t bytes = 0;
    Result<void> result;
    const bool is_written =
        write_tree_file(placed.placement_digest, placed.trees, [&](std::string_view piece) {
            bytes += piece.size();
            result = output.value().write(piece);
            return result && !console.interrupted();
        });
    if (console.interrupted()) {
        return ExitStatus::Interrupted;
    }
    if (is_written) {
        result = output.value().commit();
    }
    if (!result || !command.stats) {
        return report_result(result, console);
    }
    return report_result(
        console.write(fmt::format("{} of {} species, {}\n", counted(placed.trees.size(), "tree"),
                                  loaded.scene.species.size(), byte_size_text(bytes))),
        console);
}

} // namespace lsys::lsc
