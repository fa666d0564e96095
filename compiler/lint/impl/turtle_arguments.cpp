// SPDX-License-Identifier: MIT
// Suspicious arguments of turtle commands: an angle in radians, a negative width, a colour
// component that is not from 0 to 1.
#include "compiler/lint/impl/lints.h"
#include "compiler/lint/impl/places.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace lsys {

namespace {

/// The angle in degrees if `value` looks like radians: a common fraction of a turn, rounded to
/// about four decimals. Nothing for other values.
std::optional<int> degrees_if_radians(float value) {
    constexpr double kPi = 3.14159265358979323846;
    constexpr std::array<int, 11> kDegrees{360, 270, 180, 150, 135, 120, 90, 60, 45, 36, 30};
    const double magnitude = std::fabs(static_cast<double>(value));
    for (const int degrees : kDegrees) {
        const double radians = degrees * kPi / 180.0;
        if (std::fabs(magnitude - radians) < 1e-4) {
            return value < 0.0F ? -degrees : degrees;
        }
    }
    return std::nullopt;
}

/// Whether arguments of modules with this symbol are checked.
bool is_checked(const Symbol& symbol) {
    return symbol.parameter_count != 0 &&
           (turns(symbol.turtle) || symbol.turtle == TurtleOperation::SetWidth ||
            symbol.turtle == TurtleOperation::SetRgb);
}

/// Reports the first colour component that is not from 0 to 1.
void check_colour(const CheckInput& input,
                  const ProgramWord& word,
                  std::size_t index,
                  std::size_t argument,
                  Diagnostics& diagnostics) {
    constexpr std::size_t kParts = 3;
    for (std::size_t i = 0; i < kParts; ++i) {
        const Value& value = input.program.value(input.program.arguments[argument + i]);
        const float part = value.opcode == Opcode::Literal ? value.literal : 0.0F;
        if (!(part < 0.0F) && !(part > 1.0F)) {
            continue;
        }
        const std::vector<SourceSpan> spans = argument_spans(input, word, index);
        Diagnostic& diagnostic = diagnostics.add(
            DiagnosticCode::ColourOutOfRange,
            i < spans.size() ? spans[i] : module_name_span(input, word, index),
            fmt::format("a colour component is from 0 to 1, not {}", number_text(part)));
        diagnostic.notes.emplace_back("the nearest of these values is drawn");
        if (part >= 2.0F && part <= 255.0F) {
            diagnostic.help.push_back(
                fmt::format("for components from 0 to 255, write `{} / 255`", number_text(part)));
        }
        return;
    }
}

void check_word(const CheckInput& input, const ProgramWord& word, Diagnostics& diagnostics) {
    const Program& program = input.program;
    for_each_module(
        program, word, [&](std::size_t index, std::size_t argument, const ProgramModule& module) {
            const Symbol& symbol = program.symbol(module.symbol);
            if (!is_checked(symbol)) {
                return;
            }
            if (symbol.turtle == TurtleOperation::SetRgb) {
                check_colour(input, word, index, argument, diagnostics);
                return;
            }
            const Value& value = program.value(program.arguments[argument]);
            if (value.opcode != Opcode::Literal) {
                return;
            }
            const auto place = [&] {
                const std::vector<SourceSpan> spans = argument_spans(input, word, index);
                return spans.empty() ? module_name_span(input, word, index) : spans.front();
            };
            if (symbol.turtle == TurtleOperation::SetWidth) {
                if (value.literal < 0.0F) {
                    Diagnostic& diagnostic =
                        diagnostics.add(DiagnosticCode::NegativeWidth, place(),
                                        fmt::format("a width of {}", number_text(value.literal)));
                    diagnostic.help.push_back(fmt::format("a width is a diameter: did you mean {}?",
                                                          number_text(-value.literal)));
                }
                return;
            }
            if (const std::optional<int> degrees = degrees_if_radians(value.literal)) {
                Diagnostic& diagnostic =
                    diagnostics.add(DiagnosticCode::LikelyRadians, place(),
                                    fmt::format("{} looks like radians, but angles are in degrees",
                                                number_text(value.literal)));
                Fix fix;
                fix.title = fmt::format("did you mean {} degrees?", *degrees);
                fix.edits = {{diagnostic.span, std::to_string(*degrees)}};
                fix.machine_applicable = false;
                diagnostic.fixes.push_back(std::move(fix));
            }
        });
}

} // namespace

void check_turtle_arguments(const CheckInput& input, Diagnostics& diagnostics) {
    const std::vector<Symbol>& symbols = input.program.symbols;
    if (std::none_of(symbols.begin(), symbols.end(), is_checked)) {
        return;
    }
    for (const Axiom& axiom : input.program.axioms) {
        check_word(input, axiom.word, diagnostics);
    }
    for (const Production& production : input.program.productions) {
        check_word(input, production.successor, diagnostics);
    }
}

} // namespace lsys
