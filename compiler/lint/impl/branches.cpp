// SPDX-License-Identifier: MIT
// Brackets that do not balance within the axiom or a successor.
#include "compiler/lint/impl/lints.h"
#include "compiler/lint/impl/places.h"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace lsys {

namespace {

/// The brackets without a partner in one word.
struct Unbalanced {
    const ProgramWord& word;
    const char* where;             // "axiom", "successor"
    std::vector<std::size_t> open; // indices of each `[` without a `]`
    std::size_t first_extra = 0;   // index of the first `]` without a `[`
    std::uint64_t extra_count = 0;
};

Unbalanced read_word(const CheckInput& input,
                     const std::vector<SymbolKind>& kinds,
                     const ProgramWord& word,
                     const char* where) {
    Unbalanced found{word, where, {}, 0, 0};
    for_each_symbol(input.program, word, [&](std::size_t index, SymbolId symbol) {
        const SymbolKind kind = kinds[static_cast<std::size_t>(symbol)];
        if (kind == SymbolKind::BranchOpen) {
            found.open.push_back(index);
        } else if (kind == SymbolKind::BranchClose) {
            if (!found.open.empty()) {
                found.open.pop_back();
            } else if (++found.extra_count == 1) {
                found.first_extra = index;
            }
        }
    });
    return found;
}

/// Reports a `[` of one word and the `]` of another, which may belong together.
void report_crossing(const CheckInput& input,
                     const Unbalanced& opens,
                     const Unbalanced& closes,
                     Diagnostics& diagnostics) {
    Diagnostic& diagnostic = diagnostics.add(
        DiagnosticCode::UnclosedBranch, module_name_span(input, opens.word, opens.open.front()),
        fmt::format("`[` of this {} can only be closed by the `]` of another {}", opens.where,
                    closes.where));
    diagnostic.labels.push_back(
        {module_name_span(input, closes.word, closes.first_extra), "this `]` closes none here"});
    diagnostic.notes.emplace_back("a `]` that finds no `[` in the derived word is an error, with "
                                  "generation and place");
    diagnostic.help.emplace_back("write `[` and its `]` in the same successor");
}

void report_word(const CheckInput& input, const Unbalanced& found, Diagnostics& diagnostics) {
    const auto& [word, where, open, first_extra, extra_count] = found;
    const auto more = [](std::uint64_t count) {
        return count < 2 ? std::string() : fmt::format(", and {} more", count - 1);
    };
    if (extra_count != 0) {
        Diagnostic& diagnostic = diagnostics.add(
            DiagnosticCode::UnopenedBranch, module_name_span(input, word, first_extra),
            fmt::format("`]` closes no branch of this {}{}", where, more(extra_count)));
        diagnostic.notes.emplace_back(
            "a derived word with a `]` that has no `[` is an error, with generation and place");
        diagnostic.help.emplace_back("remove it, or write the `[` that it closes");
    }
    if (!open.empty()) {
        Diagnostic& diagnostic = diagnostics.add(
            DiagnosticCode::UnclosedBranch, module_name_span(input, word, open.front()),
            fmt::format("`[` is closed nowhere in this {}{}", where, more(open.size())));
        diagnostic.notes.emplace_back(
            "a branch that is still open at the end of a word is closed there");
        Fix fix;
        fix.title = open.size() == 1 ? "close it at the end of the " + std::string(where)
                                     : "close them at the end of the " + std::string(where);
        std::string brackets;
        for (std::size_t i = 0; i < open.size(); ++i) {
            brackets += " ]";
        }
        fix.edits = {{{word.file, word.span.end, word.span.end}, brackets}};
        // The place where the author meant the branch to end is a guess.
        fix.machine_applicable = false;
        if (open.size() <= 16) {
            diagnostic.fixes.push_back(std::move(fix));
        }
    }
}

} // namespace

void check_branches(const CheckInput& input, Diagnostics& diagnostics) {
    std::vector<SymbolKind> kinds; // per symbol: Symbol::kind
    bool any = false;
    for (const Symbol& symbol : input.program.symbols) {
        kinds.push_back(symbol.kind);
        any =
            any || symbol.kind == SymbolKind::BranchOpen || symbol.kind == SymbolKind::BranchClose;
    }
    if (!any) {
        return;
    }
    std::vector<Unbalanced> words;
    const auto read = [&](const ProgramWord& word, const char* where) {
        Unbalanced found = read_word(input, kinds, word, where);
        if (!found.open.empty() || found.extra_count != 0) {
            words.push_back(std::move(found));
        }
    };
    for (const Axiom& axiom : input.program.axioms) {
        read(axiom.word, "axiom");
    }
    for (const Production& production : input.program.productions) {
        read(production.successor, "successor");
    }
    if (words.size() == 2) {
        const std::size_t opens = words[0].open.empty() ? 1 : 0;
        const Unbalanced& closes = words[1 - opens];
        if (words[opens].extra_count == 0 && closes.open.empty()) {
            report_crossing(input, words[opens], closes, diagnostics);
            return;
        }
    }
    for (const Unbalanced& found : words) {
        report_word(input, found, diagnostics);
    }
}

} // namespace lsys
