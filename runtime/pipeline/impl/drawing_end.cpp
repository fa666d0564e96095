#include "runtime/pipeline/impl/drawing_end.h"

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
    if (derived.status == DeriveStatus::Cancelled) {
        return Stop::Cancelled;
    }
    if (derived.status != DeriveStatus::Ok) {
        step.diagnose(
            derivation_diagnostic(derived.status, derived.error, derived.limit, limits, grammar),
            grammar.sources);
        return stop_of(derived.status);
    }
    if (drawn == TurtleStatus::NotInterpreted) {
        step.diagnose(
            derivation_diagnostic(DeriveStatus::Error, drawing_error, {}, limits, grammar),
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
    const bool fine = step.diagnose(std::move(diagnostics), grammar.sources);
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
    return fine ? std::nullopt : std::optional(Stop::Diagnosed);
}

} // namespace lsys
