// SPDX-License-Identifier: MIT
// Turtle commands with more parameters than the turtle reads: `+(1, 2)`. Modules that productions
// rewrite may have more.
#include "compiler/lint/checks.h"
#include "compiler/lint/impl/places.h"
#include "compiler/resolve/profiles.h"

#include <fmt/format.h>

#include <vector>

namespace lsys {

namespace {

/// Number of parameters that the command reads in a module with `count` parameters. `'` reads one
/// (a colour index) or three (red, green, blue).
std::uint32_t parameters_read(const TurtleCommand& command, std::uint32_t count) {
    const bool is_index = operation_of(command, count) == TurtleOperation::SetColour;
    return is_index ? 1 : command.max_parameters;
}

void report(const CheckInput& input,
            const ProgramWord& word,
            std::size_t index,
            const TurtleCommand& command,
            Diagnostics& diagnostics) {
    const std::vector<SourceSpan> arguments = argument_spans(input, word, index);
    const std::uint32_t read =
        parameters_read(command, static_cast<std::uint32_t>(arguments.size()));
    const SourceSpan extra = read < arguments.size() ? join(arguments[read], arguments.back())
                                                     : module_name_span(input, word, index);
    Diagnostic& warning = diagnostics.add(DiagnosticCode::ExtraParameters, extra,
                                          fmt::format("{} reads {}; more have no effect",
                                                      quoted(command.name), parameters_text(read)));
    if (!command.parameters.empty()) {
        warning.notes.push_back(
            fmt::format("the parameters of {}: {}", quoted(command.name), command.parameters));
    }
}

} // namespace

void check_extra_parameters(const CheckInput& input, Diagnostics& diagnostics) {
    const Program& program = input.program;
    if (!program.has_all_statements) {
        return;
    }
    // By symbol: its turtle command, if the symbol has more parameters than the command reads; null
    // otherwise, and for symbols that are rewritten or have been reported.
    std::vector<const TurtleCommand*> exceeded(program.symbols.size(), nullptr);
    bool any = false;
    for (std::size_t i = 0; i < program.symbols.size(); ++i) {
        const Symbol& symbol = program.symbols[i];
        const TurtleCommand* command =
            symbol.parameter_count == 0 || symbol.turtle == TurtleOperation::Nothing
                ? nullptr
                : find_turtle_command(program.settings.turtle, input.name(symbol.name));
        if (command != nullptr && operation_of(*command, symbol.parameter_count) == symbol.turtle &&
            symbol.parameter_count > parameters_read(*command, symbol.parameter_count)) {
            exceeded[i] = command;
            any = true;
        }
    }
    if (!any) {
        return;
    }
    for (const Production& production : program.productions) {
        for (const ProgramPatternItem& item : production.predecessor.items) {
            exceeded[static_cast<std::size_t>(item.symbol)] = nullptr;
        }
    }
    const auto check_word = [&](const ProgramWord& word) {
        for_each_module(
            program, word, [&](std::size_t index, std::size_t, const ProgramModule& module) {
                const TurtleCommand*& command = exceeded[static_cast<std::size_t>(module.symbol)];
                if (command != nullptr) {
                    report(input, word, index, *command, diagnostics);
                    command = nullptr; // report each symbol once
                }
            });
    };
    for (const Axiom& axiom : program.axioms) {
        check_word(axiom.word);
    }
    for (const Production& production : program.productions) {
        check_word(production.successor);
    }
}

} // namespace lsys
