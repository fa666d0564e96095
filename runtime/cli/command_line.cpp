#include "runtime/cli/command_line.h"

#include "grammar/diagnostic.h"
#include "grammar/dialect.h"
#include "runtime/cli/arguments.h"
#include "runtime/cli/option_parsers.h"
#include "runtime/turtle.h"

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

void add_messages(CLI::App& app, MessageOptions& options) {
    app.set_version_flag("--version", "lsc " LSC_VERSION, "Print the version and exit");
    add_choice<MessageFormat>(app, "--message-format", options.format,
                              {{"human", MessageFormat::Human},
                               {"short", MessageFormat::Short},
                               {"json", MessageFormat::Json}},
                              "How messages are written (default human)")
        ->group("Messages");
    add_choice<ColourMode>(
        app, "--color", options.colour,
        {{"auto", ColourMode::Auto}, {"always", ColourMode::Always}, {"never", ColourMode::Never}},
        "Colour in messages; auto: on a terminal (default auto)")
        ->group("Messages");
    app.add_flag("-q,--quiet", options.quiet, "Errors only")->group("Messages");
    app.add_flag("-v,--verbose", options.verbose, "Say what is done")->group("Messages");
}

void add_deny(CLI::App& app, MessageOptions& options) {
    add_choice<bool>(app, "--deny", options.deny_warnings, {{"warnings", true}},
                     "Take every warning for an error")
        ->group("Messages");
}

void add_dialect(CLI::App& app, std::string& dialect) {
    std::vector<std::pair<std::string, std::string>> names;
    for (const DialectRow& row : dialects()) {
        names.emplace_back(row.name, row.name);
    }
    add_choice<std::string>(app, "--dialect", dialect, std::move(names),
                            "The language of the file (default: what it holds and its name tell)")
        ->group("Grammar");
}

void add_grammar(CLI::App& app, GrammarOptions& options) {
    add_parsed(app, "-n,--generations", options.generations, whole(0, kMaxGenerations),
               "Generations, instead of #n")
        ->type_name("N")
        ->group("Grammar");
    app.add_option_function<std::vector<std::string>>(
           "-D,--define",
           [&options](const std::vector<std::string>& texts) {
               for (const std::string& text : texts) {
                   Result<Definition> definition = parse_definition(text);
                   if (!definition) {
                       throw CLI::ValidationError("--define", definition.error().message);
                   }
                   for (const Definition& known : options.definitions) {
                       if (known.name == definition.value().name) {
                           throw CLI::ValidationError(
                               "--define", fmt::format("`{}` is given twice", known.name));
                       }
                   }
                   options.definitions.push_back(std::move(definition.value()));
               }
           },
           "The value of a #define or #param; may be repeated")
        ->type_name("NAME=NUMBER")
        ->allow_extra_args(false)
        ->group("Grammar");
    add_dialect(app, options.dialect);
    app.add_flag("--bug-compatible", options.bug_compatible,
                 "Keep the bugs of the program that owns the dialect (l3d, lplus), its random "
                 "numbers and surfaces too")
        ->group("Grammar");
    app.add_option("--system", options.system,
                   "Which system of a file that holds several (default: the only one)")
        ->type_name("NAME")
        ->group("Grammar");
    add_parsed(app, "--max-modules", options.max_modules,
               whole(1, std::numeric_limits<std::uint64_t>::max()),
               "The most modules a word may have (default 4294967296)")
        ->type_name("N")
        ->group("Limits");
}

void add_seed(CLI::App& app, std::optional<std::uint64_t>& seed) {
    add_parsed(app, "-s,--seed", seed, whole(0, std::numeric_limits<std::uint64_t>::max()),
               "Seed of all random numbers, instead of `#set seed` (default 0)")
        ->type_name("S")
        ->group("Grammar");
}

