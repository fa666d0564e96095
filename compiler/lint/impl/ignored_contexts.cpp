// SPDX-License-Identifier: MIT
// Contexts that name an ignored module, which never match since matching skips such modules.
#include "compiler/lint/checks.h"
#include "compiler/lint/impl/places.h"

#include <fmt/format.h>

namespace lsys {

namespace {

void check_context(const CheckInput& input,
                   const Production& production,
                   const ProgramPattern& context,
                   Diagnostics& diagnostics) {
    for (const ProgramPatternItem& item : context.items) {
        if (item.kind != PatternKind::Module || !input.program.symbol(item.symbol).ignored) {
            continue;
        }
        const NameId name = input.program.symbol(item.symbol).name;
        Diagnostic& warning =
            diagnostics.add(DiagnosticCode::IgnoredContext, item_span(production, item),
                            input.program.considered.empty()
                                ? fmt::format("{} is ignored, so this context never matches",
                                              quoted(input.name(name)))
                                : fmt::format("{} is not considered, so this context never matches",
                                              quoted(input.name(name))));
        if (!input.program.considered.empty()) {
            warning.labels.push_back(
                {input.program.considered.front().span, "only what is named here counts"});
        }
        for (const IgnoredName& ignored : input.program.ignored) {
            if (ignored.name == name) {
                warning.labels.push_back({ignored.span, "it is ignored here"});
                break;
            }
        }
    }
}

} // namespace

void check_ignored_contexts(const CheckInput& input, Diagnostics& diagnostics) {
    if (input.program.ignored.empty() && input.program.considered.empty()) {
        return;
    }
    for (const Production& production : input.program.productions) {
        check_context(input, production, production.left, diagnostics);
        check_context(input, production, production.right, diagnostics);
    }
}

} // namespace lsys
