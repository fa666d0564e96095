// SPDX-License-Identifier: MIT
// Entries of a Fractint collection, `name { ... }`, and lines of an entry.
#pragma once

#include "grammar/ast/parse_context.h"

#include <cstdint>
#include <vector>

namespace lsys {

struct FractintEntry {
    SourceSpan name; // empty: unnamed
    SourceSpan body; // between the braces
};

enum class FractintLineKind : std::uint8_t { Axiom, Angle, Rule };

/// A line of an entry.
struct FractintLine {
    FractintLineKind kind{};
    SourceSpan key;
    std::vector<SourceSpan> texts; // words and `=`, in order
};

[[nodiscard]] std::vector<FractintEntry> read_fractint_entries(FileId root,
                                                               const ParseContext& context);
[[nodiscard]] std::vector<FractintLine> read_fractint_lines(const FractintEntry& entry,
                                                            const ParseContext& context);

} // namespace lsys