void add_run_limits(CLI::App& app, std::uint64_t& max_bytes, std::uint32_t& threads) {
    max_bytes = half_of_memory();
    add_parsed(
        app, "--max-memory", max_bytes, parse_size,
        "The most memory each of word, skeleton and mesh may take: 500M, 2G (default half of "
        "the machine's)")
        ->type_name("SIZE")
        ->group("Limits");
    constexpr std::uint64_t kMaxThreads = 1024;
    add_parsed(app, "--threads", threads, whole(1, kMaxThreads),
               "Threads to work with; the result is the same (default all cores)")
        ->type_name("N")
        ->group("Limits");
}

void add_mesh(CLI::App& app, MeshOptions& mesh) {
    add_choice<MeshMethod>(app, "--method", mesh.method,
                           {{"tubes", MeshMethod::Tubes},
                            {"cylinders", MeshMethod::Cylinders},
                            {"boxes", MeshMethod::Boxes}},
                           "Branches as tubes without joints, as a cylinder a segment, or as "
                           "joined boxes that are smoothed (default tubes)")
        ->group("Mesh");
    add_parsed(app, "--sides", mesh.sides, whole(kMinSides, kMaxSides),
               "Sides of every cross-section, instead of the grammar's")
        ->type_name("N")
        ->group("Mesh");
    constexpr std::uint64_t kMaxLevel = 8;
    add_parsed(app, "--level", mesh.level, whole(0, kMaxLevel),
               "Level of detail: 0 the finest, each next one with about half the sides (default 0)")
        ->type_name("K")
        ->group("Mesh");
    constexpr float kMaxDeviation = 1000.0F;
    add_parsed(
        app, "--deviation", mesh.deviation,
        [](const std::string& text) { return parse_number(text, 0.0F, kMaxDeviation); },
        "Give each ring of a tube only the sides that keep it so near to its circle; 0: all "
        "(default 0)")
        ->type_name("METRES")
        ->group("Mesh");
    constexpr std::uint64_t kMaxSubdivisions = 5;
    add_parsed(app, "--subdivisions", mesh.subdivisions, whole(0, kMaxSubdivisions),
               "Rounds of smoothing of --method boxes (default 2)")
        ->type_name("N")
        ->group("Mesh");
    add_parsed(app, "--bark-noise", mesh.bark_noise, fraction,
               "Unevenness of the bark, as part of the radius, 0 to 1 (default 0)")
        ->type_name("A")
        ->group("Mesh");
    add_parsed(app, "--droop", mesh.droop, fraction,
               "Bending of leaves by gravity, 0 to 1 (default 0)")
        ->type_name("D")
        ->group("Mesh");
}

UsageError describe(const CLI::ParseError& error, const CLI::App& app, const std::string& command) {
    UsageError usage;
    usage.help = fmt::format("`{} --help` lists what may be written", command);
    usage.message = error.what();
    const auto is = [&](CLI::ExitCodes code) {
        return error.get_exit_code() == static_cast<int>(code);
    };
    if (is(CLI::ExitCodes::ExtrasError)) {
        const std::vector<std::string> extras = app.remaining(true);
        const std::string extra = extras.empty() ? std::string() : extras.front();
        usage.message = extra.starts_with('-') ? fmt::format("unknown option `{}`", extra)
                                               : fmt::format("unexpected argument `{}`", extra);
        std::vector<std::string> names;
        for (const CLI::Option* option : app.get_options()) {
            for (const std::string& name : option->get_lnames()) {
                names.push_back("--" + name);
            }
        }
        const std::vector<std::string_view> candidates(names.begin(), names.end());
        if (const auto nearest = nearest_name(extra, candidates)) {
            usage.help = fmt::format("did you mean `{}`?", *nearest);
        }
    } else if (is(CLI::ExitCodes::RequiredError)) {
        usage.message =
            fmt::format("{} is missing", usage.message.substr(0, usage.message.find(' ')));
    }
    return usage;
}

