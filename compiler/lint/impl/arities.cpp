// SPDX-License-Identifier: MIT
// Modules with a number of parameters that no production rewrites, although productions rewrite
// modules of the same name with another number of parameters.
#include "compiler/lint/impl/module_use.h"
#include "compiler/lint/impl/places.h"

#include <fmt/format.h>

#include <algorithm>

namespace lsys {

namespace {

/// Offers a random range in place of two neighbouring constant arguments: `R({0, 100})` for
/// `R(0, 100)`.
std::optional<Fix> range_fix(const CheckInput& input,
                             const ModuleMention& place,
                             std::uint32_t wanted,
                             std::uint32_t used) {
    if (used != wanted + 1) {
        return std::nullopt;
    }
    std::optional<std::size_t> first;
    for_each_module(input.program, *place.word,
                    [&](std::size_t index, std::size_t argument, const ProgramModule&) {
                        if (index == place.index) {
                            first = argument;
                        }
                    });
    const std::vector<SourceSpan> spans = argument_spans(input, *place.word, place.index);
    if (!first || spans.size() != used) {
        return std::nullopt;
    }
    for (std::uint32_t i = 0; i + 1 < used; ++i) {
        const Value& low = input.program.value(input.program.arguments[*first + i]);
        const Value& high = input.program.value(input.program.arguments[*first + i + 1]);
        if (low.opcode != Opcode::Literal || high.opcode != Opcode::Literal ||
            !(low.literal < high.literal)) {
            continue;
        }
        const SourceSpan both = join(spans[i], spans[i + 1]);
        Fix fix;
        fix.edits = {{both, fmt::format("{{{}}}", input.sources.text(both))}};
        fix.machine_applicable = false;
        const SourceSpan module = module_span(input, *place.word, place.index);
        std::string text(input.sources.text(module));
        text.insert(both.end - module.begin, "}");
        text.insert(both.begin - module.begin, "{");
        fix.title = fmt::format("did you mean the random range `{}`?", text);
        return fix;
    }
    return std::nullopt;
}

/// Offers first values for a module that has no arguments in an axiom: `A(1)` if a production
/// replaces `A(len)`.
std::optional<Fix> first_values_fix(const CheckInput& input,
                                    const ModuleMention& place,
                                    const Production& production,
                                    std::uint32_t wanted) {
    constexpr std::uint32_t kMaxValues = 4; // max number of arguments that a fix writes
    const std::vector<Axiom>& axioms = input.program.axioms;
    const bool in_axiom = std::any_of(axioms.begin(), axioms.end(), [&](const Axiom& axiom) {
        return &axiom.word == place.word;
    });
    const SourceSpan module = module_span(input, *place.word, place.index);
    const std::string name(input.sources.text(module));
    if (!in_axiom || production.predecessor.items.size() != 1 || wanted > kMaxValues ||
        production.formal_spans.size() != wanted || name.find('(') != std::string::npos) {
        return std::nullopt;
    }
    std::string values = "1";
    std::string names = fmt::format("`{}`", input.sources.text(production.formal_spans[0]));
    for (std::uint32_t i = 1; i < wanted; ++i) {
        values += ", 1";
        names += fmt::format("{}`{}`", i + 1 == wanted ? " and " : ", ",
                             input.sources.text(production.formal_spans[i]));
    }
    Fix fix;
    fix.title =
        wanted == 1
            ? fmt::format("write `{}({})` here, 1 being the first value of {}", name, values, names)
            : fmt::format("write `{}({})` here, the first values of {}", name, values, names);
    fix.edits = {{{module.file, module.end, module.end}, "(" + values + ")"}};
    fix.machine_applicable = false;
    return fix;
}

} // namespace

void check_arities(const CheckInput& input, ModuleUse& use, Diagnostics& diagnostics) {
    const Program& program = input.program;
    for (std::uint32_t s = 0; s < program.symbols.size(); ++s) {
        const auto symbol = SymbolId{s};
        const Symbol& row = program.symbols[s];
        // A sense module without parameters gets no answer; it marks a place that the answers of
        // other sense modules depend on.
        const bool is_place = row.sense != Sense::Nothing && row.parameter_count == 0;
        if (is_place || !use.reachable.occurs(symbol) || use.first_production[s] != kNone ||
            use.declared[s] || row.kind != SymbolKind::Plain || row.ignored) {
            continue;
        }
        // Among the rewritten modules of this name, the one with the nearest number of parameters.
        SymbolId nearest = kNoSymbol;
        bool any_used = false;
        for (const SymbolId other : use.same_name(program, symbol)) {
            const auto o = static_cast<std::size_t>(other);
            if (use.first_production[o] == kNone) {
                continue;
            }
            any_used = any_used || use.reachable.occurs(other);
            const auto distance = [&](SymbolId id) {
                const std::int64_t count = program.symbol(id).parameter_count;
                return std::abs(count - std::int64_t{row.parameter_count});
            };
            if (nearest == kNoSymbol || distance(other) < distance(nearest)) {
                nearest = other;
            }
        }
        // A turtle command may be used with two numbers of parameters, one of which is not
        // rewritten.
        if (nearest == kNoSymbol || (row.turtle != TurtleOperation::Nothing && any_used)) {
            continue;
        }
        const ModuleMention place = use.first_place[s];
        const std::uint32_t wanted = program.symbol(nearest).parameter_count;
        const Production& production =
            program.productions[use.first_production[static_cast<std::size_t>(nearest)]];
        Diagnostic& diagnostic = diagnostics.add(
            DiagnosticCode::ArityMismatch, module_span(input, *place.word, place.index),
            fmt::format("module {} is used with {}, but rewritten with {}",
                        quoted(input.name(symbol)), parameters_text(row.parameter_count),
                        wanted == 0 ? std::string("none") : std::to_string(wanted)));
        for (const ProgramPatternItem& item : production.predecessor.items) {
            if (item.symbol == nearest) {
                diagnostic.labels.push_back(
                    {item_span(production, item),
                     fmt::format("rewritten with {} here", parameters_text(wanted))});
                break;
            }
        }
        diagnostic.notes.emplace_back(
            "a module is known by its name and its number of parameters; one that matches no "
            "production stays as it is");
        std::optional<Fix> fix = range_fix(input, place, wanted, row.parameter_count);
        if (!fix && row.parameter_count == 0) {
            fix = first_values_fix(input, place, production, wanted);
        }
        if (fix) {
            diagnostic.fixes.push_back(std::move(*fix));
        } else if (row.parameter_count > wanted) {
            diagnostic.help.push_back(fmt::format("leave out {}, or add a production for {}",
                                                  parameters_text(row.parameter_count - wanted),
                                                  parameters_text(row.parameter_count)));
        } else {
            diagnostic.help.push_back(
                fmt::format("give it {}, or declare it with `#module`", parameters_text(wanted)));
        }
        use.reported[s] = true;
        use.reported[static_cast<std::size_t>(nearest)] = true;
    }
}

} // namespace lsys
