// SPDX-License-Identifier: MIT
#include "compiler/resolve/impl/words.h"

#include "compiler/resolve/profiles.h"
#include "grammar/base/cancellation.h"

#include <fmt/format.h>

#include <utility>

namespace lsys {

bool check_module(ModuleReading& reading, const ModuleView& module) {
    const Resolution& resolution = reading.resolution;
    const std::string_view name = resolution.text(module.name);
    if (module.arguments.count != 0 && takes_no_parameters(name)) {
        const SourceSpan parentheses{module.span.file, module.name_span.end, module.span.end};
        Diagnostic& error = reading.resolution.diagnostics.add(
            DiagnosticCode::UnexpectedParameters, parentheses,
            fmt::format("`{}` takes no parameters", resolution.names.written(module.name)));
        error.fixes.push_back({"remove them", {{parentheses, ""}}, false});
        return false;
    }
    return reading.environments.check_name(module.name, module.name_span);
}

namespace {

/// Appends a module, or the modules that its name is split into. The last of them gets the
/// arguments.
void append_module(ModuleReading& reading, const ModuleView& module) {
    Program& program = reading.resolution.program;
    const std::uint32_t count = module.arguments.count;
    const std::uint32_t begin = module.name_span.begin;
    const std::span<const NamePart> parts =
        module.is_indivisible ? std::span<const NamePart>{}
                              : reading.splitter.parts(module.name, count, module.span.file);
    if (parts.empty()) {
        const SymbolId symbol = reading.symbols.get(module.name, count);
        program.modules.push_back({symbol, begin});
        if (count == 0 && !reading.splitter.may_split(module.name)) {
            reading.bare[index_of(module.name)] = symbol;
        }
        return;
    }
    reading.splits.add(module.name_span, module.span, parts);
    for (const NamePart& part : parts) {
        const bool is_last = &part == &parts.back();
        program.modules.push_back(
            {reading.symbols.get(part.name, is_last ? count : 0), begin + part.offset});
    }
}

/// Appends modules from `index` on up to the first that has arguments or no cached symbol, and
/// returns its index. Nearly all modules of a long word are appended here.
std::uint32_t append_bare(ModuleReading& reading, std::uint32_t index, std::uint32_t end) {
    ChunkedVector<ProgramModule>& program_modules = reading.resolution.program.modules;
    const std::span<const SymbolId> bare = reading.bare;
    while (index < end) {
        stop_if_cancelled();
        const std::span<const ModuleNode> nodes =
            std::as_const(reading.resolution.ast.modules).row(index, end - index);
        const std::span<ProgramModule> row = program_modules.extend(nodes.size());
        std::size_t taken = 0;
        for (; taken < row.size(); ++taken) {
            const ModuleNode node = nodes[taken];
            if (node.bare_name() >= bare.size() || bare[node.bare_name()] == kNoSymbol) {
                break;
            }
            row[taken] = {bare[node.bare_name()], node.begin};
        }
        index += static_cast<std::uint32_t>(taken);
        if (taken != row.size()) {
            program_modules.truncate(program_modules.size() - (row.size() - taken));
            break;
        }
        reading.resolution.ast.modules.release_before(index);
    }
    return index;
}

} // namespace

ProgramWord resolve_word(ModuleReading& reading, ModuleList list, ExpressionPlace place) {
    Resolution& resolution = reading.resolution;
    Program& program = resolution.program;
    ProgramWord word;
    word.file = list.span.file;
    word.span = list.span;
    word.first_module = static_cast<std::uint32_t>(program.modules.size());
    word.first_argument = static_cast<std::uint32_t>(program.arguments.size());
    ModuleCursor cursor(resolution.ast, resolution.names, resolution.sources, list);
    while (!cursor.done()) {
        const std::uint32_t index = append_bare(reading, cursor.index(), list.first + list.count);
        cursor.skip_bare(index);
        if (cursor.done()) {
            break;
        }
        const ModuleView module = cursor.view();
        cursor.next();
        const std::string_view name = resolution.text(module.name);
        const std::uint32_t count = module.arguments.count;
        const bool may_fail = (count != 0 && name.size() == 1) || name.starts_with('?');
        if (may_fail && !check_module(reading, module)) {
            continue;
        }
        append_module(reading, module);
        for (std::uint32_t i = 0; i < count; ++i) {
            const ExpressionId argument =
                resolution.ast.expression_lists[module.arguments.first + i];
            program.arguments.push_back(reading.expressions.resolve(argument, place));
        }
        resolution.ast.modules.release_before(index);
    }
    word.module_count = static_cast<std::uint32_t>(program.modules.size()) - word.first_module;
    word.draw_count = reading.expressions.draw_count();
    return word;
}

} // namespace lsys
