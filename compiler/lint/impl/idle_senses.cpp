// SPDX-License-Identifier: MIT
// Sense modules that never get an answer: those that only #interpret writes, because a word is
// sensed before it is interpreted; and those without parameters, if no production reads them and
// their environment does not compute answers from the places of other modules.
#include "compiler/lint/impl/lints.h"
#include "compiler/lint/impl/places.h"

#include <fmt/format.h>

#include <vector>

namespace lsys {

namespace {

class IdleSenses {
public:
    IdleSenses(const CheckInput& input, Diagnostics& diagnostics)
        : program_(input.program), input_(input), diagnostics_(diagnostics),
          is_written_(program_.symbols.size(), false), is_matched_(program_.symbols.size(), false) {
    }

    void run() {
        for (const Axiom& axiom : program_.axioms) {
            note_word(axiom.word);
        }
        for (const Production& production : program_.productions) {
            if (production.stage != Stage::Interpret) {
                note_word(production.successor);
            }
            for (const ProgramPattern* pattern :
                 {&production.left, &production.predecessor, &production.right}) {
                for (const ProgramPatternItem& item : pattern->items) {
                    if (item.kind == PatternKind::Module) {
                        is_matched_[static_cast<std::size_t>(item.symbol)] = true;
                    }
                }
            }
        }
        for (const Production& production : program_.productions) {
            if (production.stage == Stage::Interpret) {
                check_interpreted(production.successor);
            }
        }
        for (const Axiom& axiom : program_.axioms) {
            check_places(axiom.word);
        }
        for (const Production& production : program_.productions) {
            check_places(production.successor);
        }
    }

private:
    void note_word(const ProgramWord& word) {
        for_each_symbol(program_, word, [&](std::size_t, SymbolId symbol) {
            is_written_[static_cast<std::size_t>(symbol)] = true;
        });
    }

    void check_interpreted(const ProgramWord& word) {
        for_each_symbol(program_, word, [&](std::size_t index, SymbolId symbol) {
            const Symbol& row = program_.symbol(symbol);
            if (row.sense == Sense::Nothing || is_written_[static_cast<std::size_t>(symbol)]) {
                return;
            }
            is_written_[static_cast<std::size_t>(symbol)] = true; // report each once
            is_matched_[static_cast<std::size_t>(symbol)] = true;
            Diagnostic& warning =
                diagnostics_.add(DiagnosticCode::NeverSenses, module_name_span(input_, word, index),
                                 fmt::format("{} senses nothing: only `#interpret` writes it",
                                             quoted(input_.name(row.name))));
            warning.notes.emplace_back("a word is sensed before it is interpreted; sense modules "
                                       "of an interpretation are skipped");
            warning.help.emplace_back("write it in the axiom or in a successor of rewriting, and "
                                      "read its answer in the condition of the `#interpret`");
        });
    }

    /// Whether an answer of the environment at one place depends on the other places.
    [[nodiscard]] bool looks_at_places(Sense sense) const {
        if (!asks_environment(sense)) {
            return false;
        }
        const EnvironmentKind kind =
            program_.environments[static_cast<std::size_t>(sense)].values.kind;
        return kind != EnvironmentKind::Sky && kind != EnvironmentKind::Solid &&
               kind != EnvironmentKind::Map;
    }

    void check_places(const ProgramWord& word) {
        for_each_symbol(program_, word, [&](std::size_t index, SymbolId symbol) {
            const Symbol& row = program_.symbol(symbol);
            if (row.sense == Sense::Nothing || row.parameter_count != 0 ||
                is_matched_[static_cast<std::size_t>(symbol)] || looks_at_places(row.sense)) {
                return;
            }
            is_matched_[static_cast<std::size_t>(symbol)] = true; // report each once
            Diagnostic& warning = diagnostics_.add(
                DiagnosticCode::NeverSenses, module_name_span(input_, word, index),
                fmt::format("{} has no parameter for an answer, and nothing else uses it",
                            quoted(input_.name(row.name))));
            warning.help.push_back(fmt::format(
                "give it parameters, which sensing overwrites: `{}{}`", input_.name(row.name),
                zero_arguments(
                    asks_environment(row.sense)
                        ? answer_size(program_.environments[static_cast<std::size_t>(row.sense)]
                                          .values.kind)
                        : 3)));
        });
    }

    const Program& program_;
    const CheckInput& input_;
    Diagnostics& diagnostics_;
    std::vector<bool> is_written_; // by symbol: the axiom or rewriting writes it
    std::vector<bool> is_matched_; // by symbol: a production reads it, or it is reported
};

} // namespace

void check_idle_senses(const CheckInput& input, Diagnostics& diagnostics) {
    for (const Symbol& symbol : input.program.symbols) {
        if (symbol.sense != Sense::Nothing) {
            IdleSenses(input, diagnostics).run();
            return;
        }
    }
}

} // namespace lsys
