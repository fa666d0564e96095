// The module that cuts off a branch, which cannot be derived yet. Where a turtle profile gives `%`
// another meaning it is a module like any other.
#include "compiler/check/lints.h"
#include "compiler/check/places.h"

namespace lsys {

namespace {

void report_cut(SourceSpan span, Diagnostics& diagnostics) {
    if (!diagnostics.admits(DiagnosticCode::CutModule)) {
        return;
    }
    Diagnostic& diagnostic = diagnostics.add(DiagnosticCode::CutModule, span,
                                             "`%` cuts off a branch, which this version cannot");
    diagnostic.help.emplace_back(
        "to end a branch, write a production that erases what should not grow: an empty successor");
}

} // namespace

void check_cuts(const CheckInput& input, Diagnostics& diagnostics) {
    const Program& program = input.program;
    std::vector<bool> cuts;
    bool any = false;
    for (const Symbol& symbol : program.symbols) {
        cuts.push_back(symbol.turtle == TurtleOperation::Cut);
        any = any || cuts.back();
    }
    if (!any) {
        return;
    }
    const auto check_word = [&](const ProgramWord& word) {
        for_each_symbol(program, word, [&](std::size_t index, SymbolId symbol) {
            if (cuts[static_cast<std::size_t>(symbol)]) {
                report_cut(module_name_span(input, word, index), diagnostics);
            }
        });
    };
    check_word(program.axiom);
    for (const Production& production : program.productions) {
        for (const ProgramPattern* pattern :
             {&production.left, &production.predecessor, &production.right}) {
            for (const ProgramPatternItem& item : pattern->items) {
                if (item.kind == PatternKind::Module &&
                    cuts[static_cast<std::size_t>(item.symbol)]) {
                    report_cut({pattern->span.file, item.begin, item.end}, diagnostics);
                }
            }
        }
        check_word(production.successor);
    }
}

} // namespace lsys