namespace {

/// Every command's options while they are parsed.
struct AllCommands {
    ImportCommand imported;
    CheckCommand check;
    CompileCommand compile;
    DumpCommand dump;
    ExportCommand exported;
    ForestCommand forest;
    StatsCommand stats;
    FormatCommand format;
    ExplainCommand explain;
};

void add_check(CLI::App& app, CheckCommand& command) {
    app.add_option("FILE", command.files, "Grammars; `-` is standard input")->required();
    app.add_flag("--fix", command.fix, "Apply every repair that is certain to the files");
    add_grammar(app, command.grammar);
    add_messages(app, command.messages);
    add_deny(app, command.messages);
    app.footer("A repair is certain where nothing else can have been meant and its statement is\n"
               "right afterwards. Others are shown as help.\n"
               "Exit status: 0 no errors, 1 errors in a grammar, 2 a file or the command line.\n"
               "Example: lsc check --fix tree.lsys");
}

void add_compile(CLI::App& app, CompileCommand& command) {
    app.add_option("FILE", command.file, "The grammar; `-` is standard input")->required();
    app.add_option("-o,--output", command.output, "The .lsb file; `-` is standard output")
        ->required()
        ->type_name("FILE");
    add_grammar(app, command.grammar);
    add_seed(app, command.seed);
    add_messages(app, command.messages);
    add_deny(app, command.messages);
    app.footer("-n and --seed take the place of #n and `#set seed` in what is written.\n"
               "Example: lsc compile tree.lsys -o tree.lsb");
}

void add_dump(CLI::App& app, DumpCommand& command) {
    app.add_option("FILE", command.file, "A grammar or a .lsb file; `-` is standard input")
        ->required();
    app.add_option("-o,--output", command.output, "Where to write (default standard output)")
        ->type_name("FILE");
    add_choice<Stage>(app, "--stage", command.stage,
                      {{"tokens", Stage::Tokens},
                       {"ast", Stage::Ast},
                       {"program", Stage::Program},
                       {"instanced", Stage::Instanced},
                       {"bytecode", Stage::Bytecode},
                       {"word", Stage::Word},
                       {"skeleton", Stage::Skeleton},
                       {"mesh", Stage::Mesh}},
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
    add_grammar(app, command.grammar);
    add_seed(app, command.seed);
    add_run_limits(app, command.max_bytes, command.threads);
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
    add_messages(app, command.messages);
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
    add_choice<std::optional<ExportFormat>>(app, "--format", command.format,
                                            {{"obj", ExportFormat::Obj},
                                             {"ply", ExportFormat::Ply},
                                             {"off", ExportFormat::Off},
                                             {"off+", ExportFormat::OffPlus},
                                             {"stl", ExportFormat::Stl},
                                             {"gltf", ExportFormat::Gltf},
                                             {"glb", ExportFormat::Glb},
                                             {"svg", ExportFormat::Svg},
                                             {"usda", ExportFormat::Usda}},
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
    add_parsed(app, "--frames", command.frames, whole(1, kMaxFrames),
               "The plant at N moments: glb and gltf hold them as one animation, of other formats "
               "there is a numbered file for each: tree.0001.ply, tree.0002.ply, ...")
        ->type_name("N")
        ->group("Physics");
    const auto rate = [](const std::string& text) { return parse_number(text, 0.1F, 1000.0F); };
    add_parsed(app, "--fps", command.frames_per_second, rate, "Frames a second (default 24)")
        ->type_name("F")
        ->group("Physics");
    add_grammar(app, command.grammar);
    add_seed(app, command.seed);
    add_run_limits(app, command.max_bytes, command.threads);
    add_messages(app, command.messages);
    add_deny(app, command.messages);
    app.footer(
        "Metres, +Y up. The file is complete or absent. OBJ gets a .mtl beside it, OBJ and USDA "
        "get "
        "pictures\nof bark and leaves, as tree.bark.png; standard output gets neither. SVG is the "
        "drawing in the plane\nof X and Y. A skin has at most 65,535 joints that move.\n"
        "Examples: lsc export tree.lsys -o tree.glb\n"
        "          lsc export tree.lsys -o tree.glb --wind 8,0,0,0.5 --frames 48 --fps 24");
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
    add_grammar(app, command.grammar);
    add_messages(app, command.messages);
    add_deny(app, command.messages);
    app.footer("What is written derives the same word.\n"
               "Example: lsc import tree.l -o tree.lsys");
}

void add_stats(CLI::App& app, StatsCommand& command) {
    app.add_option("FILE", command.file, "A grammar or a .lsb file; `-` is standard input")
        ->required();
    add_grammar(app, command.grammar);
    add_messages(app, command.messages);
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
    add_messages(app, command.messages);
    app.footer(
        "Statements of one kind get columns, long lines are broken; comments, line ends between "
        "modules\nand the meaning stay. Example: lsc fmt --check *.lsys");
}

void add_explain(CLI::App& app, ExplainCommand& command) {
    app.add_option("CODE", command.code,
                   "What stands in brackets at the end of a message; without it, all are listed");
    add_messages(app, command.messages);
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
        return UsageError{"no command is given", "`lsc --help` lists the commands"};
    }
    const std::string& first = arguments.front();
    if (first.starts_with('-') || find_command(app, first) != nullptr) {
        return std::nullopt;
    }
    std::vector<std::string_view> names;
    for (const CLI::App* command : app.get_subcommands({})) {
        names.push_back(command->get_name());
    }
    UsageError usage{fmt::format("`{}` is not a command", first),
                     "`lsc --help` lists the commands"};
    if (const auto nearest = nearest_name(first, names)) {
        usage.help = fmt::format("did you mean `lsc {}`?", *nearest);
    }
    return usage;
}

} // namespace

CommandLine parse_command_line(std::span<const std::string> arguments) {
    AllCommands all;
    CLI::App app("Compiles and derives L-systems: grammars of plants, curves and other growing "
                 "things.",
                 "lsc");
    app.set_version_flag("--version", "lsc " LSC_VERSION, "Print the version and exit");
    app.require_subcommand(1);
    app.footer("`lsc COMMAND --help` says more of each.");
    // The options of a command are made only where it is the one that is run.
    const std::string first = arguments.empty() ? std::string() : arguments.front();
    const auto add = [&](const char* name, const char* text, auto& command,
                         auto&& add_options) -> CLI::App& {
        CLI::App& added = *app.add_subcommand(name, text);
        if (first == name) {
            add_options(added, command);
        }
        return added;
    };
    CLI::App& check =
        add("check", "Check grammars, and mend what is certain", all.check, add_check);
    CLI::App& compile =
        add("compile", "Compile a grammar to a .lsb file", all.compile, add_compile);
    CLI::App& dump = add("dump", "Derive a word and print it", all.dump, add_dump);
    CLI::App& exported =
        add("export", "Write one plant as a 3D file or a drawing", all.exported, add_export);
    CLI::App& forest = add("forest", "Grow a forest of distinct plants from a few, and write it",
                           all.forest, add_forest);
    CLI::App& imported = add("import", "Make a .lsys file of a grammar of another dialect",
                             all.imported, add_import);
    CLI::App& stats = add("stats", "Predict the size of every generation", all.stats, add_stats);
    CLI::App& format = add("fmt", "Lay out grammars in the common style", all.format, add_format);
    add("explain", "Explain a diagnostic, with examples", all.explain, add_explain);

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
    if (check.parsed()) {
        return std::move(all.check);
    }
    if (compile.parsed()) {
        return std::move(all.compile);
    }
    if (dump.parsed()) {
        return std::move(all.dump);
    }
    if (exported.parsed()) {
        return std::move(all.exported);
    }
    if (forest.parsed()) {
        return std::move(all.forest);
    }
    if (imported.parsed()) {
        return std::move(all.imported);
    }
    if (stats.parsed()) {
        return std::move(all.stats);
    }
    if (format.parsed()) {
        return std::move(all.format);
    }
    return std::move(all.explain);
}

} // namespace lsys::lsc
