// SPDX-License-Identifier: MIT
// Lines of a file of L3D: three numbers, rules `key=value`, axioms, and `@`.
#pragma once

#include "grammar/ast/parse_context.h"

#include <string_view>
#include <vector>

namespace lsys {

inline constexpr std::string_view kL3dBlanks = " \t\n\v\f\r";

/// A line `key=value`.
struct L3dRule {
    SourceSpan key;   // without the `=`
    SourceSpan value; // to the end of the line
};

struct L3dFile {
    std::vector<SourceSpan> numbers; // three, else an error has been reported
    std::vector<SourceSpan> axioms;  // the last is the axiom
    std::vector<L3dRule> rules;
    bool has_end_mark = false; // a `@`, which ends the file
};

/// Stops at the first mistake.
[[nodiscard]] L3dFile read_l3d(FileId root, const ParseContext& context);

} // namespace lsys
