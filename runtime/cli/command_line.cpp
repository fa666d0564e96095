// SPDX-License-Identifier: MIT
#include "runtime/cli/command_line.h"

#include "grammar/base/diagnostic.h"
#include "grammar/base/paths.h"
#include "grammar/dialects/dialect.h"
#include "runtime/cli/tile_options.h"
#include "runtime/meshing/detail_levels.h"
#include "runtime/output/file_option_parsers.h"
#include "runtime/output/presets.h"
#include "runtime/program/arguments.h"
#include "runtime/program/find_option.h"
#include "runtime/program/memory_size.h"
#include "runtime/program/option_parsers.h"
#include "runtime/program/policy_options.h"
#include "runtime/scene/scene.h"
#include "runtime/turtle/turtle.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace lsys::lsc {

namespace {

constexpr const char* kListHint = "`lsc --help` lists the commands";

void add_policy(CLI::App& app, RunOptions& run) {
    add_file_policy(app, run, Trust::Trusted);
    add_run_policy(app, run);
}

void add_check(CLI::App& app, CheckCommand& command) {
    app.add_option("FILE", command.files, "Grammars; `-` is standard input")->required();
    app.add_flag("--fix{certain}", command.fix,
                 "Apply all certain repairs to FILE and to files included from its folder or "
                 "below; --fix=offered also applies uncertain repairs")
        ->type_name("")
        ->check([](const std::string& choice) {
            return choice == "certain" || choice == "offered"
                       ? std::string()
                       : fmt::format("`{}` is neither certain nor offered", choice);
        });
    app.add_flag("--diff", command.diff,
                 "With --fix: print the repairs as a unified diff, and write no file")
        ->needs(find_option(app, "--fix"));
    app.add_flag("--part", command.part,
                 "FILE is a part that other grammars include: no axiom is missing, and names may "
                 "be defined elsewhere (default: whether a grammar in its folder or the one above "
                 "includes it)");
    add_grammar(app, command.grammar, command.run);
    add_base_option(app, command.run);
    add_policy(app, command.run);
    add_message_options(app, command.messages);
    add_levels(app, command.messages);
    app.footer(
        "A repair is certain if no other is plausible and its statement is correct "
        "afterwards; other\n"
        "repairs are shown as help. --fix changes only named files and files in the folder of "
        "FILE or below\n"
        "(symbolic links resolved). A grammar and its included files are all written, or "
        "none.\n"
        "Exit status: 0 no errors, 1 errors in a grammar, 2 file or command line error, 3 "
        "limit reached.\n"
        "Example: lsc check --fix tree.lsys");
}

void add_compile(CLI::App& app, CompileCommand& command) {
    command.run.limits.max_bytes = half_of_memory();
    app.add_option("FILE", command.file, "The grammar; `-` is standard input")->required();
    app.add_option("-o,--output", command.output, "The .lsb file; `-` is standard output")
        ->required()
        ->type_name("FILE");
    add_grammar(app, command.grammar, command.run);
    add_base_option(app, command.run);
    add_seed(app, command.seed);
    add_policy(app, command.run);
    add_message_options(app, command.messages);
    add_levels(app, command.messages);
    app.footer("-n, --seed and --set replace #n, `#set seed` and other #set in the output.\n"
               "Example: lsc compile tree.lsys -o tree.lsb");
}

/// Adds the options of --stage instanced, heroes and cache.
void add_dump_instancing(CLI::App& app, DumpCommand& command) {
    const char* const group = "Instances";
    add_parsed(app, "--rho", command.rho, fraction,
               "For --stage instanced, heroes and cache: probability that a branch is an instance "
               "(default 0.6)")
        ->type_name("P")
        ->group(group);
    constexpr std::uint64_t kAny = std::numeric_limits<std::uint64_t>::max();
    add_parsed(app, "--first", command.first, integer(0, kAny),
               "For --stage instanced: the first form to list of each production (default 0)")
        ->type_name("K")
        ->group(group);
    add_parsed(app, "--rows", command.rows, integer(1, kAny),
               "For --stage instanced: number of forms to list of each production (default 4096)")
        ->type_name("N")
        ->group(group);
    add_parsed(app, "--heroes", command.heroes, integer(1, kMaxHeroes),
               "For --stage heroes and cache: plants derived in full (default 10)")
        ->type_name("H")
        ->group(group);
    add_parsed(app, "--cache-cap", command.cache_cap,
               integer(0, std::numeric_limits<std::uint32_t>::max()),
               "For --stage cache: maximum number of branches per key; 0: no limit (default 0)")
        ->type_name("N")
        ->group(group);
    add_parsed(app, "--instance-tolerance", command.tolerance, fraction,
               "For --stage cache: relative difference of values that share a key (default 0)")
        ->type_name("T")
        ->group(group);
}

void add_dump(CLI::App& app, DumpCommand& command) {
    app.add_option("FILE", command.file, "A grammar or a .lsb file; `-` is standard input")
        ->required();
    app.add_option("-o,--output", command.output, "Output file (default standard output)")
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
         {"mesh", DumpStage::Mesh},
         {"heroes", DumpStage::Heroes},
         {"cache", DumpStage::Cache},
         {"environment", DumpStage::Environment}},
        "Output of a compiler stage, the derived word, its skeleton or its mesh, the words of the "
        "heroes of a forest or the branches recorded from them, or what the plant sensed last "
        "(default word)");
    add_choice<std::optional<EnvironmentFormat>>(
        app, "--format", command.environment_format,
        {{"json", EnvironmentFormat::Json}, {"ply", EnvironmentFormat::Ply}},
        "For --stage environment: places, answers, voxels and markers as JSON, or as a PLY file of "
        "points (default json)");
    app.add_flag("--all", command.all, "Print every generation, one per line");
    app.add_flag("--count", command.count,
                 "Print the number of modules, from the growth matrix where possible; of --stage "
                 "heroes for each hero");
    app.add_flag("--stream", command.stream,
                 "Derive without storing the word (no contexts, parallel rewriting only)");
    app.add_flag("--origins", command.origins,
                 "Print the origin of each module or part of the skeleton: production or axiom, "
                 "place, generation");
    add_mesh(app, command.mesh);
    describe_detail_levels(app);
    add_dump_instancing(app, command);
    add_grammar(app, command.grammar, command.run);
    add_base_option(app, command.run);
    add_seed(app, command.seed);
    add_height(app, command.height);
    add_run_limits(app, command.run);
    add_environments(app, command.run);
    add_parsed(app, "--steps", command.steps, integer(0, kMaxGenerations),
               "Derive only K generations in this run")
        ->type_name("K")
        ->group("Saved states");
    app.add_option("--save-state", command.save_state, "Save the state of the derivation")
        ->type_name("FILE")
        ->group("Saved states");
    app.add_option("--from", command.from, "Continue from a saved state")
        ->type_name("FILE")
        ->group("Saved states");
    add_policy(app, command.run);
    add_message_options(app, command.messages);
    add_levels(app, command.messages);
    app.footer("Examples: lsc dump -n 3 tree.lsys\n"
               "          lsc dump --all --count tree.lsys\n"
               "          lsc dump -n 10 --steps 5 --save-state half.lss --count tree.lsys\n"
               "          lsc dump --from half.lss tree.lsys\n"
               "          lsc dump --stage skeleton --origins tree.lsys\n"
               "          lsc dump --stage heroes --heroes 2 tree.lsys\n"
               "          lsc dump --stage environment --format ply -o light.ply tree.lsys");
}

