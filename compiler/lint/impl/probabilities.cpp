// SPDX-License-Identifier: MIT
// A probability without effect, because its production is the only choice.
#include "compiler/lint/impl/lints.h"
#include "compiler/lint/impl/places.h"

#include <fmt/format.h>

namespace lsys {

void check_probabilities(const CheckInput& input, Diagnostics& diagnostics) {
    const Program& program = input.program;
    std::vector<std::uint32_t> members(program.context_group_count, 0);
    for (const Production& production : program.productions) {
        if (production.stochastic && production.group < members.size()) {
            ++members[production.group];
        }
    }
    for (const Production& production : program.productions) {
        // A probability of 1 is correct. A single production without condition must have 1 unless
        // `weights any` is set.
        const bool must_be_one =
            production.condition == kNoValue && program.settings.weights == WeightRule::One;
        if (!production.stochastic || production.group >= members.size() ||
            members[production.group] != 1 || production.weight == 1.0F ||
            production.weight_value != kNoValue || must_be_one) {
            continue;
        }
        const SymbolId symbol = production.predecessor.items.front().symbol;
        Diagnostic& diagnostic = diagnostics.add(
            DiagnosticCode::LoneProbability, production.weight_span,
            fmt::format("the probability of {} has no effect: no other production of {} shares it",
                        quoted(input.name(production.name)), quoted(input.name(symbol))));
        diagnostic.notes.emplace_back("probabilities are weights among the productions that match; "
                                      "a single one is always taken");
        diagnostic.help.push_back(fmt::format(
            "add the other cases, or {}",
            production.condition == kNoValue ? "write `*`" : "leave out the `~` and its number"));
    }
}

} // namespace lsys
