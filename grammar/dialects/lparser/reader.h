// SPDX-License-Identifier: MIT
// Reads the lines of an Lparser file, in its older form of plain values or its newer one of
// keywords.
#pragma once

#include "grammar/ast/parse_context.h"

#include <optional>
#include <string_view>
#include <vector>

namespace lsys {

struct LparserRule {
    SourceSpan left;
    SourceSpan right;
};

struct LparserFile {
    std::optional<SourceSpan> recursion; // number of generations
    std::optional<SourceSpan> angle;
    std::optional<SourceSpan> thickness; // percent of the length of a segment
    std::optional<SourceSpan> axiom;
    std::vector<LparserRule> rules;
    std::optional<SourceSpan> trope; // default parameter of `t`
    std::vector<SourceSpan> colours; // index and three parts
};

/// Reads a file; reports mistakes at their places.
[[nodiscard]] LparserFile read_lparser(FileId root, const ParseContext& context);

} // namespace lsys
