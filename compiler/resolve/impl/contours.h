// SPDX-License-Identifier: MIT
// Resolves #contour: the cross-section of organs (docs/language.md section 15.2).
#pragma once

#include "compiler/resolve/impl/expressions.h"
#include "compiler/resolve/impl/resolution.h"

#include <optional>
#include <unordered_map>
#include <vector>

namespace lsys {

class ContourResolver {
public:
    ContourResolver(Resolution& resolution, ExpressionResolver& expressions)
        : resolution_(resolution), expressions_(expressions) {}

    /// Adds a statement to Program::contours, or reports its mistakes. Only constants before the
    /// statement are visible.
    void contour(const CurveNode& node);

private:
    [[nodiscard]] std::optional<std::vector<ContourPoint>> read_points(const CurveNode& node);

    Resolution& resolution_;
    ExpressionResolver& expressions_;
    std::unordered_map<NameId, SourceSpan> first_; // by name: place in its first #contour
};

} // namespace lsys
