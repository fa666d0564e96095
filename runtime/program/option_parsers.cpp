// SPDX-License-Identifier: MIT
#include "runtime/program/option_parsers.h"

#include "grammar/base/diagnostic.h"
#include "grammar/base/paths.h"
#include "grammar/dialects/dialect.h"
#include "runtime/meshing/detail_levels.h"
#include "runtime/pipeline/setting_options.h"
#include "runtime/program/find_option.h"
#include "runtime/program/memory_size.h"
#include "runtime/turtle/turtle.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <string_view>
#include <system_error>

namespace lsys {

void add_messages(CLI::App& app, MessageOptions& options) {
    add_choice<MessageFormat>(app, "--message-format", options.format,
                              {{"human", MessageFormat::Human},
                               {"short", MessageFormat::Short},
                               {"json", MessageFormat::Json}},
                              "Format of messages (default human)")
        ->group("Messages");
    add_choice<ColourMode>(
        app, "--color", options.colour,
        {{"auto", ColourMode::Auto}, {"always", ColourMode::Always}, {"never", ColourMode::Never}},
        "Colour in messages; auto: on a terminal (default auto)")
        ->group("Messages");
    app.add_flag("-q,--quiet", options.quiet, "Print errors only")->group("Messages");
    app.add_flag("-v,--verbose", options.verbose, "Print steps and sizes")->group("Messages");
}

namespace {

void add_level(CLI::App& app,
               const std::string& name,
               MessageLevel level,
               MessageLevels& levels,
               const char* text) {
    app.add_option_function<std::vector<std::string>>(
           name,
           [&levels, level, name](const std::vector<std::string>& codes) {
               for (const std::string& code : codes) {
                   if (const std::optional<std::string> mistake = levels.set(level, code)) {
                       throw CLI::ValidationError(name, *mistake);
                   }
               }
           },
           text)
        ->type_name("CODE")
        ->allow_extra_args(false)
        ->group("Messages");
}

} // namespace

void add_levels(CLI::App& app, MessageOptions& options) {
    add_level(app, "--allow", MessageLevel::Allow, options.levels,
              "Hide messages of this code, or all `warnings` or `notes`; repeatable");
    add_level(app, "--warn", MessageLevel::Warn, options.levels,
              "Make messages of this code, or all `notes`, warnings; repeatable");
    add_level(app, "--deny", MessageLevel::Deny, options.levels,
              "Make messages of this code, or all `warnings` or `notes`, errors; repeatable");
}

void add_dialect(CLI::App& app, std::string& dialect) {
    std::vector<std::pair<std::string, std::string>> names;
    for (const DialectRow& row : dialects()) {
        names.emplace_back(row.name, row.name);
    }
    add_choice<std::string>(app, "--dialect", dialect, std::move(names),
                            "Language of the file (default: by content and name)")
        ->group("Grammar");
}

void add_grammar(CLI::App& app, GrammarOptions& options, RunOptions& run) {
    add_parsed(app, "-n,--generations", options.generations, integer(0, kMaxGenerations),
               "Number of generations (default: #n)")
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
           "Value of a #define or #param; repeatable")
        ->type_name("NAME=NUMBER")
        ->allow_extra_args(false)
        ->group("Grammar");
    app.add_option_function<std::vector<std::string>>(
           "--set",
           [&options](const std::vector<std::string>& texts) {
               for (const std::string& text : texts) {
                   Result<SettingText> setting = parse_setting(text);
                   if (!setting) {
                       throw CLI::ValidationError("--set", setting.error().message);
                   }
                   for (const SettingText& known : options.settings) {
                       if (known.key == setting.value().key) {
                           throw CLI::ValidationError(
                               "--set", fmt::format("`{}` is given twice", known.key));
                       }
                   }
                   options.settings.push_back(std::move(setting.value()));
               }
           },
           "Value of a #set: angle=25, tropism=\"0 -1 0 0.2\"; repeatable")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false)
        ->group("Grammar");
    add_dialect(app, options.dialect);
    app.add_flag("--bug-compatible", options.bug_compatible,
                 "Reproduce bugs, random numbers and surfaces of the original program (l3d, lplus)")
        ->group("Grammar");
    app.add_option("--system", options.system,
                   "System to read from a file with several (default: the only one)")
        ->type_name("NAME")
        ->group("Grammar");
    app.add_option("--view", options.view,
                   "View file of a cpfg model (default: the one beside the model)")
        ->type_name("FILE")
        ->group("Grammar");
    add_parsed(app, "--max-modules", run.limits.max_modules,
               integer(1, std::numeric_limits<std::uint64_t>::max()),
               "Maximum number of modules in a word (default 4294967296)")
        ->type_name("N")
        ->group("Limits");
}

