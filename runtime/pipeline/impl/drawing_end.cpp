// SPDX-License-Identifier: MIT
#include "runtime/pipeline/impl/drawing_end.h"

#include "runtime/derive/runtime_diagnostic.h"
#include "runtime/pipeline/plant.h"
#include "runtime/turtle/turtle_diagnostic.h"

#include <utility>

namespace lsys {

std::optional<Stop> report_drawing(const DerivationEnd& derived,
                                   const DrawingEnd& drawn,
                                   const Grammar& grammar,
                                   Step& step) {
    const Limits& limits = step.project().limits;
    if (derived.stop) {
        if (derived.stop != Stop::Cancelled) {
            step.diagnose(derivation_diagnostic(derived, limits, grammar), grammar.sources);
        }
        return derived.stop;
    }
    if (drawn.error) {
        step.diagnose(runtime_diagnostic(*drawn.error, grammar.bytecode, !grammar.is_module_file),
                      grammar.sources);
        return Stop::Diagnosed;
    }
    Diagnostics diagnostics;
    for (Diagnostic& diagnostic : turtle_diagnostics(drawn.faults, grammar.bytecode)) {
        diagnostics.add(std::move(diagnostic));
    }
    if (drawn.stop == Stop::Limit) {
        diagnostics.add(plant_limit_diagnostic("the skeleton", limits.max_bytes));
    } else if (drawn.stop == Stop::OutOfMemory) {
        diagnostics.add(no_memory_diagnostic("the skeleton"));
    }
    const bool ok = step.diagnose(std::move(diagnostics), grammar.sources);
    return drawn.stop || ok ? drawn.stop : Stop::Diagnosed;
}

} // namespace lsys
