#include "runtime/cli/command_line.h"

#include "grammar/base/diagnostic.h"
#include "grammar/dialects/dialect.h"
#include "runtime/program/arguments.h"
#include "runtime/program/memory_size.h"
#include "runtime/program/option_parsers.h"
#include "runtime/turtle/turtle.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace lsys::lsc {

namespace {

constexpr const char* kListHint = "`lsc --help` lists the commands";

void add_message_options(CLI::App& app, MessageOptions& options) {
    app.set_version_flag("--version", "lsc " LSC_VERSION, "Print the version and exit");
    add_messages(app, options);
}

void add_check(CLI::App& app, CheckCommand& command) {
    app.add_option("FILE", command.files, "Grammars; `-` is standard input")->required();
    app.add_flag("--fix", command.fix,
                 "Apply every repair that is certain to FILE, and to files that it includes from "
                 "its own folder or below");
    add_grammar(app, command.grammar, command.run);
    add_message_options(app, command.messages);
    add_deny(app, command.messages);
    app.footer(
        "A repair is certain where nothing else can have been meant and its statement is\n"
        "right afterwards. Others are shown as help.\n"
        "--fix leaves a file that lies outside the folder of FILE as it is, symbolic links "
        "resolved, unless\nit is named here too; of a grammar and what it includes all files are "
        "written or none.\n"
        "Exit status: 0 no errors, 1 errors in a grammar, 2 a file or the command line, 3 a "
        "limit.\n"
        "Example: lsc check --fix tree.lsys");
}

void add_compile(CLI::App& app, CompileCommand& command) {
    app.add_option("FILE", command.file, "The grammar; `-` is standard input")->required();
    app.add_option("-o,--output", command.output, "The .lsb file; `-` is standard output")
        ->required()
        ->type_name("FILE");
    add_grammar(app, command.grammar, command.run);
    add_seed(app, command.seed);
    add_message_options(app, command.messages);
    add_deny(app, command.messages);
    app.footer("-n and --seed take the place of #n and `#set seed` in what is written.\n"
               "Example: lsc compile tree.lsys -o tree.lsb");
}

void add_dump(CLI::App& app, DumpCommand& command) {
    app.add_option("FILE", command.file, "A grammar or a .lsb file; `-` is standard input")
        ->required();
    app.add_option("-o,--output", command.output, "Where to write (default standard output)")
        ->type_name("FILE");
    add_choice<DumpStage>(
        app, "--stage", command.stage,
        {{"tokens", DumpStage::Tokens},
         {"ast", DumpStage::Ast},
         {"program", DumpStage::Program},
         {"instanced", DumpStage::Instanced},
         {"bytecode", DumpStage::Bytecode},
         {"word", DumpStage::Word},
         {"skeleton", DumpStage::Skeleton},
         {"mesh", DumpStage::Mesh}},
        "What is written: what a step of the compiler made, the derived word, what "
        "the turtle draws for it, or the triangles of that (default word)");
    add_parsed(app, "--rho", command.rho, fraction,
               "With --stage instanced: the probability that a branch is taken from recorded "
               "ones (default 0.6)")
        ->type_name("P");
    app.add_flag("--all", command.all, "One generation a line, 0 first");
    app.add_flag("--count", command.count,
                 "The number of modules instead of the modules; where the growth matrix tells "
                 "it, nothing is derived");
    app.add_flag("--stream", command.stream,
                 "Derive without storing the word (no contexts, parallel rewriting only)");
    app.add_flag(
        "--origins", command.origins,
        "Say of each module, one a line, or of each part of the skeleton: which production "
        "or the axiom wrote it, where that stands, and in which generation");
    add_mesh(app, command.mesh);
    add_grammar(app, command.grammar, command.run);
    add_seed(app, command.seed);
    add_run_limits(app, command.run);
    add_parsed(app, "--steps", command.steps, whole(0, kMaxGenerations),
               "Make only K of the generations in this run")
        ->type_name("K")
        ->group("Saved states");
    app.add_option("--save-state", command.save_state, "Write where the derivation stands")
        ->type_name("FILE")
        ->group("Saved states");
    app.add_option("--from", command.from, "Go on from a saved state")
        ->type_name("FILE")
        ->group("Saved states");
    add_message_options(app, command.messages);
    add_deny(app, command.messages);
    app.footer("Examples: lsc dump -n 3 tree.lsys\n"
               "          lsc dump --all --count tree.lsys\n"
               "          lsc dump -n 10 --steps 5 --save-state half.lss --count tree.lsys\n"
               "          lsc dump --from half.lss tree.lsys\n"
               "          lsc dump --stage skeleton --origins tree.lsys");
}

void add_export(CLI::App& app, ExportCommand& command) {
    app.add_option("FILE", command.file, "A grammar or a .lsb file; `-` is standard input")
        ->required();
    app.add_option("-o,--output", command.output,
                   "The file, whose name tells the format; `-` is standard output")
        ->required()
        ->type_name("FILE");
    std::vector<std::pair<std::string, std::optional<ExportFormat>>> formats;
    for (const ExportFormat format : export_formats()) {
        formats.emplace_back(traits_of(format).name, format);
    }
    add_choice(app, "--format", command.format, std::move(formats),
               "The format (default by the name of the file)");
    app.add_flag("--stream", command.stream,
                 "Draw without storing the word (no contexts, parallel rewriting only)");
    app.add_flag("--stats", command.stats,
                 "Print segments, sizes, vertices, triangles, bytes and the time of each stage; "
                 "with --message-format json as one JSON object");
    add_mesh(app, command.mesh);
    const auto gravity = [](const std::string& text) { return parse_number(text, 0.0F, 1e6F); };
    add_parsed(app, "--gravity", command.gravity, gravity,
               "Let the plant bend under its weight, in m/s2 (on Earth 9.81)")
        ->type_name("G")
        ->group("Physics");
    add_parsed(app, "--wind", command.wind, parse_wind,
               "Let it bend in wind, in m/s; GUST is the part of it that comes and goes")
        ->type_name("X,Y,Z[,GUST]")
        ->group("Physics");
    app.add_flag("--settle", command.settle,
                 "Start from where it comes to rest; without --frames that is what is written")
        ->group("Physics");
    constexpr std::uint64_t kMaxFrames = 1'000'000;
    const std::string frames =
        fmt::format("The plant at N moments: {} hold them as one animation, of other formats "
                    "there is a numbered file for each: tree.0001.ply, tree.0002.ply, ...",
                    format_names("and", [](const FormatTraits& format) { return format.motion; }));
    add_parsed(app, "--frames", command.frames, whole(1, kMaxFrames), frames.c_str())
        ->type_name("N")
        ->group("Physics");
    const auto rate = [](const std::string& text) { return parse_number(text, 0.1F, 1000.0F); };
    add_parsed(app, "--fps", command.frames_per_second, rate, "Frames a second (default 24)")
        ->type_name("F")
        ->group("Physics");
    add_grammar(app, command.grammar, command.run);
    add_seed(app, command.seed);
    add_run_limits(app, command.run);
    add_message_options(app, command.messages);
    add_deny(app, command.messages);
    app.footer(
        "Metres, +Y up. The file is complete or absent. OBJ gets a .mtl beside it, OBJ and USDA "
        "get "
        "pictures\nof bark and leaves, as tree.bark.png; standard output gets neither. SVG is the "
        "drawing in the plane\nof X and Y. A skin has at most 65,535 joints that move.\n"
        "Examples: lsc export tree.lsys -o tree.glb\n"
        "          lsc export tree.lsys -o tree.glb --wind 8,0,0,0.5 --frames 48 --fps 24");
}

void add_forest(CLI::App& app, ForestCommand& command) {
    app.add_option("FILE", command.files, "A scene (.toml), or grammars, one for each species")
        ->required();
    const auto has_instances = [](const FormatTraits& format) {
        return format.write_forest != nullptr;
    };
    app.add_option("-o,--output", command.output,
                   fmt::format("The file, whose name tells the format: {} with instances, json "
                               "statistics; with --bake also {}",
                               format_names("or", has_instances),
                               format_names("or",
                                            [&](const FormatTraits& format) {
                                                return format.uses_mesh && !has_instances(format);
                                            })))
        ->type_name("FILE");
    app.add_flag("--check", command.check, "Read the scene and its grammars, write nothing");
    app.add_flag("--stats", command.stats,
                 "Print trees, branches, how many trees differ, and what the caches hold");
    app.add_flag("--expand", command.expand,
                 "glTF without EXT_mesh_gpu_instancing: a node for each branch");
    app.add_flag("--bake", command.bake, "One mesh of all triangles");
    add_parsed(
        app, "--cell", command.cell,
        [](const std::string& text) { return parse_number(text, 0.0F, 1e6F); },
        "Side of the squares of ground whose trees are instanced together; 0: all are "
        "(default 100)")
        ->type_name("METRES");
    add_scene_overrides(app, command.overrides, "--size");
    constexpr std::uint64_t kMostFrames = 10'000;
    add_parsed(app, "--frames", command.frames, whole(0, kMostFrames),
               "Write the forest of domination so many times while it grows, as a numbered series")
        ->type_name("N")
        ->group("Placement");
    add_parsed(app, "--sides", command.mesh.sides, whole(kMinSides, kMaxSides),
               "Sides of every cross-section, instead of the grammar's")
        ->type_name("N")
        ->group("Mesh");
    constexpr std::uint64_t kMaxLevel = 8;
    add_parsed(app, "--level", command.mesh.level, whole(0, kMaxLevel),
               "Level of detail, 0 the finest (default 0)")
        ->type_name("K")
        ->group("Mesh");
    add_parsed(app, "--droop", command.mesh.droop, fraction,
               "Bending of leaves by gravity, 0 to 1 (default 0)")
        ->type_name("D")
        ->group("Mesh");
    add_grammar(app, command.overrides.grammar, command.run);
    add_seed(app, command.overrides.seed);
    add_run_limits(app, command.run);
    add_message_options(app, command.messages);
    add_deny(app, command.messages);
    app.footer("Options take the place of what the scene says; -n, -D and the options of instances "
               "are for every\nspecies. samples/scenes shows scenes.\n"
               "Examples: lsc forest wood.toml -o wood.glb\n"
               "          lsc forest oak.lsys birch.lsys --count 10000 --size 500 -o wood.glb\n"
               "          lsc forest wood.toml --stats\n"
               "          lsc forest pine.lsys --placement jittered --spacing 4 --tile 0,1,100 -o "
               "tile.glb");
}

void add_import(CLI::App& app, ImportCommand& command) {
    app.add_option("FILE", command.file, "A grammar of another dialect; `-` is standard input");
    app.add_option("--all", command.folder, "Import every grammar of a folder instead")
        ->type_name("FOLDER");
    app.add_option("-o,--output", command.output,
                   "The .lsys file, or the folder for --all or for each system of a file that "
                   "holds several; `-` is standard output (default: standard output; with --all "
                   "beside the originals)")
        ->type_name("FILE");
    app.add_flag("-f,--force", command.force,
                 "Replace files in a folder that are there already; without it they stay, with "
                 "exit status 2");
    add_grammar(app, command.grammar, command.run);
    add_message_options(app, command.messages);
    add_deny(app, command.messages);
    app.footer("What is written derives the same word.\n"
               "Example: lsc import tree.l -o tree.lsys");
}

void add_stats(CLI::App& app, StatsCommand& command) {
    app.add_option("FILE", command.file, "A grammar or a .lsb file; `-` is standard input")
        ->required();
    add_grammar(app, command.grammar, command.run);
    add_message_options(app, command.messages);
    add_deny(app, command.messages);
    app.footer(
        "Predicts the size of every generation without deriving; where a grammar decomposes or "
        "cuts off,\nwords are derived and counted. With --message-format json the table is "
        "JSON too.\nExample: lsc stats -n 12 tree.lsys");
}

void add_format(CLI::App& app, FormatCommand& command) {
    app.add_option("FILE", command.files,
                   "Grammars; `-` reads standard input, writes standard "
                   "output")
        ->required();
    app.add_flag("--check", command.check,
                 "Change nothing; name the files that are not formatted, with exit status 1");
    add_dialect(app, command.dialect);
    add_message_options(app, command.messages);
    app.footer(
        "Statements of one kind get columns, long lines are broken; comments, line ends between "
        "modules\nand the meaning stay. Example: lsc fmt --check *.lsys");
}

void add_explain(CLI::App& app, ExplainCommand& command) {
    app.add_option("CODE", command.code,
                   "What stands in brackets at the end of a message; without it, all are listed");
    add_message_options(app, command.messages);
    app.footer("Example: lsc explain look-alike");
}

/// The command of that name, or nothing.
const CLI::App* find_command(const CLI::App& app, const std::string& name) {
    for (const CLI::App* command : app.get_subcommands({})) {
        if (command->get_name() == name) {
            return command;
        }
    }
    return nullptr;
}

/// A first argument that is no command.
std::optional<UsageError> unknown_command(std::span<const std::string> arguments,
                                          const CLI::App& app) {
    if (arguments.empty()) {
        return UsageError{"no command is given", kListHint};
    }
    const std::string& first = arguments.front();
    if (first.starts_with('-') || find_command(app, first) != nullptr) {
        return std::nullopt;
    }
    std::vector<std::string_view> names;
    for (const CLI::App* command : app.get_subcommands({})) {
        names.push_back(command->get_name());
    }
    UsageError usage{fmt::format("`{}` is not a command", first), kListHint};
    if (const auto nearest = nearest_name(first, names)) {
        usage.help = fmt::format("did you mean `lsc {}`?", *nearest);
    }
    return usage;
}

} // namespace