void add_environments(CLI::App& app, RunOptions& run) {
    app.add_option_function<std::vector<std::string>>(
           "--environment",
           [&run](const std::vector<std::string>& texts) {
               for (const std::string& text : texts) {
                   Result<EnvironmentCommand> environment = parse_environment(text);
                   if (!environment) {
                       throw CLI::ValidationError("--environment", environment.error().message);
                   }
                   for (const EnvironmentCommand& known : run.environments) {
                       if (known.name == environment.value().name) {
                           throw CLI::ValidationError(
                               "--environment", fmt::format("`{}` is given twice", known.name));
                       }
                   }
                   run.environments.push_back(std::move(environment.value()));
               }
           },
           "Program that answers `?NAME` of a `#sense NAME program`: a command line of the shell; "
           "repeatable")
        ->type_name("NAME=COMMAND")
        ->allow_extra_args(false)
        ->group("Grammar");
}

void add_base_option(CLI::App& app, RunOptions& run) {
    const auto folder = [](const std::string& text) -> Result<std::string> {
        std::error_code ignored;
        return std::filesystem::is_directory(path_of(text), ignored)
                   ? Result<std::string>(text)
                   : Error{fmt::format("`{}` is not a folder", text)};
    };
    add_parsed(app, "--base", run.base, folder,
               "For a grammar from standard input: the folder of its #include and #object files "
               "(default: the current one)")
        ->type_name("FOLDER")
        ->group("Grammar");
    app.add_option("--stdin-name", run.stdin_name,
                   "For a grammar from standard input: its file name, used in messages, for the "
                   "language and for #include and #object files")
        ->type_name("FILE")
        ->group("Grammar");
}

std::optional<UsageError> apply_base(const RunOptions& run, std::span<std::string> files) {
    if (!run.stdin_name.empty()) {
        if (!run.base.empty()) {
            return UsageError{"--stdin-name and --base both set the folder of the grammar",
                              "the folder of the name is the folder of the grammar"};
        }
        if (std::find(files.begin(), files.end(), "-") == files.end()) {
            return UsageError{"--stdin-name names a grammar from standard input",
                              "name `-` as FILE, or leave --stdin-name out"};
        }
        std::replace(files.begin(), files.end(), std::string("-"),
                     standard_input_as(run.stdin_name));
        return std::nullopt;
    }
    if (run.base.empty()) {
        return std::nullopt;
    }
    if (std::find(files.begin(), files.end(), "-") == files.end()) {
        return UsageError{"--base is the folder of a grammar from standard input",
                          "name `-` as FILE, or leave --base out: a file has its own folder"};
    }
    std::replace(files.begin(), files.end(), std::string("-"), standard_input_in(run.base));
    return std::nullopt;
}

void add_seed(CLI::App& app, std::optional<std::uint64_t>& seed) {
    add_parsed(app, "-s,--seed", seed, integer(0, std::numeric_limits<std::uint64_t>::max()),
               "Random seed (default: `#set seed`, else 0)")
        ->type_name("S")
        ->group("Grammar");
}

void add_height(CLI::App& app, std::optional<float>& height) {
    const auto metres = [](const std::string& text) {
        return parse_number(text, kMinHeight, kMaxHeight);
    };
    add_parsed(app, "--height", height, metres,
               "Scale the plant evenly to this height, widths too (default: `#set height`, else "
               "as drawn)")
        ->type_name("METRES")
        ->group("Grammar");
}

void add_tree_height(CLI::App& app, std::optional<HeightRange>& height) {
    const auto range = [](const std::string& text) -> Result<HeightRange> {
        const std::size_t comma = text.find(',');
        const Result<float> min = parse_number(text.substr(0, comma), kMinHeight, kMaxHeight);
        const Result<float> max = comma == std::string::npos ? min
                                                             : parse_number(text.substr(comma + 1),
                                                                            kMinHeight, kMaxHeight);
        if (!min || !max) {
            return min ? max.error() : min.error();
        }
        if (max.value() < min.value()) {
            return Error{fmt::format("`{}` is not MIN,MAX: min {} is above max {}", text,
                                     min.value(), max.value())};
        }
        return HeightRange{min.value(), max.value()};
    };
    add_parsed(app, "--height", height, range,
               "Height of full-grown trees, or their range (default: `height` of the species, "
               "`#set height`, else as drawn)")
        ->type_name("METRES|MIN,MAX")
        ->group("Placement");
}

void add_run_limits(CLI::App& app, RunOptions& run) {
    run.limits.max_bytes = half_of_memory();
    add_parsed(app, "--max-memory", run.limits.max_bytes, parse_size,
               "Maximum memory of each of word, skeleton, mesh and input files: 500M, 2G (default: "
               "half of the memory)")
        ->type_name("SIZE")
        ->group("Limits");
    constexpr std::uint64_t kMaxThreads = 1024;
    add_parsed(app, "--threads", run.threads, integer(1, kMaxThreads),
               "Number of threads; does not change the result (default: all cores)")
        ->type_name("N")
        ->group("Limits");
}

void describe_detail_levels(CLI::App& app) {
    find_option(app, "--level")
        ->description(
            "Level of detail: 0 is the finest, each further one has a half to a third of the "
            "triangles, down to 50: fewer sides, then fewer twigs and leaves (default 0)");
}