/// Parses `season=0,0.5`: a name and several numbers.
Result<VariantValues> parse_variants(const std::string& text) {
    VariantValues variants;
    const std::size_t equals = std::min(text.find('='), text.size());
    variants.name = text.substr(0, equals);
    for (std::size_t at = equals; at < text.size();) {
        const std::size_t end = std::min(text.find(',', at + 1), text.size());
        variants.texts.push_back(text.substr(at + 1, end - at - 1));
        at = end;
        const Result<Definition> value =
            parse_definition(fmt::format("{}={}", variants.name, variants.texts.back()));
        if (!value) {
            return value.error();
        }
        if (std::find(variants.values.begin(), variants.values.end(), value.value().value) !=
            variants.values.end()) {
            return Error{fmt::format("`{}` is given twice", variants.texts.back())};
        }
        variants.values.push_back(value.value().value);
    }
    if (variants.values.size() < 2) {
        return Error{
            fmt::format("`{}` is not NAME=NUMBER,NUMBER,... with two numbers or more", text)};
    }
    return variants;
}

void add_export(CLI::App& app, ExportCommand& command) {
    app.add_option("FILE", command.file, "A grammar or a .lsb file; `-` is standard input")
        ->required();
    app.add_option("-o,--output", command.output, "Output file; `-` is standard output")
        ->required()
        ->type_name("FILE");
    add_plant_form(app, command);
    app.add_flag("--stream", command.stream,
                 "Draw without storing the word (no contexts, parallel rewriting only)");
    app.add_flag("--stats", command.stats,
                 "Print counts, sizes and times; with --message-format json as one JSON object");
    add_plant_mesh(app, command);
    add_parsed(
        app, "--variants", command.variants, parse_variants,
        fmt::format("Write a plant for each value of a #define or #param into one file, as "
                    "variants of a set with its name ({}); the first is shown unless another is "
                    "selected",
                    format_names("and", [](const FormatTraits& format) { return format.variants; }))
            .c_str())
        ->type_name("NAME=NUMBER,NUMBER,...");
    add_plant_motion(app, command);
    add_grammar(app, command.grammar, command.run);
    add_base_option(app, command.run);
    add_seed(app, command.seed);
    add_height(app, command.height);
    add_run_limits(app, command.run);
    add_environments(app, command.run);
    add_policy(app, command.run);
    add_message_options(app, command.messages);
    add_levels(app, command.messages);
    app.footer(
        "Presets:\n" + preset_table(PresetCommand::Export) +
        "To clear a flag that a preset sets, write `--wind-data=false`.\n\n"
        "Units are metres and +Y is up, unless --unit and --up say otherwise. The output is "
        "complete or\n"
        "absent. OBJ writes a .mtl file beside it, OBJ and USDA write bark and leaf textures\n"
        "(tree.bark.png); none of these with standard output. SVG is\n"
        "the projection to the XY plane. A skin has at most 65,535 moving joints.\n"
        "Examples: lsc export tree.lsys -o tree.glb\n"
        "          lsc export tree.lsys -o tree.glb --wind 8,0,0,0.5 --frames 97 --loop\n"
        "          lsc export tree.lsys -o tree.glb --grow --frames 100\n"
        "          lsc export tree.lsys -o tree.usdz --variants season=0,0.25,0.5,0.75");
}

