// Gathers the names of one statement that are read split, for one warning with one repair.
#pragma once

#include "compiler/resolve/impl/resolution.h"
#include "compiler/resolve/impl/splitting.h"

#include <optional>
#include <span>

namespace lsys {

class SplitReport {
public:
    explicit SplitReport(Resolution& resolution) : resolution_(resolution) {}

    /// `name` is the place of the name, `module` that of the name with its arguments.
    void add(SourceSpan name, SourceSpan module, std::span<const NamePart> parts);
    /// Reports what was added since the last call.
    void finish();

private:
    Resolution& resolution_;
    std::optional<Diagnostic> warning_;
};

} // namespace lsys
