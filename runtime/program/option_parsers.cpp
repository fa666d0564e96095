#include "runtime/program/option_parsers.h"

#include "grammar/base/diagnostic.h"
#include "grammar/dialects/dialect.h"
#include "runtime/program/memory_size.h"
#include "runtime/turtle/turtle.h"

#include <limits>
#include <string_view>

namespace lsys {

void add_messages(CLI::App& app, MessageOptions& options) {
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

void add_grammar(CLI::App& app, GrammarOptions& options, RunOptions& run) {
    run.limits.max_bytes = half_of_memory();
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
    add_parsed(app, "--max-modules", run.limits.max_modules,
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

void add_run_limits(CLI::App& app, RunOptions& run) {
    run.limits.max_bytes = half_of_memory();
    add_parsed(
        app, "--max-memory", run.limits.max_bytes, parse_size,
        "The most memory each of word, skeleton, mesh and the files that are read may take: 500M, "
        "2G (default half of the machine's or the container's)")
        ->type_name("SIZE")
        ->group("Limits");
    constexpr std::uint64_t kMaxThreads = 1024;
    add_parsed(app, "--threads", run.threads, whole(1, kMaxThreads),
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

} // namespace lsys