void add_forest(CLI::App& app, ForestCommand& command) {
    app.add_option("FILE", command.files, "A scene (.toml), or one grammar per species")
        ->required();
    const auto has_instances = [](const FormatTraits& format) {
        return format.write_forest != nullptr;
    };
    app.add_option("-o,--output", command.output,
                   fmt::format("Output file: {} with instances, json statistics; with --bake also "
                               "{}",
                               format_names("or", has_instances),
                               format_names("or",
                                            [&](const FormatTraits& format) {
                                                return format.uses_mesh && !has_instances(format);
                                            })))
        ->type_name("FILE");
    add_preset(app, PresetCommand::Forest, command.preset);
    app.add_flag("--check", command.check, "Check the scene and its grammars, write nothing");
    app.add_flag("--stats", command.stats,
                 "Print counts of trees, distinct trees, branches and cached instances");
    add_forest_form(app, command);
    add_scene_overrides(app, command.overrides, "--size");
    add_tree_height(app, command.overrides.height);
    add_forest_mesh(app, command);
    add_grammar(app, command.overrides.grammar, command.run);
    add_seed(app, command.overrides.seed);
    add_run_limits(app, command.run);
    add_environments(app, command.run);
    add_policy(app, command.run);
    add_message_options(app, command.messages);
    add_levels(app, command.messages);
    app.footer(
        "Presets:\n" + preset_table(PresetCommand::Forest) +
        "\nOptions override the scene; -n, -D, --set and the options of instances apply to every "
        "species.\n"
        "samples/scenes has example scenes.\n"
        "Examples: lsc forest wood.toml -o wood.glb\n"
        "          lsc forest oak.lsys birch.lsys --count 10000 --size 500 -o wood.glb\n"
        "          lsc forest wood.toml --instances trees --heroes 5 --compress meshopt -o "
        "wood.glb\n"
        "          lsc forest wood.toml --stats\n"
        "          lsc forest pine.lsys --placement jittered --spacing 4 --tile 0,1,100 -o "
        "tile.glb");
}

