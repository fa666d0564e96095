#include "compiler/disassemble.h"
#include "compiler/instance.h"
#include "compiler/program_dump.h"
#include "grammar/ast_dump.h"
#include "grammar/tokens.h"
#include "runtime/cli/commands.h"
#include "runtime/cli/dump_word.h"
#include "runtime/cli/files.h"
#include "runtime/cli/grammar_file.h"
#include "runtime/cli/plant.h"
#include "runtime/cli/tell.h"
#include "runtime/scene.h"

#include <fmt/format.h>

#include <string>
#include <utility>

namespace lsys::lsc {

namespace {

/// Options that do not go together, in words; empty if all is well.
std::string find_conflict(const DumpCommand& command) {
    const bool saves = command.steps || !command.save_state.empty() || !command.from.empty();
    const bool meshes = command.stage == Stage::Mesh;
    const bool draws = meshes || command.stage == Stage::Skeleton;
    if (!meshes && command.mesh != MeshOptions{}) {
        return "only --stage mesh makes a mesh, so --method, --sides, --level, --deviation, "
               "--subdivisions, --bark-noise and --droop do not go with another stage";
    }
    if (meshes && command.origins) {
        return "a mesh names its segments, whose origins --stage skeleton prints: --origins does "
               "not go with --stage mesh";
    }
    if (draws && (command.all || command.count || saves)) {
        return "a plant is drawn from the last word, so --all, --count, --steps, --save-state and "
               "--from do not go with --stage skeleton or mesh";
    }
    if (draws) {
        return {};
    }
    if (command.rho && command.stage != Stage::Instanced) {
        return "only --stage instanced has a probability, so --rho does not go with another stage";
    }
    if (command.origins && command.count) {
        return "--count prints no modules, so --origins does not go with it";
    }
    if (command.stage != Stage::Word) {
        const bool derives = command.all || command.count || command.stream || command.origins ||
                             saves || command.seed;
        return derives ? "only --stage word derives, so --all, --count, --stream, --origins, "
                         "--seed, --steps, --save-state and --from do not go with another stage"
                       : "";
    }
    if (command.stream && (saves || command.all)) {
        return "--stream keeps no word, so --all, --steps, --save-state and --from do not go with "
               "it";
    }
    if (command.save_state == "-" && command.output == "-") {
        return "--save-state - and the word cannot both go to standard output; say where with -o";
    }
    return {};
}

Status write_stage(const DumpCommand& command, const std::string& text, const Console& console) {
    if (const Result<Done> written = write_file(command.output, text, console); !written) {
        return fail(written.error(), console);
    }
    return Status::Fine;
}

/// Tokens and the tree need no compiler, and are there for wrong grammars too.
Status dump_syntax(const DumpCommand& command, const Console& console) {
    Result<GrammarText> grammar = read_grammar(command.file, command.grammar.dialect, console);
    if (!grammar) {
        return fail(grammar.error(), console);
    }
    const Dialect dialect = grammar.value().dialect;
    if (command.stage == Stage::Tokens && dialect != Dialect::Lsys) {
        return fail(Error{fmt::format("--stage tokens shows those of .lsys, and `{}` is {}",
                                      shown_path(command.file), row_of(dialect).title)},
                    console);
    }
    if (const Result<Done> fine = check_system(command.file, dialect, command.grammar); !fine) {
        return fail(fine.error(), console);
    }
    SourceMap sources;
    Names names;
    Diagnostics diagnostics;
    const FileId root = sources.add(shown_path(command.file), std::move(grammar.value().bytes));
    const FileLoader load = make_loader(command.max_bytes, console);
    const ParseContext context{
        sources, names, diagnostics, load, command.grammar.bug_compatible, command.grammar.system};
    const std::string text = command.stage == Stage::Tokens
                                 ? dump_tokens(sources.file(root))
                                 : dump_ast(parse_dialect(root, dialect, context), names, sources);
    return worse(console.show(diagnostics, sources), write_stage(command, text, console));
}

/// What cannot be made from a compiled grammar.
Status lacks_program(const DumpCommand& command, const Console& console) {
    return fail(Error{fmt::format("`{}` is compiled; its program is not in it, --stage bytecode is",
                                  command.file)},
                console);
}

Status dump_instanced(const DumpCommand& command, const Grammar& grammar, const Console& console) {
    Diagnostics diagnostics;
    const std::optional<std::string> list =
        list_instanced(*grammar.program, grammar.names, grammar.sources,
                       command.rho.value_or(kSceneRho), diagnostics);
    const Status shown = console.show(diagnostics, grammar.sources);
    return list ? worse(shown, write_stage(command, *list, console)) : shown;
}

/// `append` puts line `i` of `lines` to the end of a text.
template <typename Append>
Status write_lines(const DumpCommand& command,
                   const Console& console,
                   std::uint64_t lines,
                   const Append& append) {
    Result<Output> output = Output::open(command.output, console);
    if (!output) {
        return fail(output.error(), console);
    }
    constexpr std::size_t kPieceOfText = std::size_t{1} << 18;
    std::string text;
    for (std::uint64_t line = 0; line < lines; ++line) {
        append(line, text);
        if (text.size() >= kPieceOfText || line + 1 == lines) {
            if (console.interrupted()) {
                return Status::Interrupted;
            }
            if (const Result<Done> written = output.value().write(text); !written) {
                return fail(written.error(), console);
            }
            text.clear();
        }
    }
    const Result<Done> done = output.value().commit();
    return done ? Status::Fine : fail(done.error(), console);
}

Status dump_plant(const DumpCommand& command, Grammar& grammar, const Console& console) {
    Plant plant;
    PlantRequest request = plant_request(command);
    request.origins = command.origins;
    Status status = grow_plant(request, grammar, console, plant);
    if (status != Status::Fine) {
        return status;
    }
    if (command.stage == Stage::Skeleton) {
        OriginPrinter origins(*grammar.bytecode);
        return write_lines(command, console, line_count(plant.skeleton),
                           [&](std::uint64_t line, std::string& text) {
                               append_line(plant.skeleton, line,
                                           command.origins ? &origins : nullptr, text);
                           });
    }
    MeshOptions options = command.mesh;
    options.threads = command.threads;
    options.max_bytes = command.max_bytes;
    options.segments = true;
    Mesh mesh;
    status = mesh_plant(plant, plant.skeleton, options, grammar, console, mesh);
    if (status != Status::Fine) {
        return status;
    }
    return write_lines(
        command, console, line_count(mesh),
        [&mesh](std::uint64_t line, std::string& text) { append_line(mesh, line, text); });
}

} // namespace

Status run_dump(const DumpCommand& command, const Console& console) {
    if (const std::string conflict = find_conflict(command); !conflict.empty()) {
        return fail(Error{conflict}, console);
    }
    if (command.stage == Stage::Tokens || command.stage == Stage::Ast) {
        return dump_syntax(command, console);
    }
    Grammar grammar;
    GrammarOptions options = command.grammar;
    options.max_bytes = command.max_bytes;
    const Status status = load_grammar(command.file, options, console, grammar);
    if (status != Status::Fine) {
        return status;
    }
    switch (command.stage) {
    case Stage::Program:
        if (!grammar.program) {
            return lacks_program(command, console);
        }
        return write_stage(command, dump_program(*grammar.program, grammar.names), console);
    case Stage::Instanced:
        if (!grammar.program) {
            return lacks_program(command, console);
        }
        return dump_instanced(command, grammar, console);
    case Stage::Bytecode:
        return write_stage(command, disassemble(*grammar.bytecode), console);
    case Stage::Skeleton:
    case Stage::Mesh:
        grammar.program.reset();
        return dump_plant(command, grammar, console);
    case Stage::Tokens:
    case Stage::Ast:
    case Stage::Word:
        break;
    }
    grammar.program.reset(); // the word wants its memory
    return dump_word(command, grammar, console);
}

} // namespace lsys::lsc
