// SPDX-License-Identifier: MIT
// Productions and contexts that name the module `%`, which cuts off a branch. Cuts are made before
// matching, so these patterns never match. In turtle profiles in which `%` has another meaning,
// nothing is reported.
#include "compiler/lint/impl/lints.h"
#include "compiler/lint/impl/places.h"

namespace lsys {

namespace {

/// Whether the item is a module that cuts off its branch.
bool cuts(const Program& program, const ProgramPatternItem& item) {
    return item.kind == PatternKind::Module &&
           program.symbol(item.symbol).turtle == TurtleOperation::Cut;
}

void check_pattern(const CheckInput& input,
                   const Production& production,
                   const ProgramPattern& pattern,
                   const char* message,
                   Diagnostics& diagnostics) {
    for (const ProgramPatternItem& item : pattern.items) {
        if (cuts(input.program, item)) {
            diagnostics.add(DiagnosticCode::CutModule, item_span(production, item), message)
                .notes.emplace_back("a generation begins with the cuts: they take every `%` and "
                                    "the rest of its branch out of the word");
        }
    }
}

} // namespace

void check_cuts(const CheckInput& input, Diagnostics& diagnostics) {
    for (const Production& production : input.program.productions) {
        if (production.stage != Stage::Rewrite) {
            continue; // #decompose and #interpret run after the cuts and can match `%`
        }
        check_pattern(input, production, production.predecessor,
                      "`%` is never rewritten, so this production is never used", diagnostics);
        for (const ProgramPattern* const context : {&production.left, &production.right}) {
            check_pattern(input, production, *context,
                          "`%` is never seen, so this context never matches", diagnostics);
        }
    }
}

} // namespace lsys