void add_import(CLI::App& app, ImportCommand& command) {
    app.add_option("FILE", command.file, "A grammar of another dialect; `-` is standard input");
    app.add_option("--all", command.folder, "Import all grammars of a folder and its sub-folders")
        ->type_name("FOLDER");
    app.add_option("-o,--output", command.output,
                   "Output file, or a folder for --all and for all systems of FILE; `-` is "
                   "standard output (default: standard output; with --all beside the originals)")
        ->type_name("FILE");
    app.add_flag("-f,--force", command.force,
                 "Replace existing files of the output folder; otherwise they stay and the exit "
                 "status is 2");
    add_grammar(app, command.grammar, command.run);
    add_base_option(app, command.run);
    add_policy(app, command.run);
    add_message_options(app, command.messages);
    add_levels(app, command.messages);
    app.footer("The output derives the same word as the input; -n becomes its #n, -D the values of "
               "its\n#define, and --set those of its #set.\n"
               "Example: lsc import tree.l -o tree.lsys");
}

void add_stats(CLI::App& app, StatsCommand& command) {
    command.run.limits.max_bytes = half_of_memory();
    app.add_option("FILE", command.file, "A grammar or a .lsb file; `-` is standard input")
        ->required();
    const auto gravity = [](const std::string& text) { return parse_number(text, 0.0F, 1e6F); };
    add_parsed(app, "--gravity", command.gravity, gravity,
               "Draw the plant too, and tell whether it bears its weight (9.81 on Earth)")
        ->type_name("G");
    app.add_flag("--parameters", command.parameters,
                 "List the values that -D can change, with their bounds, instead of sizes");
    add_grammar(app, command.grammar, command.run);
    add_base_option(app, command.run);
    add_height(app, command.height);
    add_policy(app, command.run);
    add_message_options(app, command.messages);
    add_levels(app, command.messages);
    app.footer("Sizes are predicted from the growth matrix; grammars with `#decompose` or `%` are "
               "derived and\n"
               "counted. A plant of at most a million modules is drawn too, and its height "
               "printed. With\n--message-format json the table is JSON.\n"
               "Examples: lsc stats -n 12 tree.lsys\n"
               "          lsc stats --parameters tree.lsys");
}

void add_trace(CLI::App& app, TraceCommand& command) {
    app.add_option("FILE", command.file, "A grammar or a .lsb file; `-` is standard input")
        ->required();
    app.add_option("-o,--output", command.output, "Output file (default standard output)")
        ->type_name("FILE");
    constexpr std::uint64_t kAny = std::numeric_limits<std::uint64_t>::max();
    add_parsed(app, "--at", command.position, integer(0, kAny),
               "Trace the module at this position of the word, from 0")
        ->type_name("POSITION");
    app.add_option("--module", command.module,
                   "Trace the first module that is exactly this one, such as 'A(3)'")
        ->type_name("MODULE");
    app.add_option("--all", command.name, "Trace the modules of this name, with any parameters")
        ->type_name("NAME");
    add_parsed(app, "--rows", command.rows, integer(1, kAny),
               "Number of modules that --all traces (default 10)")
        ->type_name("N");
    app.add_flag("--written", command.written,
                 "Trace the step that wrote the module, instead of the one that rewrites it");
    app.add_flag("--back", command.back,
                 "Follow the module back to the axiom, generation by generation");
    add_choice<std::optional<TraceFormat>>(
        app, "--format", command.format, {{"text", TraceFormat::Text}, {"json", TraceFormat::Json}},
        "Form of the output (default text)");
    add_grammar(app, command.grammar, command.run);
    add_base_option(app, command.run);
    add_seed(app, command.seed);
    add_run_limits(app, command.run);
    add_environments(app, command.run);
    add_policy(app, command.run);
    add_message_options(app, command.messages);
    add_levels(app, command.messages);
    app.footer(
        "Lists every production tried for a module of generation N in the next generation, "
        "with the reason\n"
        "why it applies or not and the modules it writes; for the last word also the modules "
        "drawn. -n N is\n"
        "the generation of the module; steps() is #n, or N if that is more.\n"
        "Examples: lsc trace tree.lsys -n 3 --at 17\n"
        "          lsc trace tree.lsys -n 3 --module 'A(3)'\n"
        "          lsc trace tree.lsys -n 3 --all A --rows 2 --format json\n"
        "          lsc trace tree.lsys --at 100 --written\n"
        "          lsc trace tree.lsys --at 100 --back");
}

