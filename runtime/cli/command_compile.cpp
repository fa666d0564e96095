// SPDX-License-Identifier: MIT
#include "compiler/bytecode/module_file.h"
#include "runtime/cli/commands.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/pipeline/named_files.h"
#include "runtime/pipeline/portable_files.h"
#include "runtime/program/files.h"
#include "runtime/program/host.h"
#include "runtime/program/run_files.h"

#include <fmt/format.h>

namespace lsys::lsc {

ExitStatus run_command(const CompileCommand& command, const Console& console) {
    Grammar grammar;
    const ExitStatus status = console.take(
        load_grammar(command.file, command.grammar, make_project(console, command.run)), grammar);
    if (status != ExitStatus::Ok) {
        return status;
    }
    if (grammar.is_module_file) {
        console.error(fmt::format("`{}` is compiled already", shown_path(command.file)));
        return ExitStatus::Failure;
    }
    Bytecode& bytecode = grammar.bytecode;
    note_read(console.io().files, named_files(bytecode, command.file));
    if (command.grammar.generations) {
        bytecode.generations = command.grammar.generations;
    }
    if (command.seed) {
        bytecode.settings.has_seed = true;
        bytecode.settings.seed = *command.seed;
    }
    remove_machine_paths(bytecode);
    const std::string bytes = write_module_file(bytecode);
    if (const Result<void> written = write_file(command.output, bytes, console); !written) {
        return report_error(written.error(), console);
    }
    console.detail(fmt::format("`{}`: {} bytes, {} symbols, {} productions", command.output,
                               bytes.size(), bytecode.symbols.size(), bytecode.productions.size()));
    return ExitStatus::Ok;
}

} // namespace lsys::lsc
