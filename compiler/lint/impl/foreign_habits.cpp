// SPDX-License-Identifier: MIT
// Modules that mean something else in other programs: quotation marks around a word, a decimal
// comma, a width as the second parameter of `F`.
#include "compiler/lint/impl/lints.h"
#include "compiler/lint/impl/places.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace lsys {

namespace {

bool is_digits(std::string_view text) {
    return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

/// Reports `"F - - F"`: each `"` is a module that multiplies the step.
void check_quotes(const CheckInput& input, const ProgramWord& word, Diagnostics& diagnostics) {
    const Program& program = input.program;
    if (word.module_count < 3 || word.file == kNoFile) {
        return;
    }
    const std::string_view text = input.sources.file(word.file).text();
    const std::uint32_t first = word.first_module;
    const std::uint32_t last = word.first_module + word.module_count - 1;
    const auto is_quote = [&](std::uint32_t index) {
        const ProgramModule module = program.modules[index];
        return input.name(module.symbol) == "\"" &&
               program.symbol(module.symbol).parameter_count == 0 &&
               text.substr(module.begin, 1) == "\"";
    };
    if (!is_quote(first) || !is_quote(last)) {
        return;
    }
    const std::uint32_t begin = program.modules[first].begin;
    const std::uint32_t end = program.modules[last].begin;
    const std::string_view inside = text.substr(begin + 1, end - begin - 1);
    // Quotation marks have no blanks on their inner sides.
    if (end <= begin + 1 || inside.find('"') != std::string_view::npos || inside.front() == ' ' ||
        inside.back() == ' ') {
        return;
    }
    Diagnostic& diagnostic =
        diagnostics.add(DiagnosticCode::QuotedModules, {word.file, begin, begin + 1},
                        "modules are written without quotation marks: each `\"` is a module that "
                        "multiplies the step");
    diagnostic.labels.push_back({{word.file, end, end + 1}, "and so is this"});
    diagnostic.fixes.push_back(
        {fmt::format("write `{}`", inside),
         {{{word.file, begin, begin + 1}, ""}, {{word.file, end, end + 1}, ""}},
         false});
}

/// Reports a decimal comma: `F(0,75)`, meant as `F(0.75)`, has length 0 and spring constant 75.
void check_comma(const CheckInput& input,
                 SourceSpan module,
                 const std::vector<SourceSpan>& arguments,
                 Diagnostics& diagnostics) {
    const std::string_view first = input.sources.text(arguments[0]);
    const std::string_view second = input.sources.text(arguments[1]);
    if (first != "0" || !is_digits(second) || arguments[1].begin != arguments[0].end + 1) {
        return;
    }
    const SourceSpan both{module.file, arguments[0].begin, arguments[1].end};
    const std::string number = fmt::format("{}.{}", first, second);
    Diagnostic& diagnostic = diagnostics.add(
        DiagnosticCode::DecimalComma, both,
        fmt::format("these are two parameters, the length {} and the spring constant {}", first,
                    second));
    add_fix(diagnostic, fmt::format("a number has a decimal point: write `{}`", number), both,
            number, false);
}

/// Reports `F(l, w)` if the second parameter has a usual name of a width.
void check_width(const CheckInput& input,
                 std::string_view command,
                 const std::vector<SourceSpan>& arguments,
                 Diagnostics& diagnostics) {
    constexpr std::array<std::string_view, 8> kWidths{"w",         "wid",  "width",    "thick",
                                                      "thickness", "diam", "diameter", "radius"};
    const std::string_view second = input.sources.text(arguments[1]);
    if (std::find(kWidths.begin(), kWidths.end(), second) == kWidths.end() ||
        arguments[0].begin < 2) {
        return;
    }
    const SourceSpan name{arguments[0].file, arguments[0].begin - 2, arguments[1].end + 1};
    const std::string replacement =
        fmt::format("!({}) {}({})", second, command, input.sources.text(arguments[0]));
    Diagnostic& diagnostic =
        diagnostics.add(DiagnosticCode::WidthAsSpring, arguments[1],
                        fmt::format("the second parameter of `{}` is a spring constant for the "
                                    "physics, and does not change the width",
                                    command));
    const std::string_view text = input.sources.text(name);
    if (text.starts_with(fmt::format("{}(", command)) && text.ends_with(')')) {
        add_fix(diagnostic, fmt::format("`!` sets the width: write `{}`", replacement), name,
                replacement, false);
    } else {
        diagnostic.help.push_back(fmt::format("`!` sets the width: write `{}`", replacement));
    }
}

} // namespace

void check_foreign_habits(const CheckInput& input, Diagnostics& diagnostics) {
    const Program& program = input.program;
    bool is_width_reported = false;
    const auto check_word = [&](const ProgramWord& word) {
        check_quotes(input, word, diagnostics);
        for_each_module(
            program, word, [&](std::size_t index, std::size_t, const ProgramModule& module) {
                const Symbol& symbol = program.symbol(module.symbol);
                if (symbol.turtle != TurtleOperation::Forward || symbol.parameter_count != 2) {
                    return;
                }
                const std::vector<SourceSpan> arguments = argument_spans(input, word, index);
                if (arguments.size() != 2) {
                    return;
                }
                check_comma(input, module_span(input, word, index), arguments, diagnostics);
                if (!is_width_reported && !program.settings.has_spring) {
                    const std::uint64_t before = diagnostics.count(Severity::Note);
                    check_width(input, input.name(module.symbol), arguments, diagnostics);
                    is_width_reported = diagnostics.count(Severity::Note) != before;
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
