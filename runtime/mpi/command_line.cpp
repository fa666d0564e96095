// SPDX-License-Identifier: MIT
#include "runtime/mpi/command_line.h"

#include "runtime/cli/tile_options.h"
#include "runtime/program/find_option.h"
#include "runtime/program/option_parsers.h"
#include "runtime/program/policy_options.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace lsys::mpi {

namespace {

constexpr const char* kProgram = "lsc-mpi";
constexpr const char* kVersion = "lsc-mpi " LSC_VERSION;
constexpr const char* kHint = "`mpirun -n 4 lsc-mpi tiles SCENE -o FOLDER` writes a tileset";

/// Adds the options of the program; returns its command.
CLI::App& add_options(CLI::App& app, bool& verbose, lsc::TilesCommand& command) {
    app.allow_windows_style_options(false); // an argument such as `/a` is a path, not an option
    app.set_version_flag("--version", kVersion, "Print the version and exit");
    app.add_flag("-v,--verbose", verbose,
                 "With --version: print commit, compiler, libraries and processor too");
    app.require_subcommand(1);
    app.footer("`lsc-mpi tiles --help` lists the options. All other commands are those of lsc.");
    CLI::App& tiles = *app.add_subcommand(
        "tiles", "Write a forest as 3D Tiles for Cesium and other viewers, with the processes of "
                 "an MPI job");
    lsc::add_tiles(tiles, command);
    tiles.remove_option(find_option(tiles, "--part"));
    find_option(tiles, "--max-output")
        ->description("Maximum size of the files of each process (default: none)");
    find_option(tiles, "--threads")
        ->description("Number of threads of each process; does not change the result (default: the "
                      "cores of a machine divided by the processes there, and at most the cores to "
                      "which a process is bound)");
    tiles.footer(
        "Writes the same files as `lsc tiles`, with all processes of an MPI job, into a folder "
        "that their\n"
        "machines share. Process 0 hands out the files, so faster machines write more; "
        "tileset.json "
        "is written\n"
        "last. An error of one process ends all. --resume continues a job that has lost a "
        "machine.\n"
        "A process per machine needs the least memory. mpirun binds each process to one core "
        "unless "
        "told\n"
        "otherwise; see the examples.\n"
        "Exit status: 0 success, 1 errors in a grammar or of a process while it writes, 2 file or "
        "command\n"
        "line error, 3 limit reached.\n"
        "Examples: mpirun --map-by ppr:1:node --bind-to none lsc-mpi tiles wood.toml -o wood\n"
        "          srun --ntasks-per-node=1 --cpus-per-task=64 lsc-mpi tiles wood.toml -o wood");
    return tiles;
}

bool is_part(const std::string& argument) {
    return argument == "--part" || argument.starts_with("--part=");
}

UsageError explain_mistake(const CLI::ParseError& error,
                           const CLI::App& app,
                           const CLI::App& tiles,
                           std::span<const std::string> arguments) {
    if (arguments.front() != "tiles") {
        return to_usage_error(error, app, kProgram);
    }
    UsageError usage = to_usage_error(error, tiles, fmt::format("{} tiles", kProgram));
    if (usage.message == "unknown option `--part`" ||
        (usage.message.starts_with("unknown option `--part=") &&
         std::any_of(arguments.begin(), arguments.end(), is_part))) {
        return {"lsc-mpi has no `--part`: its processes share out the files themselves",
                "`lsc tiles --part I/N` is for processes without MPI"};
    }
    return usage;
}

} // namespace

CommandLine parse_command_line(std::span<const std::string> arguments) {
    if (arguments.empty()) {
        return UsageError{"no command is given", kHint};
    }
    const std::string& first = arguments.front();
    if (!first.starts_with('-') && first != "tiles") {
        return UsageError{
            fmt::format("`{}` is not a command of lsc-mpi, whose only one is `tiles`", first),
            kHint};
    }
    CLI::App app("Writes forests as 3D Tiles with the processes of an MPI job.", kProgram);
    lsc::TilesCommand command;
    bool verbose = false;
    const CLI::App& tiles = add_options(app, verbose, command);
    try {
        std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());
        app.parse(std::move(reversed));
    } catch (const CLI::CallForHelp&) {
        return PrintText{first == "tiles" ? help_text(tiles, kProgram) : help_text(app, "")};
    } catch (const CLI::CallForVersion&) {
        return PrintText{fmt::format("{}\n", kVersion),
                         is_given(first == "tiles" ? tiles : app, "--verbose")};
    } catch (const CLI::ParseError& error) {
        return explain_mistake(error, app, tiles, arguments);
    }
    if (first != "tiles") { // `lsc-mpi -v tiles`
        return UsageError{fmt::format("`{}` stands before the command", first),
                          "options stand after the command"};
    }
    const SceneOverrides& scene = command.overrides;
    std::vector<std::string> named = command.files;
    named.insert(named.end(), {scene.density_map, scene.ground_picture, scene.ground_normals,
                               scene.grammar.view});
    if (const auto mistake = apply_policy(tiles, std::move(named), command.run)) {
        return *mistake;
    }
    return command;
}

void visit_command(
    const std::function<void(const CLI::App& program, const CLI::App& command)>& visit) {
    CLI::App app("Writes forests as 3D Tiles with the processes of an MPI job.", kProgram);
    lsc::TilesCommand command;
    bool verbose = false;
    const CLI::App& tiles = add_options(app, verbose, command);
    visit(app, tiles);
}

} // namespace lsys::mpi