void add_format(CLI::App& app, FormatCommand& command) {
    app.add_option("FILE", command.files, "Grammars; `-` formats standard input to standard output")
        ->required();
    app.add_flag("--check", command.check,
                 "Write nothing; list unformatted files and exit with status 1");
    add_dialect(app, command.dialect);
    add_policy(app, command.run);
    add_message_options(app, command.messages);
    app.footer("Aligns statements of a kind in columns and breaks long lines; keeps comments, the "
               "line ends\n"
               "between modules and the meaning.\n"
               "Example: lsc fmt --check *.lsys");
}

void add_lsp(CLI::App& app, LspCommand& command) {
    // Clients of other servers pass this option; standard input and output are used anyway.
    app.add_flag("--stdio", command.stdio, "Use standard input and output, as always");
    add_file_policy(app, command.run, Trust::Trusted);
    app.footer("Reads and writes messages of the Language Server Protocol 3.17. Editors start it "
               "themselves: it answers with\n"
               "messages, repairs, completion, hints, predicted lengths, definitions and renaming, "
               "also across included files.\n"
               "docs/editors.md has settings for Neovim, Vim, Emacs, Kate and VS Code.\n"
               "Example: vim.lsp.start_client({ cmd = { 'lsc', 'lsp' } })");
}

void add_explain(CLI::App& app, ExplainCommand& command) {
    app.add_option("CODE", command.code,
                   "Code in brackets at the end of a message (default: list all codes)");
    add_message_options(app, command.messages);
    app.footer("Example: lsc explain look-alike");
}

/// The files that the user names in a command line.
template <typename Command>
std::vector<std::string> named_files(const Command& command) {
    std::vector<std::string> files;
    if constexpr (requires { command.files; }) {
        files = command.files;
    } else if constexpr (requires { command.file; }) {
        files = {command.file};
    }
    if constexpr (requires { command.overrides; }) {
        const SceneOverrides& scene = command.overrides;
        files.insert(files.end(), {scene.density_map, scene.ground_picture, scene.ground_normals,
                                   scene.grammar.view});
    } else if constexpr (requires { command.grammar; }) {
        files.push_back(command.grammar.view);
    }
    return files;
}

/// Applies --base and the file policy to the options of a command. Returns the mistake, if any.
struct Complete {
    const CLI::App& app;

    template <typename Command>
    std::optional<UsageError> operator()(Command& given) const {
        std::optional<UsageError> mistake;
        if constexpr (std::is_same_v<Command, CheckCommand>) {
            mistake = apply_base(given.run, given.files);
        } else if constexpr (requires {
                                 given.file;
                                 given.run;
                             }) {
            mistake = apply_base(given.run, {&given.file, 1});
        }
        if constexpr (requires { given.run; }) {
            FilePolicy& files = given.run.files;
            if constexpr (std::is_same_v<Command, ImportCommand>) {
                if (files.is_untrusted && files.root.empty()) {
                    files.root = given.folder; // the folder of --all
                }
            }
            if constexpr (std::is_same_v<Command, LspCommand>) {
                if (files.is_untrusted) { // editors name all files by absolute paths
                    std::error_code ignored;
                    files.root = path_text(std::filesystem::absolute(
                        path_of(files.root.empty() ? "." : files.root), ignored));
                }
            }
            return mistake ? mistake : apply_policy(app, named_files(given), given.run);
        } else {
            return mistake;
        }
    }
};

