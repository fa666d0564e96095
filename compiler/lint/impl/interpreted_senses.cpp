// SPDX-License-Identifier: MIT
// Sense modules that only #interpret writes. They are in no word, so nothing answers them.
#include "compiler/lint/impl/lints.h"
#include "compiler/lint/impl/places.h"

#include <fmt/format.h>

#include <vector>

namespace lsys {

void check_interpreted_senses(const CheckInput& input, Diagnostics& diagnostics) {
    const Program& program = input.program;
    std::vector<bool> is_in_words(program.symbols.size(), false);
    const auto add = [&](const ProgramWord& word) {
        for_each_symbol(program, word, [&](std::size_t, SymbolId symbol) {
            is_in_words[static_cast<std::size_t>(symbol)] = true;
        });
    };
    bool any_senses = false;
    for (const Symbol& symbol : program.symbols) {
        any_senses = any_senses || symbol.sense != Sense::Nothing;
    }
    if (!any_senses || !program.has_all_statements) {
        return;
    }
    for (const Axiom& axiom : program.axioms) {
        add(axiom.word);
    }
    for (const Production& production : program.productions) {
        if (production.stage != Stage::Interpret) {
            add(production.successor);
        }
    }
    for (const Production& production : program.productions) {
        if (production.stage != Stage::Interpret) {
            continue;
        }
        for_each_symbol(program, production.successor, [&](std::size_t index, SymbolId symbol) {
            const Symbol& row = program.symbol(symbol);
            if (row.sense == Sense::Nothing || is_in_words[static_cast<std::size_t>(symbol)]) {
                return;
            }
            is_in_words[static_cast<std::size_t>(symbol)] = true; // report each once
            Diagnostic& warning = diagnostics.add(
                DiagnosticCode::NeverSenses, module_name_span(input, production.successor, index),
                fmt::format("{} senses nothing: only `#interpret` writes it",
                            quoted(input.name(row.name))));
            warning.notes.emplace_back("a word is sensed before it is interpreted; sense "
                                       "modules of an interpretation are skipped");
            warning.help.emplace_back("write it in the axiom or in a successor of rewriting, "
                                      "and read its answer in the condition of the "
                                      "`#interpret`");
        });
    }
}

} // namespace lsys
