// SPDX-License-Identifier: MIT
// Stochastic alternatives that name their parameters differently.
#include "compiler/lint/checks.h"
#include "compiler/lint/impl/places.h"

#include <fmt/format.h>

#include <vector>

namespace lsys {

void check_formal_names(const CheckInput& input, Diagnostics& diagnostics) {
    const Program& program = input.program;
    // Per group: its first stochastic production with formals.
    std::vector<std::uint32_t> first(program.context_group_count, kNone);
    std::vector<bool> noted(program.context_group_count); // per group: it has been reported
    for (std::uint32_t i = 0; i < program.productions.size(); ++i) {
        const Production& production = program.productions[i];
        const std::uint32_t group = production.group;
        if (!production.stochastic || production.formals.empty() || noted[group]) {
            continue;
        }
        if (first[group] == kNone) {
            first[group] = i;
            continue;
        }
        const Production& other = program.productions[first[group]];
        for (std::size_t k = 0; k < production.formals.size(); ++k) {
            if (production.formals[k] != other.formals[k]) {
                Diagnostic& note = diagnostics.add(
                    DiagnosticCode::DifferentFormals, production.formal_spans[k],
                    fmt::format("this parameter is {} here and {} in another production of the "
                                "same choice",
                                quoted(input.name(production.formals[k])),
                                quoted(input.name(other.formals[k]))));
                note.labels.push_back({other.formal_spans[k], "here"});
                noted[group] = true;
                break;
            }
        }
    }
}

} // namespace lsys
