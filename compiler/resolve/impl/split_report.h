// SPDX-License-Identifier: MIT
// Collects the split names of a statement for one warning with one fix.
#pragma once

#include "compiler/resolve/impl/resolution.h"
#include "compiler/resolve/impl/splitting.h"

#include <optional>
#include <span>

namespace lsys {

class SplitReport {
public:
    explicit SplitReport(Resolution& resolution) : resolution_(resolution) {}

    /// `name` is the place of the name, `module` the place of the name with its arguments.
    void add(SourceSpan name, SourceSpan module, std::span<const NamePart> parts);
    /// Reports the names added since the last call.
    void finish();

private:
    Resolution& resolution_;
    std::optional<Diagnostic> warning_; // about the names since the last finish()
};

} // namespace lsys
