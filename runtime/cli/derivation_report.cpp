#include "runtime/cli/derivation_report.h"

#include "runtime/pipeline/plant.h"

#include <utility>

namespace lsys::lsc {

ExitStatus show_diagnostic(Diagnostic diagnostic,
                           ExitStatus status,
                           const Grammar& grammar,
                           const Console& console) {
    Diagnostics diagnostics;
    diagnostics.add(std::move(diagnostic));
    static_cast<void>(console.show(diagnostics, *grammar.sources));
    return status;
}

ExitStatus report_derivation(DeriveStatus status,
                             const RuntimeError& error,
                             const LimitReport& limit,
                             const Limits& limits,
                             const Grammar& grammar,
                             const Console& console) {
    if (status == DeriveStatus::Ok) {
        return ExitStatus::Ok;
    }
    if (status == DeriveStatus::Cancelled) {
        return ExitStatus::Interrupted;
    }
    return show_diagnostic(derivation_diagnostic(status, error, limit, limits, grammar),
                           status_of(stop_of(status)), grammar, console);
}

} // namespace lsys::lsc