/// The command named `name`; null if there is none.
const CLI::App* find_command(const CLI::App& app, const std::string& name) {
    for (const CLI::App* command : app.get_subcommands({})) {
        if (command->get_name() == name) {
            return command;
        }
    }
    return nullptr;
}

/// Whether a word is the name of a grammar or of a scene rather than a command.
bool is_file_name(std::string_view word) {
    const std::size_t dot = word.rfind('.');
    return dot != std::string_view::npos && dot != 0 && word.size() - dot > 1 &&
           word.size() - dot <= 8;
}

/// The error if the command is missing or the first argument is not a command.
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
    if (is_file_name(first)) {
        usage.message = fmt::format("`{}` is a file, and the command is missing", first);
        usage.help =
            first.ends_with(".toml")
                ? fmt::format("`lsc forest {} -o forest.glb` grows the forest of a scene", first)
                : fmt::format("`lsc check {0}` checks it, `lsc dump {0}` prints the word, `lsc "
                              "export {0} -o plant.glb` draws the plant",
                              first);
    } else if (const auto nearest = nearest_name(first, names)) {
        usage.help = fmt::format("did you mean `lsc {}`?", *nearest);
    }
    return usage;
}

/// The help for `-D NAME 3`, which lacks a `=`.
std::optional<std::string> definition_help(std::span<const std::string> arguments) {
    for (std::size_t i = 0; i + 2 < arguments.size(); ++i) {
        const bool is_option = arguments[i] == "-D" || arguments[i] == "--define";
        if (is_option && parse_definition(arguments[i + 1] + "=" + arguments[i + 2])) {
            return fmt::format("write `-D {}={}`: name, `=` and number are one argument",
                               arguments[i + 1], arguments[i + 2]);
        }
    }
    return std::nullopt;
}

/// The error for `lsc --verbose check`: before a command, --verbose is valid only with --version.
std::optional<UsageError> verbose_before_command(std::span<const std::string> arguments,
                                                 const CLI::App& app) {
    const std::string& option = arguments.front();
    if (option != "-v" && option != "--verbose") {
        return std::nullopt;
    }
    for (const std::string& argument : arguments.subspan(1)) {
        if (find_command(app, argument) != nullptr) {
            return UsageError{
                fmt::format("`{}` stands before the command", option),
                fmt::format("options stand after the command: `lsc {} {}`", argument, option)};
        }
    }
    return std::nullopt;
}

/// The usage error for a mistake found by CLI11, with help about commands. `command`: the given
/// command; null if the first argument is not a command.
UsageError usage_error(const CLI::ParseError& error,
                       const CLI::App& app,
                       const CLI::App* command,
                       std::span<const std::string> arguments) {
    if (command == nullptr) {
        UsageError usage = to_usage_error(error, app, "lsc");
        for (const std::string& argument : arguments.subspan(1)) {
            if (find_command(app, argument) != nullptr) {
                usage.help = fmt::format("options stand after the command: `lsc {} {}`", argument,
                                         arguments.front());
                break;
            }
        }
        return usage;
    }
    UsageError usage = to_usage_error(error, *command, "lsc " + command->get_name());
    if (command->get_name() == "export" && usage.message == "--output is missing") {
        // The user may have named the output file without `-o`, as `cp` allows.
        const auto output =
            std::find_if(arguments.begin() + 1, arguments.end(), [](const std::string& argument) {
                return !argument.starts_with('-') && format_of_path(argument);
            });
        if (output != arguments.end()) {
            usage.message = fmt::format("`{}` stands without its option", *output);
            usage.help = fmt::format("write `-o {}`", *output);
            return usage;
        }
        usage.help = fmt::format("`-o FILE`, whose name ends in {}",
                                 format_names("or", [](const FormatTraits&) { return true; }));
    } else if (usage.message.starts_with("--define: ")) {
        usage.help = definition_help(arguments).value_or(usage.help);
    } else if (usage.message.starts_with("--seed: ")) {
        usage.help = "any whole number is a seed: `--seed 7` gives one plant, another number "
                     "another plant";
    }
    return usage;
}

/// The options before the command, and the argument of `lsc help`.
struct ProgramOptions {
    bool verbose = false;
    std::string topic;
};

