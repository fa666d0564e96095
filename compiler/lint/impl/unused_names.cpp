// SPDX-License-Identifier: MIT
// Constants that nothing uses, and parameters that no production of a module reads.
#include "compiler/lint/impl/lints.h"
#include "compiler/lint/impl/places.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace lsys {

namespace {

/// Whether `name` is a setting that a constant of this name may be meant to set.
bool is_setting_name(std::string_view name) {
    constexpr std::array<std::string_view, 6> kNames{"angle", "step",  "width",
                                                     "seed",  "sides", "height"};
    return std::find(kNames.begin(), kNames.end(), name) != kNames.end();
}

void check_constants(const CheckInput& input, Diagnostics& diagnostics) {
    for (const Constant& constant : input.program.constants) {
        // An included file may define more than a grammar needs.
        if (constant.is_used || constant.span.file != input.program.axiom_span().file) {
            continue;
        }
        Diagnostic& diagnostic = diagnostics.add(
            DiagnosticCode::UnusedConstant, constant.span,
            fmt::format("constant {} is never used", quoted(input.name(constant.name))));
        const std::string_view name = input.name(constant.name);
        if (is_setting_name(name)) {
            const std::string_view text = input.sources.file(constant.span.file).text();
            const std::size_t hash = text.rfind('#', constant.span.begin);
            const std::size_t end = std::min(text.find(';', constant.span.end), text.size());
            const std::string value(text.substr(constant.span.end, end - constant.span.end));
            diagnostic.notes.push_back(
                fmt::format("it does not change the setting {}", quoted(name)));
            if (!constant.is_param && hash != std::string_view::npos) {
                add_fix(diagnostic, fmt::format("write `#set {}{};`", name, value),
                        {constant.span.file, static_cast<std::uint32_t>(hash), constant.span.begin},
                        "#set ", false);
            } else {
                diagnostic.help.push_back(fmt::format("`#set {0} {0};` uses it", name));
            }
            continue;
        }
        diagnostic.help.emplace_back("remove the statement, or use the name in an expression");
    }
}

void check_environments(const CheckInput& input, Diagnostics& diagnostics) {
    const Program& program = input.program;
    std::vector<bool> is_asked(program.environments.size(), false);
    for (const Symbol& symbol : program.symbols) {
        if (asks_environment(symbol.sense)) {
            is_asked[static_cast<std::size_t>(symbol.sense)] = true;
        }
    }
    for (std::size_t i = 0; i < is_asked.size(); ++i) {
        const ProgramEnvironment& environment = program.environments[i];
        // An included file may declare more than a grammar needs.
        if (is_asked[i] || environment.name_span.file != program.axiom_span().file) {
            continue;
        }
        const std::string_view name = input.name(environment.name);
        Diagnostic& diagnostic =
            diagnostics.add(DiagnosticCode::UnusedEnvironment, environment.name_span,
                            fmt::format("no module asks environment {}", quoted(name)));
        diagnostic.help.push_back(fmt::format(
            "write a module `?{}{}` where the plant senses, or remove the statement", name,
            environment.values.kind == EnvironmentKind::Program
                ? std::string("(x)")
                : zero_arguments(answer_size(environment.values.kind))));
    }
}

/// The formals that a production reads.
std::vector<bool> used_formals(const Program& program, const Production& production) {
    std::vector<bool> used(production.formals.size(), false);
    for_each_value(program, expressions_of(program, production), [&](ValueId, const Value& value) {
        if (value.opcode == Opcode::Formal && value.index < used.size()) {
            used[value.index] = true;
        }
    });
    return used;
}

/// Reports parameters of predecessors that no production of the module reads. Contexts may have
/// unread parameters; the turtle reads the parameters of a module that draws.
void check_formals(const CheckInput& input, Diagnostics& diagnostics) {
    const Program& program = input.program;
    std::vector<std::vector<bool>> used(program.symbols.size());
    std::vector<std::uint32_t> first(program.symbols.size(), kNone);
    for (std::uint32_t p = 0; p < program.productions.size(); ++p) {
        const Production& production = program.productions[p];
        if (production.formals.empty()) {
            continue;
        }
        const std::vector<bool> here = used_formals(program, production);
        for (const ProgramPattern* pattern :
             {&production.left, &production.predecessor, &production.right}) {
            const bool rewritten = pattern == &production.predecessor;
            for (const ProgramPatternItem& item : pattern->items) {
                if (item.kind != PatternKind::Module) {
                    continue;
                }
                const auto s = static_cast<std::size_t>(item.symbol);
                const std::uint32_t count = program.symbol(item.symbol).parameter_count;
                used[s].resize(count, false);
                for (std::uint32_t i = 0; i < count; ++i) {
                    used[s][i] = used[s][i] || here[item.first_formal + i];
                }
                if (rewritten && first[s] == kNone) {
                    first[s] = p;
                }
            }
        }
    }
    for (std::uint32_t s = 0; s < program.symbols.size(); ++s) {
        // The parameters of a sense module are all numbers of an answer; a production may need only
        // some.
        if (first[s] == kNone || program.symbols[s].turtle != TurtleOperation::Nothing ||
            program.symbols[s].sense != Sense::Nothing) {
            continue;
        }
        const Production& production = program.productions[first[s]];
        for (const ProgramPatternItem& item : production.predecessor.items) {
            if (item.symbol != SymbolId{s}) {
                continue;
            }
            for (std::uint32_t i = 0; i < used[s].size(); ++i) {
                const std::uint32_t formal = item.first_formal + i;
                const std::string_view name = input.name(production.formals[formal]);
                if (used[s][i] || name.starts_with('_')) {
                    continue;
                }
                Diagnostic& diagnostic =
                    diagnostics.add(DiagnosticCode::UnusedFormal, production.formal_spans[formal],
                                    fmt::format("no production reads parameter {} of {}",
                                                quoted(name), quoted(input.name(SymbolId{s}))));
                diagnostic.help.push_back(fmt::format(
                    "leave the parameter out, or call it `_{}` if that is meant", name));
            }
            break;
        }
    }
}

} // namespace

void check_unused_names(const CheckInput& input, Diagnostics& diagnostics) {
    check_constants(input, diagnostics);
    check_environments(input, diagnostics);
    check_formals(input, diagnostics);
}

} // namespace lsys