CommandLine parse_command_line(std::span<const std::string> arguments) {
    CLI::App app("Compiles and derives L-systems: grammars of plants, curves and other growing "
                 "things.",
                 "lsc");
    app.set_version_flag("--version", "lsc " LSC_VERSION, "Print the version and exit");
    app.require_subcommand(1);
    app.footer("`lsc COMMAND --help` says more of each.");
    // Only the command that runs gets its options.
    const std::string first = arguments.empty() ? std::string() : arguments.front();
    CommandLine parsed = UsageError{"no command is given", kListHint};
    const auto add = [&]<typename Command>(const char* name, const char* text,
                                           void (*add_options)(CLI::App&, Command&)) {
        CLI::App& added = *app.add_subcommand(name, text);
        if (first == name) {
            add_options(added, parsed.emplace<Command>());
        }
    };
    add("check", "Check grammars, and mend what is certain", add_check);
    add("compile", "Compile a grammar to a .lsb file", add_compile);
    add("dump", "Derive a word and print it", add_dump);
    add("export", "Write one plant as a 3D file or a drawing", add_export);
    add("forest", "Grow a forest of distinct plants from a few, and write it", add_forest);
    add("import", "Make a .lsys file of a grammar of another dialect", add_import);
    add("stats", "Predict the size of every generation", add_stats);
    add("fmt", "Lay out grammars in the common style", add_format);
    add("explain", "Explain a diagnostic, with examples", add_explain);

    if (std::optional<UsageError> usage = unknown_command(arguments, app)) {
        return *usage;
    }
    const CLI::App* command = find_command(app, arguments.front());
    try {
        std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());
        app.parse(std::move(reversed));
    } catch (const CLI::CallForHelp&) {
        return PrintText{command == nullptr ? app.help() : command->help("lsc")};
    } catch (const CLI::CallForVersion&) {
        return PrintText{"lsc " LSC_VERSION "\n"};
    } catch (const CLI::ParseError& error) {
        return describe(error, command == nullptr ? app : *command,
                        command == nullptr ? "lsc" : "lsc " + command->get_name());
    }
    return parsed;
}

} // namespace lsys::lsc
