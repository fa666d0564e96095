// SPDX-License-Identifier: MIT
#include "compiler/bytecode/disassemble.h"
#include "compiler/instancing/instance.h"
#include "compiler/program/program_dump.h"
#include "grammar/ast/ast_dump.h"
#include "grammar/base/paths.h"
#include "grammar/format/tokens.h"
#include "runtime/cli/commands.h"
#include "runtime/cli/dump_environment.h"
#include "runtime/cli/dump_heroes.h"
#include "runtime/cli/dump_word.h"
#include "runtime/cli/plant_options.h"
#include "runtime/cli/progress.h"
#include "runtime/meshing/detail_levels.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/pipeline/named_files.h"
#include "runtime/pipeline/plant.h"
#include "runtime/program/files.h"
#include "runtime/program/host.h"
#include "runtime/program/run_files.h"
#include "runtime/scene/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace lsys::lsc {

namespace {

/// A message about options that conflict; empty if none do.
std::string find_conflict(const DumpCommand& command) {
    const bool uses_states = command.steps || !command.save_state.empty() || !command.from.empty();
    const bool makes_mesh = command.stage == DumpStage::Mesh;
    const bool draws = makes_mesh || command.stage == DumpStage::Skeleton;
    if (!makes_mesh && command.mesh != MeshOptions{}) {
        return "only --stage mesh makes a mesh, so --method, --sides, --level, --deviation, "
               "--subdivisions, --bark-noise, --grooves, --droop and --smooth-joints do not go "
               "with "
               "another stage";
    }
    if (makes_mesh && command.origins) {
        return "a mesh names its segments, whose origins --stage skeleton prints: --origins does "
               "not go with --stage mesh";
    }
    if (draws && (command.all || command.count || uses_states)) {
        return "a plant is drawn from the last word, so --all, --count, --steps, --save-state and "
               "--from do not go with --stage skeleton or mesh";
    }
    if (command.environment_format && command.stage != DumpStage::Environment) {
        return "--format goes with --stage environment";
    }
    if (draws) {
        return {};
    }
    if (command.height) {
        return "only a drawn plant has a height, so --height goes with --stage skeleton or mesh";
    }
    const bool instances = command.stage == DumpStage::Instanced ||
                           command.stage == DumpStage::Heroes || command.stage == DumpStage::Cache;
    if (command.rho && !instances) {
        return "only --stage instanced, heroes and cache have a probability, so --rho does not go "
               "with another stage";
    }
    if ((command.first || command.rows) && command.stage != DumpStage::Instanced) {
        return "--first and --rows show forms of productions, which --stage instanced lists";
    }
    if (command.heroes && (!instances || command.stage == DumpStage::Instanced)) {
        return "--heroes goes with --stage heroes and cache";
    }
    if ((command.cache_cap || command.tolerance) && command.stage != DumpStage::Cache) {
        return "--cache-cap and --instance-tolerance go with --stage cache";
    }
    if (command.stage == DumpStage::Instanced && command.count) {
        return "--count prints the number of modules; --rows N is the number of forms of --stage "
               "instanced";
    }
    if (command.stage == DumpStage::Heroes || command.stage == DumpStage::Cache) {
        if (command.count && command.stage == DumpStage::Cache) {
            return "--count prints the number of modules, which --stage cache does not show";
        }
        return command.all || command.stream || command.origins || uses_states
                   ? "--stage heroes and cache are of the last words, so --all, --stream, "
                     "--origins, --steps, --save-state and --from do not go with them"
                   : "";
    }
    if (command.stage == DumpStage::Environment) {
        return command.all || command.count || command.stream || command.origins || uses_states
                   ? "--stage environment is of the last word, so --all, --count, --stream, "
                     "--origins, --steps, --save-state and --from do not go with it"
                   : "";
    }
    if (command.origins && command.count) {
        return "--count prints no modules, so --origins does not go with it";
    }
    if (command.stage != DumpStage::Word) {
        const bool derives = command.all || command.count || command.stream || command.origins ||
                             uses_states || command.seed;
        return derives ? "only --stage word derives, so --all, --count, --stream, --origins, "
                         "--seed, --steps, --save-state and --from do not go with another stage"
                       : "";
    }
    if (command.stream && (uses_states || command.all)) {
        return "--stream keeps no word, so --all, --steps, --save-state and --from do not go with "
               "it";
    }
    if (command.save_state == "-" && command.output == "-") {
        return "--save-state - and the word cannot both go to standard output; say where with -o";
    }
    return {};
}

ExitStatus
write_stage(const DumpCommand& command, const std::string& text, const Console& console) {
    return report_result(write_file(command.output, text, console), console);
}

/// Notes the files that a grammar names, so that the output replaces none of them. Without errors
/// these are the files of its statements; else all names between quotes.
void note_named_files(const DumpCommand& command, const std::string& text, const Console& console) {
    if (command.output.empty() || command.output == "-") {
        return;
    }
    const Outcome<Grammar> grammar =
        load_grammar(command.file, command.grammar, make_project(console, command.run));
    if (grammar) {
        note_read(console.io().files, named_files(grammar.value().bytecode, command.file));
        return;
    }
    std::vector<std::string> names;
    const auto folder = path_of(command.file).parent_path();
    for (std::size_t begin = text.find('"'); begin != std::string::npos;) {
        const std::size_t end = text.find_first_of("\"\n", begin + 1);
        if (end == std::string::npos) {
            break;
        }
        names.push_back(path_text(folder / path_of(text.substr(begin + 1, end - begin - 1))));
        begin = text.find('"', text[end] == '"' ? end + 1 : end);
    }
    note_read(console.io().files, names);
}

/// Prints the tokens or the syntax tree, even if the grammar has errors.
ExitStatus dump_syntax(const DumpCommand& command, const Console& console) {
    const Project project = make_project(console, command.run);
    GrammarText grammar;
    if (const ExitStatus read =
            console.take(read_grammar(command.file, command.grammar.dialect, project), grammar);
        read != ExitStatus::Ok) {
        return read;
    }
    const Dialect dialect = grammar.dialect;
    if (command.stage == DumpStage::Tokens && dialect != Dialect::Lsys) {
        return report_error(
            Error{fmt::format("--stage tokens shows tokens of .lsys files, but `{}` is {}",
                              shown_path(command.file), row_of(dialect).title)},
            console);
    }
    if (const Result<void> allowed = check_system(command.file, dialect, command.grammar);
        !allowed) {
        return report_error(allowed.error(), console);
    }
    note_named_files(command, grammar.bytes, console);
    SourceMap sources;
    Names names;
    Diagnostics diagnostics;
    const FileId root = sources.add(shown_path(command.file), std::move(grammar.bytes));
    const FileLoader load = make_loader(project, project.limits.max_bytes);
    const ParseContext context{sources,
                               names,
                               diagnostics,
                               load,
                               command.grammar.bug_compatible,
                               command.grammar.system,
                               nullptr,
                               command.grammar.view};
    const std::string text = command.stage == DumpStage::Tokens
                                 ? dump_tokens(sources.file(root))
                                 : dump_ast(parse_dialect(root, dialect, context), names, sources);
    return more_severe(console.show(diagnostics, sources), write_stage(command, text, console));
}

/// Reports that a .lsb file has no Program.
ExitStatus report_missing_program(const DumpCommand& command, const Console& console) {
    return report_error(
        Error{fmt::format("`{}` is compiled and contains no program; use --stage bytecode",
                          command.file)},
        console);
}

ExitStatus
dump_instanced(const DumpCommand& command, const Grammar& grammar, const Console& console) {
    std::optional<FormPage> page;
    if (command.first || command.rows) {
        page.emplace();
        page->first = command.first.value_or(page->first);
        page->count = command.rows.value_or(page->count);
    }
    std::optional<Output> output; // opened at the first piece, so earlier errors replace no file
    Result<void> written;
    const auto put = [&](std::string_view text) {
        if (!output) {
            Result<Output> opened = Output::open(command.output, console);
            if (!opened) {
                written = opened.error();
                return false;
            }
            output.emplace(std::move(opened.value()));
        }
        written = output->write(text);
        return bool(written) && !console.interrupted();
    };
    Diagnostics diagnostics;
    const std::optional<std::uint64_t> last =
        list_instanced(*grammar.program, grammar.names, *grammar.sources,
                       command.rho.value_or(kSceneRho), page, put, diagnostics);
    const ExitStatus shown = console.show(diagnostics, *grammar.sources);
    if (!last) {
        return shown;
    }
    if (page && page->first > *last) {
        return report_error(Error{fmt::format("--first {}: no production has so many forms; the "
                                              "last one is {}",
                                              page->first, *last)},
                            console);
    }
    if (console.interrupted()) {
        return ExitStatus::Interrupted;
    }
    if (written) {
        written = output->commit();
    }
    return more_severe(shown, report_result(written, console));
}

/// Writes `lines` lines; `append(line, text)` appends line number `line` to `text`.
template <typename Append>
ExitStatus write_lines(const DumpCommand& command,
                       const Console& console,
                       std::uint64_t lines,
                       const Append& append) {
    Result<Output> output = Output::open(command.output, console);
    if (!output) {
        return report_error(output.error(), console);
    }
    constexpr std::size_t kBufferBytes = std::size_t{1} << 18;
    std::string text;
    for (std::uint64_t line = 0; line < lines; ++line) {
        append(line, text);
        if (text.size() >= kBufferBytes || line + 1 == lines) {
            if (console.interrupted()) {
                return ExitStatus::Interrupted;
            }
            if (const Result<void> written = output.value().write(text); !written) {
                return report_error(written.error(), console);
            }
            text.clear();
        }
    }
    return report_result(output.value().commit(), console);
}

ExitStatus dump_plant(const DumpCommand& command, Grammar& grammar, const Console& console) {
    Plant plant;
    PlantOptions options = plant_options(command);
    options.origins = command.origins;
    Project project = make_project(console, command.run);
    PipelineProgress progress(console, project.host);
    Outcome<Plant> grown = grow_plant(options, grammar, project);
    progress.clear();
    ExitStatus status = console.take(std::move(grown), plant);
    if (status != ExitStatus::Ok) {
        return status;
    }
    if (command.stage == DumpStage::Skeleton) {
        OriginPrinter origins(grammar.bytecode);
        return write_lines(command, console, line_count(plant.skeleton),
                           [&](std::uint64_t line, std::string& text) {
                               append_line(plant.skeleton, line,
                                           command.origins ? &origins : nullptr, text);
                           });
    }
    MeshOptions mesh_options = command.mesh;
    mesh_options.segments = true;
    Mesh mesh;
    DetailLevels levels;
    mesh_options.level = 0;
    status =
        console.take(plan_plant_levels(
                         plant, plant.skeleton, mesh_options,
                         {.last = command.mesh.level, .first_fitted = command.mesh.level}, project),
                     levels);
    if (status != ExitStatus::Ok) {
        return status;
    }
    const std::size_t number =
        std::min<std::size_t>(command.mesh.level, levels.levels.size() - 1); // at most the coarsest
    status = console.take(
        mesh_plant_level(plant, plant.skeleton, levels, number, mesh_options, project), mesh);
    if (status != ExitStatus::Ok) {
        return status;
    }
    return write_lines(
        command, console, line_count(mesh),
        [&mesh](std::uint64_t line, std::string& text) { append_line(mesh, line, text); });
}

} // namespace