void add_mesh(CLI::App& app, MeshOptions& mesh) {
    add_choice<MeshMethod>(
        app, "--method", mesh.method,
        {{"tubes", MeshMethod::Tubes},
         {"cylinders", MeshMethod::Cylinders},
         {"boxes", MeshMethod::Boxes},
         {"solid", MeshMethod::Solid}},
        "Branches as seamless tubes, one cylinder per segment, or boxes, smoothed or not; or one "
        "closed surface around the whole plant, for printing (default tubes; boxes for .sys "
        "plants)")
        ->group("Mesh");
    add_parsed(app, "--sides", mesh.sides, integer(kMinSides, kMaxSides),
               "Sides of each cross-section (default: the grammar's)")
        ->type_name("N")
        ->group("Mesh");
    add_parsed(app, "--level", mesh.level, integer(0, kMaxDetailLevel),
               "Level of detail: 0 is the finest, each further level halves the sides (default 0)")
        ->type_name("K")
        ->group("Mesh");
    add_parsed(
        app, "--deviation", mesh.deviation,
        [](const std::string& text) { return parse_number(text, 0.0F, kMaxDeviation); },
        "Reduce the sides of tube rings to this distance from the circle; 0: keep all (default 0)")
        ->type_name("METRES")
        ->group("Mesh");
    constexpr std::uint64_t kMaxSubdivisions = 5;
    add_parsed(app, "--subdivisions", mesh.subdivisions, integer(0, kMaxSubdivisions),
               "Smoothing rounds of boxes (default 2; 0 for .sys plants)")
        ->type_name("N")
        ->group("Mesh");
    constexpr float kMinWidth = 1e-6F;
    add_parsed(
        app, "--min-width", mesh.min_width,
        [](const std::string& text) { return parse_number(text, kMinWidth, kMaxMinWidth); },
        "Width of the thinnest branches and of leaves of `--method solid` (default: 1/150 of the "
        "largest extent)")
        ->type_name("METRES")
        ->group("Mesh");
    add_parsed(app, "--bark-noise", mesh.bark_noise, fraction,
               "Bark displacement as a fraction of the radius, 0 to 1 (default 0)")
        ->type_name("A")
        ->group("Mesh");
    add_parsed(
        app, "--grooves", mesh.grooves, fraction,
        "Depth of grooves along stems as a fraction of the radius, 0 to 1 (default 0); tubes "
        "then have 32 sides and boxes 3 subdivisions, unless --sides and --subdivisions say "
        "otherwise")
        ->type_name("DEPTH")
        ->group("Mesh");
    add_parsed(app, "--droop", mesh.droop, fraction,
               "Bending of leaves by gravity, 0 to 1 (default: 0.25 in .l++ files, else 0)")
        ->type_name("D")
        ->group("Mesh");
    app.add_flag("--smooth-joints", mesh.smooth_joints,
                 "Bend tubes along smooth curves through their joints")
        ->group("Mesh");
}

std::string help_text(const CLI::App& app, const std::string& program) {
    std::string text;
    for (const char c : app.help(program)) {
        if (c != '\n' || !text.ends_with("\n\n")) {
            text += c;
        }
    }
    // For `--fix`, a flag with an optional value, CLI11 shows the default value in the help. Show
    // the other value instead.
    constexpr std::string_view kFlag = "{certain} ";
    if (const std::size_t at = text.find(kFlag); at != std::string::npos) {
        text.replace(at, kFlag.size(), "[=offered]");
    }
    return text;
}

UsageError
to_usage_error(const CLI::ParseError& error, const CLI::App& app, const std::string& command) {
    UsageError usage;
    usage.help = fmt::format("`{} --help` lists the options", command);
    usage.message = error.what();
    // CLI11 writes `--seed: At Most 1 required but received 2`.
    constexpr std::string_view kRepeated = ": At Most 1 required but received ";
    if (const std::size_t at = usage.message.find(kRepeated); at != std::string::npos) {
        usage.message =
            fmt::format("{} is given {} times, and may be given once", usage.message.substr(0, at),
                        usage.message.substr(at + kRepeated.size()));
    }
    const auto has_code = [&](CLI::ExitCodes code) {
        return error.get_exit_code() == static_cast<int>(code);
    };
    const std::vector<std::string> extras = app.remaining(true);
    // CLI11 reports a missing argument before an unknown option, which may have caused it.
    const auto unknown = std::find_if(extras.begin(), extras.end(), [](const std::string& extra) {
        return extra.starts_with('-');
    });
    if (has_code(CLI::ExitCodes::ExtrasError) ||
        (has_code(CLI::ExitCodes::RequiredError) && unknown != extras.end())) {
        const std::string extra = has_code(CLI::ExitCodes::RequiredError) ? *unknown
                                  : extras.empty()                        ? std::string()
                                                                          : extras.front();
        if (extra == "--" && app.get_subcommands({}).empty()) { // `app` is a command
            usage.message = "behind `--` stand names of files only";
            usage.help = "options stand before it";
            return usage;
        }
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
    } else if (has_code(CLI::ExitCodes::RequiredError) && !app.get_subcommands({}).empty()) {
        usage.message = "no command is given";
    } else if (has_code(CLI::ExitCodes::RequiredError)) {
        usage.message =
            fmt::format("{} is missing", usage.message.substr(0, usage.message.find(' ')));
    }
    return usage;
}

} // namespace lsys
