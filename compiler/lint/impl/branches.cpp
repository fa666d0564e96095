// Brackets that do not balance within the axiom or a successor.
#include "compiler/lint/impl/lints.h"
#include "compiler/lint/impl/places.h"

#include <fmt/format.h>

#include <vector>

namespace lsys {

namespace {

void check_word(const CheckInput& input,
                const std::vector<SymbolKind>& kinds,
                const ProgramWord& word,
                const char* where,
                Diagnostics& diagnostics) {
    std::vector<std::size_t> open;
    std::vector<std::size_t> extra; // the first `]` without `[`
    std::uint64_t extra_count = 0;
    for_each_symbol(input.program, word, [&](std::size_t index, SymbolId symbol) {
        const SymbolKind kind = kinds[static_cast<std::size_t>(symbol)];
        if (kind == SymbolKind::BranchOpen) {
            open.push_back(index);
        } else if (kind == SymbolKind::BranchClose) {
            if (!open.empty()) {
                open.pop_back();
            } else if (++extra_count == 1) {
                extra.push_back(index);
            }
        }
    });
    const auto more = [](std::uint64_t count) {
        return count < 2 ? std::string() : fmt::format(", and {} more", count - 1);
    };
    if (extra_count != 0) {
        Diagnostic& diagnostic = diagnostics.add(
            DiagnosticCode::UnopenedBranch, module_name_span(input, word, extra.front()),
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
    std::vector<SymbolKind> kinds; // by symbol: Symbol::kind
    bool any = false;
    for (const Symbol& symbol : input.program.symbols) {
        kinds.push_back(symbol.kind);
        any =
            any || symbol.kind == SymbolKind::BranchOpen || symbol.kind == SymbolKind::BranchClose;
    }
    if (!any) {
        return;
    }
    for (const Axiom& axiom : input.program.axioms) {
        check_word(input, kinds, axiom.word, "axiom", diagnostics);
    }
    for (const Production& production : input.program.productions) {
        check_word(input, kinds, production.successor, "successor", diagnostics);
    }
}

} // namespace lsys