/// Adds the options of the program.
void add_program_options(CLI::App& app, ProgramOptions& options) {
    app.allow_windows_style_options(false); // `/a` is a path
    app.set_version_flag("--version", "lsc " LSC_VERSION, "Print the version and exit");
    app.add_flag("-v,--verbose", options.verbose,
                 "With --version: print commit, compiler, libraries and processor too");
    app.require_subcommand(1);
    app.footer("`lsc help COMMAND` and `lsc COMMAND --help` list the options of a command.");
}

/// The commands that add_commands() adds.
enum class Commands { All, OnlyChosen };

/// Adds commands. Only the command `chosen` gets options, because `parsed` has room for the options
/// of one command.
void add_commands(CLI::App& app,
                  Commands commands,
                  const std::string& chosen,
                  CommandLine& parsed,
                  ProgramOptions& options) {
    const auto add = [&]<typename Command>(const char* name, const char* text,
                                           void (*add_options)(CLI::App&, Command&)) {
        if (commands == Commands::OnlyChosen && chosen != name) {
            return;
        }
        CLI::App& added = *app.add_subcommand(name, text);
        if (chosen == name) {
            add_options(added, parsed.emplace<Command>());
        }
    };
    add("check", "Report mistakes in grammars, and repair them", add_check);
    add("compile", "Compile a grammar to bytecode (.lsb)", add_compile);
    add("dump", "Print the derived word or a stage of the compiler", add_dump);
    add("export", "Export one plant as a 3D model or a drawing", add_export);
    add("forest", "Generate a forest of instanced plants", add_forest);
    add("import", "Convert a grammar of another program to .lsys", add_import);
    add("lsp", "Serve an editor: the language server of grammars", add_lsp);
    add("place", "Place the trees of a forest, for tiles and serve", add_place);
    add("serve", "Serve a forest as 3D Tiles, made on request", add_serve);
    add("stats", "Predict the size of each generation", add_stats);
    add("tiles", "Write a forest as 3D Tiles for Cesium and other viewers", add_tiles);
    add("trace", "Explain what becomes of a module, and why", add_trace);
    add("fmt", "Format grammars", add_format);
    add("explain", "Explain a diagnostic, with examples", add_explain);
    if (commands == Commands::All || chosen == "help") {
        CLI::App& help = *app.add_subcommand("help", "Print the options of a command");
        if (chosen == "help") {
            help.add_option("COMMAND", options.topic, "The command (default: list all commands)");
            help.footer("Example: lsc help export");
        }
    }
}

constexpr const char* kTitle =
    "Compiles, derives and exports L-systems, the grammars of plants and curves.";

/// The text of `lsc help TOPIC`.
CommandLine help_on(const std::string& topic) {
    CLI::App app(kTitle, "lsc");
    CommandLine parsed = UsageError{};
    ProgramOptions options;
    add_program_options(app, options);
    add_commands(app, Commands::All, topic, parsed, options);
    if (topic.empty()) {
        return PrintText{help_text(app, "")};
    }
    const CLI::App* const command = find_command(app, topic);
    if (command != nullptr) {
        return PrintText{help_text(*command, "lsc")};
    }
    std::vector<std::string_view> names;
    for (const CLI::App* each : app.get_subcommands({})) {
        names.push_back(each->get_name());
    }
    const auto nearest = nearest_name(topic, names);
    return UsageError{fmt::format("`{}` is not a command", topic),
                      nearest ? fmt::format("did you mean `lsc help {}`?", *nearest)
                              : std::string(kListHint)};
}

