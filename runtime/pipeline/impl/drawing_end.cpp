#include "runtime/pipeline/impl/drawing_end.h"

#include "runtime/derive/runtime_diagnostic.h"
#include "runtime/pipeline/plant.h"
#include "runtime/turtle/turtle_diagnostic.h"

#include <utility>

namespace lsys {

std::optional<Stop> report_drawing(const DerivationEnd& derived,
                                   TurtleStatus drawn,
                                   const RuntimeError& drawing_error,
                                   const std::array<TurtleFault, kTurtleFaultKinds>& faults,
                                   const Grammar& grammar,
                                   Step& step) {
    const Limits& limits = step.project().limits;
    if (derived.stop) {
        if (derived.stop != Stop::Cancelled) {
            step.diagnose(derivation_diagnostic(derived, limits, grammar), grammar.sources);
        }
        return derived.stop;
    }
    if (drawn == TurtleStatus::NotInterpreted) {
        step.diagnose(runtime_diagnostic(drawing_error, grammar.bytecode, !grammar.is_module_file),
                      grammar.sources);
        return Stop::Diagnosed;
    }
    Diagnostics diagnostics;
    for (Diagnostic& diagnostic : turtle_diagnostics(faults, grammar.bytecode)) {
        diagnostics.add(std::move(diagnostic));
    }
    if (drawn == TurtleStatus::Limit) {
        diagnostics.add(plant_limit_diagnostic("the skeleton", limits.max_bytes));
    } else if (drawn == TurtleStatus::OutOfMemory) {
        diagnostics.add(no_memory_diagnostic("the skeleton"));
    }
    const bool ok = step.diagnose(std::move(diagnostics), grammar.sources);
    switch (drawn) {
    case TurtleStatus::Limit:
        return Stop::Limit;
    case TurtleStatus::OutOfMemory:
        return Stop::OutOfMemory;
    case TurtleStatus::Cancelled:
        return Stop::Cancelled;
    case TurtleStatus::Ok:
    case TurtleStatus::Fault:
    case TurtleStatus::NotInterpreted:
        break;
    }
    return ok ? std::nullopt : std::optional(Stop::Diagnosed);
}

} // namespace lsys