ExitStatus run_command(const DumpCommand& command, const Console& console) {
    if (const std::string conflict = find_conflict(command); !conflict.empty()) {
        return report_error(Error{conflict}, console);
    }
    if (command.stage == DumpStage::Tokens || command.stage == DumpStage::Ast) {
        return dump_syntax(command, console);
    }
    if (command.stage == DumpStage::Cache) {
        return dump_cache(command, console);
    }
    Grammar grammar;
    const ExitStatus status = console.take(
        load_grammar(command.file, command.grammar, make_project(console, command.run)), grammar);
    if (status != ExitStatus::Ok) {
        return status;
    }
    note_read(console.io().files, named_files(grammar.bytecode, command.file));
    switch (command.stage) {
    case DumpStage::Program:
        if (!grammar.program) {
            return report_missing_program(command, console);
        }
        return write_stage(command, dump_program(*grammar.program, grammar.names), console);
    case DumpStage::Instanced:
        if (!grammar.program) {
            return report_missing_program(command, console);
        }
        return dump_instanced(command, grammar, console);
    case DumpStage::Heroes:
        if (!grammar.program) {
            return report_missing_program(command, console);
        }
        return dump_heroes(command, grammar, console);
    case DumpStage::Bytecode:
        return write_stage(command, disassemble(grammar.bytecode), console);
    case DumpStage::Skeleton:
    case DumpStage::Mesh:
        grammar.program.reset();
        return dump_plant(command, grammar, console);
    case DumpStage::Environment:
        grammar.program.reset();
        return dump_environment(command, grammar, console);
    case DumpStage::Tokens:
    case DumpStage::Ast:
    case DumpStage::Cache:
    case DumpStage::Word:
        break;
    }
    grammar.program.reset(); // frees memory for the word
    return dump_word(command, grammar, console);
}

} // namespace lsys::lsc
