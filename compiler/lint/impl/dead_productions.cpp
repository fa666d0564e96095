// SPDX-License-Identifier: MIT
// Productions whose predecessor or context never occurs in any word.
#include "compiler/lint/impl/module_use.h"
#include "compiler/lint/impl/places.h"
#include "grammar/base/suggestions.h"

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace lsys {

namespace {

/// The first module of a pattern that never occurs.
const ProgramPatternItem* missing_item(const ModuleUse& use, const ProgramPattern& pattern) {
    for (const ProgramPatternItem& item : pattern.items) {
        if (item.kind == PatternKind::Module && !use.reachable.occurs(item.symbol)) {
            return &item;
        }
    }
    return nullptr;
}

class DeadProductions {
public:
    DeadProductions(const CheckInput& input, ModuleUse& use, Diagnostics& diagnostics)
        : input_(input), program_(input.program), use_(use), diagnostics_(diagnostics),
          explained_(program_.symbols.size(), false), rewriters_(rewriters_of(program_)) {}

    void run() {
        // If only dead productions write a module, the productions that need this module are dead,
        // too. Only the first production of such a chain or cycle is reported.
        std::vector<bool> written(program_.symbols.size(), false);
        for (std::size_t p = 0; p < program_.productions.size(); ++p) {
            const Production& production = program_.productions[p];
            if (use_.reachable.usable[p] || missing_item(use_, production.predecessor) == nullptr) {
                continue;
            }
            const SymbolId rewritten = production.predecessor.items.front().symbol;
            for_each_symbol(program_, production.successor, [&](std::size_t, SymbolId symbol) {
                written[static_cast<std::size_t>(symbol)] =
                    written[static_cast<std::size_t>(symbol)] || symbol != rewritten;
            });
        }
        for (const bool in_cycles : {false, true}) {
            for (std::size_t p = 0; p < program_.productions.size(); ++p) {
                const ProgramPatternItem* item =
                    use_.reachable.usable[p]
                        ? nullptr
                        : missing_item(use_, program_.productions[p].predecessor);
                if (item == nullptr || explained_[static_cast<std::size_t>(item->symbol)] ||
                    (!in_cycles && written[static_cast<std::size_t>(item->symbol)])) {
                    continue;
                }
                report(program_.productions[p], *item);
                explain(item->symbol);
            }
        }
        for (std::size_t p = 0; p < program_.productions.size(); ++p) {
            report_context(program_.productions[p]);
        }
    }

private:
    /// Marks `symbol` and the modules that would occur if `symbol` occurred, because the report
    /// about `symbol` explains why all of them never occur.
    void explain(SymbolId symbol) {
        std::vector<SymbolId> work{symbol};
        explained_[static_cast<std::size_t>(symbol)] = true;
        while (!work.empty()) {
            const SymbolId at = work.back();
            work.pop_back();
            for (const std::uint32_t p : rewriters_[static_cast<std::size_t>(at)]) {
                for_each_symbol(program_, program_.productions[p].successor,
                                [&](std::size_t, SymbolId next) {
                                    if (!explained_[static_cast<std::size_t>(next)]) {
                                        explained_[static_cast<std::size_t>(next)] = true;
                                        work.push_back(next);
                                    }
                                });
            }
        }
    }

    /// Whether a production that names `symbol`, which never occurs, is not reported.
    [[nodiscard]] bool is_exempt(const Production& production, SymbolId symbol) const {
        const auto s = static_cast<std::size_t>(symbol);
        // An included file may rewrite more than this grammar uses; a declared module may be
        // unused.
        return production.span.file != program_.axiom_span().file || use_.reported[s] ||
               use_.declared[s];
    }

    /// Adds a label at a place where the name has another number of parameters. Returns false if
    /// there is no such place.
    bool note_other_counts(Diagnostic& diagnostic, SymbolId symbol) const {
        for (const SymbolId other : use_.same_name(program_, symbol)) {
            if (use_.reachable.occurs(other)) {
                const ModuleMention place = use_.first_place[static_cast<std::size_t>(other)];
                diagnostic.labels.push_back(
                    {module_span(input_, *place.word, place.index),
                     fmt::format("it occurs with {} here",
                                 parameters_text(program_.symbol(other).parameter_count))});
                return true;
            }
        }
        return false;
    }

    /// Offers `name` in place of a module named `nearest` that has no production, no turtle
    /// operation and no declaration. Returns false if there is no such module.
    bool
    suggest_at_mention(Diagnostic& diagnostic, std::string_view name, std::string_view nearest) {
        for (std::uint32_t s = 0; s < program_.symbols.size(); ++s) {
            if (input_.name(SymbolId{s}) != nearest || !use_.reachable.occurs(SymbolId{s})) {
                continue;
            }
            const ModuleMention place = use_.first_place[s];
            if (use_.first_production[s] != kNone || use_.declared[s] ||
                program_.symbols[s].turtle != TurtleOperation::Nothing || place.word == nullptr) {
                return false;
            }
            const SourceSpan span = module_name_span(input_, *place.word, place.index);
            if (input_.sources.text(span) != nearest) {
                return false;
            }
            diagnostic.labels.push_back({span, fmt::format("{} does nothing", quoted(nearest))});
            add_fix(diagnostic, fmt::format("did you mean {} here?", quoted(name)), span,
                    std::string(name), false);
            use_.reported[s] = true;
            return true;
        }
        return false;
    }

    /// Suggests the most similar name of a module that occurs. `span`: place of the name in error.
    void suggest(Diagnostic& diagnostic, SymbolId symbol, SourceSpan span) {
        if (candidates_.empty()) {
            for (std::uint32_t s = 0; s < program_.symbols.size(); ++s) {
                if (use_.reachable.occurs(SymbolId{s}) &&
                    program_.symbols[s].kind == SymbolKind::Plain) {
                    candidates_.push_back(input_.name(SymbolId{s}));
                }
            }
        }
        const std::string_view name = input_.name(symbol);
        const std::string nearest = suggestions_.nearest(name, candidates_);
        if (!nearest.empty()) {
            if (suggest_at_mention(diagnostic, name, nearest)) {
                return;
            }
            span.end = span.begin + static_cast<std::uint32_t>(name.size());
            Fix fix;
            fix.title = fmt::format("did you mean {}?", quoted(nearest));
            fix.machine_applicable = false;
            if (input_.sources.text(span) == name) {
                fix.edits = {{span, nearest}};
                diagnostic.fixes.push_back(std::move(fix));
            } else {
                diagnostic.help.push_back(std::move(fix.title));
            }
        }
    }

    /// The name, with its number of parameters if modules of the name differ in that number.
    [[nodiscard]] std::string with_count(SymbolId symbol) const {
        const std::uint32_t count = program_.symbol(symbol).parameter_count;
        return use_.same_name(program_, symbol).size() == 1
                   ? quoted(input_.name(symbol))
                   : fmt::format("{} with {}", quoted(input_.name(symbol)), parameters_text(count));
    }

    void report(const Production& production, const ProgramPatternItem& item) {
        if (is_exempt(production, item.symbol)) {
            return;
        }
        const SourceSpan span = item_span(production, item);
        Diagnostic diagnostic = make_diagnostic(
            DiagnosticCode::NeverProduced, span,
            fmt::format("module {} never occurs, so {} is never used", with_count(item.symbol),
                        quoted(input_.name(production.name))));
        if (!note_other_counts(diagnostic, item.symbol)) {
            suggest(diagnostic, item.symbol, span);
        }
        diagnostic.notes.emplace_back("the axiom does not lead to it through any production");
        diagnostics_.add(std::move(diagnostic));
    }

    void report_context(const Production& production) {
        if (missing_item(use_, production.predecessor) != nullptr) {
            return;
        }
        for (const ProgramPattern* context : {&production.left, &production.right}) {
            const ProgramPatternItem* item = missing_item(use_, *context);
            if (item == nullptr || explained_[static_cast<std::size_t>(item->symbol)] ||
                program_.symbol(item->symbol).ignored || is_exempt(production, item->symbol)) {
                continue;
            }
            explained_[static_cast<std::size_t>(item->symbol)] = true;
            const SourceSpan span = item_span(production, *item);
            Diagnostic diagnostic = make_diagnostic(
                DiagnosticCode::NeverProduced, span,
                fmt::format("module {} never occurs, so {} never meets this context",
                            with_count(item->symbol), quoted(input_.name(production.name))));
            if (!note_other_counts(diagnostic, item->symbol)) {
                suggest(diagnostic, item->symbol, span);
            }
            diagnostics_.add(std::move(diagnostic));
            return;
        }
    }

    const CheckInput& input_;
    const Program& program_;
    ModuleUse& use_;
    Diagnostics& diagnostics_;
    std::vector<bool> explained_; // per symbol: a reported production explains why it never occurs
    GroupedLists rewriters_;      // per symbol: see rewriters_of()
    std::vector<std::string_view> candidates_; // names that suggest() may offer
    Suggestions suggestions_;
};

} // namespace

void check_dead_productions(const CheckInput& input, ModuleUse& use, Diagnostics& diagnostics) {
    DeadProductions(input, use, diagnostics).run();
}

} // namespace lsys