/// Parses the arguments. Sets `implied` to the options that their preset adds.
CommandLine parse_arguments(std::span<const std::string> arguments,
                            std::vector<std::string>& implied) {
    CLI::App app(kTitle, "lsc");
    CommandLine parsed = UsageError{"no command is given", kListHint};
    ProgramOptions program_options;
    add_program_options(app, program_options);
    const std::string first = arguments.empty() ? std::string() : arguments.front();
    add_commands(app, Commands::OnlyChosen, first, parsed, program_options); // adding all is slow
    if (find_command(app, first) == nullptr) {
        add_commands(app, Commands::All, first, parsed, program_options);
    }

    if (std::optional<UsageError> usage = unknown_command(arguments, app)) {
        return *usage;
    }
    const CLI::App* command = find_command(app, arguments.front());
    if (std::optional<UsageError> usage = verbose_before_command(arguments, app)) {
        return *usage;
    }
    try {
        std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());
        app.parse(std::move(reversed));
    } catch (const CLI::CallForHelp&) {
        return PrintText{command == nullptr ? help_text(app, "") : help_text(*command, "lsc")};
    } catch (const CLI::CallForVersion&) {
        const CLI::App& named = command == nullptr ? app : *command;
        return PrintText{"lsc " LSC_VERSION "\n", is_given(named, "--verbose")};
    } catch (const CLI::ParseError& error) {
        return usage_error(error, app, command, arguments);
    }
    if (command == nullptr) { // `lsc --version=false check`
        return UsageError{fmt::format("the command is missing before `{}`", arguments.front()),
                          "options stand after the command"};
    }
    if (command->get_name() == "help") {
        return help_on(program_options.topic);
    }
    const std::optional<UsageError> mistake = std::visit(Complete{*command}, parsed);
    if (mistake) {
        return *mistake;
    }
    const Result<std::vector<std::string>> options = std::visit(
        [&]<typename Command>(const Command& given) -> Result<std::vector<std::string>> {
            if constexpr (requires { given.preset; }) {
                constexpr PresetCommand kCommand = std::is_same_v<Command, ExportCommand>
                                                       ? PresetCommand::Export
                                                       : PresetCommand::Forest;
                return find_preset_arguments(given.preset, kCommand, format_of(given), *command);
            } else {
                return std::vector<std::string>{};
            }
        },
        parsed);
    if (!options) {
        return UsageError{options.error().message,
                          fmt::format("`lsc {} --help` lists the presets", command->get_name())};
    }
    implied = options.value();
    return parsed;
}

/// Parses `lsc check FILE...` as parse_arguments() does; nothing for options and other commands.
/// Setting up CLI11 takes as long as checking a small grammar, and editors and scripts start such a
/// run for every file.
std::optional<CheckCommand> parse_check_of_files(std::span<const std::string> arguments) {
    if (arguments.size() < 2 || arguments.front() != "check" ||
        std::any_of(arguments.begin() + 1, arguments.end(), [](const std::string& argument) {
            return argument.empty() || (argument.starts_with('-') && argument != "-");
        })) {
        return std::nullopt;
    }
    CheckCommand command;
    command.files.assign(arguments.begin() + 1, arguments.end());
    return command;
}

} // namespace

void visit_commands(
    const std::function<void(const CLI::App& program, const CLI::App& command)>& visit) {
    std::vector<std::string> names;
    const auto with_options_of = [](const std::string& name, const auto& use) {
        CLI::App app(kTitle, "lsc");
        CommandLine parsed = UsageError{};
        ProgramOptions options;
        add_program_options(app, options);
        add_commands(app, Commands::All, name, parsed, options);
        use(app);
    };
    with_options_of("", [&names](const CLI::App& app) {
        for (const CLI::App* command : app.get_subcommands({})) {
            names.push_back(command->get_name());
        }
    });
    for (const std::string& name : names) {
        with_options_of(name, [&](const CLI::App& app) { visit(app, *find_command(app, name)); });
    }
}

CommandLine parse_command_line(std::span<const std::string> arguments) {
    // Avoid CLI11, which takes longer than the rest of this run, mostly to throw an exception.
    if (arguments.size() == 1 && arguments.front() == "--version") {
        return PrintText{"lsc " LSC_VERSION "\n"};
    }
    if (std::optional<CheckCommand> check = parse_check_of_files(arguments)) {
        return std::move(*check);
    }
    std::vector<std::string> options;
    CommandLine parsed = parse_arguments(arguments, options);
    if (options.empty()) {
        return parsed;
    }
    std::vector<std::string> whole(arguments.begin(), arguments.end());
    whole.insert(whole.begin() + 1, options.begin(), options.end());
    return parse_arguments(whole, options);
}

} // namespace lsys::lsc
