// SPDX-License-Identifier: MIT
#include "compiler/lint/impl/module_use.h"

#include "compiler/lint/impl/lints.h"

namespace lsys {

namespace {

ModuleUse find_module_use(const Program& program) {
    ModuleUse use;
    use.reachable = find_reachable(program);
    const std::size_t symbols = program.symbols.size();
    use.first_place.resize(symbols);
    use.any_place.resize(symbols);
    use.first_production.assign(symbols, kNone);
    use.in_context.assign(symbols, false);
    use.declared.assign(symbols, false);
    use.reported.assign(symbols, false);
    for (std::uint32_t s = 0; s < symbols; ++s) {
        use.by_name[static_cast<std::uint32_t>(program.symbols[s].name)].push_back(SymbolId{s});
    }
    const auto add_places = [&](const ProgramWord& word, bool is_reachable) {
        // A place in a reachable word also counts as a place in any word.
        std::vector<ModuleMention>& known = is_reachable ? use.first_place : use.any_place;
        for_each_symbol(program, word, [&](std::size_t index, SymbolId symbol) {
            const auto s = static_cast<std::size_t>(symbol);
            if (known[s].word == nullptr) {
                known[s] = {&word, index};
                if (use.any_place[s].word == nullptr) {
                    use.any_place[s] = {&word, index};
                }
            }
        });
    };
    for (const Axiom& axiom : program.axioms) {
        add_places(axiom.word, true);
    }
    for (std::uint32_t p = 0; p < program.productions.size(); ++p) {
        const Production& production = program.productions[p];
        add_places(production.successor, use.reachable.usable[p]);
        for (const ProgramPatternItem& item : production.predecessor.items) {
            std::uint32_t& first = use.first_production[static_cast<std::size_t>(item.symbol)];
            first = first == kNone ? p : first;
        }
        for (const ProgramPattern* context : {&production.left, &production.right}) {
            for (const ProgramPatternItem& item : context->items) {
                if (item.kind == PatternKind::Module) {
                    use.in_context[static_cast<std::size_t>(item.symbol)] = true;
                }
            }
        }
    }
    for (const ModuleDeclaration& declaration : program.declarations) {
        use.declared[static_cast<std::size_t>(declaration.symbol)] = true;
    }
    for (std::uint32_t s = 0; s < symbols; ++s) {
        use.draws =
            use.draws || (use.reachable.occurs(SymbolId{s}) && draws(program.symbols[s].turtle));
    }
    return use;
}

} // namespace

bool is_idle(const CheckInput& input, const ModuleUse& use, SymbolId symbol) {
    const auto s = static_cast<std::size_t>(symbol);
    const Symbol& row = input.program.symbols[s];
    return use.reachable.occurs(symbol) && row.turtle == TurtleOperation::Nothing &&
           row.sense == Sense::Nothing && row.kind == SymbolKind::Plain && !row.ignored &&
           !use.declared[s] && !use.in_context[s] && use.first_production[s] == kNone;
}

void check_module_use(const CheckInput& input, Diagnostics& diagnostics) {
    ModuleUse use = find_module_use(input.program);
    check_arities(input, use, diagnostics);
    check_unused_objects(input, use, diagnostics);
    check_dead_productions(input, use, diagnostics);
    check_idle_modules(input, use, diagnostics);
}

} // namespace lsys
