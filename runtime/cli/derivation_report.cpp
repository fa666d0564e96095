// SPDX-License-Identifier: MIT
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

ExitStatus report_derivation(const DerivationEnd& end,
                             const Limits& limits,
                             const Grammar& grammar,
                             const Console& console) {
    if (!end.stop) {
        return ExitStatus::Ok;
    }
    if (end.stop == Stop::Cancelled) {
        return ExitStatus::Interrupted;
    }
    return show_diagnostic(derivation_diagnostic(end, limits, grammar), status_of(*end.stop),
                           grammar, console);
}

} // namespace lsys::lsc
