// SPDX-License-Identifier: MIT
#include "compiler/bytecode/module_file.h"
#include "grammar/base/paths.h"
#include "runtime/cli/commands.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/program/files.h"
#include "runtime/program/host.h"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

namespace lsys::lsc {

namespace {

/// Makes the paths of a bytecode, relative to the folder of `grammar`, relative to that of `output`.
/// Standard output has no folder: the paths stay as they are.
void move_paths(const std::string& grammar, const std::string& output, Bytecode& bytecode) {
    namespace fs = std::filesystem;
    if (output == "-") {
        return;
    }
    std::error_code error;
    const auto folder_of = [&](const std::string& file) {
        const fs::path folder = path_of(file).parent_path();
        return error ? fs::path() : fs::weakly_canonical(folder.empty() ? "." : folder, error);
    };
    const fs::path from = folder_of(grammar);
    const fs::path to = folder_of(output);
    if (error || from == to) {
        return;
    }
    const fs::path between = from.lexically_relative(to);
    const fs::path& way = between.empty() ? from : between; // empty: on another drive
    const auto move = [&](std::string& path) {
        if (!path.empty()) {
            path = path_text(way / path_of(path)); // an absolute path stays
        }
    };
    for (BytecodeSymbol& symbol : bytecode.symbols) {
        move(symbol.mesh_file);
    }
    for (BytecodeMaterial& material : bytecode.materials) {
        move(material.picture.path);
        move(material.normal.path);
    }
    for (BytecodeEnvironment& environment : bytecode.environments) {
        for (EnvironmentSurface& surface : environment.surfaces) {
            move(surface.path);
        }
    }
}

} // namespace

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
    if (command.grammar.generations) {
        bytecode.generations = command.grammar.generations;
    }
    if (command.seed) {
        bytecode.settings.has_seed = true;
        bytecode.settings.seed = *command.seed;
    }
    move_paths(command.file, command.output, bytecode);
    const std::string bytes = write_module_file(bytecode);
    if (const Result<void> written = write_file(command.output, bytes, console); !written) {
        return report_error(written.error(), console);
    }
    console.detail(fmt::format("`{}`: {} bytes, {} symbols, {} productions", command.output,
                               bytes.size(), bytecode.symbols.size(), bytecode.productions.size()));
    return ExitStatus::Ok;
}

} // namespace lsys::lsc
