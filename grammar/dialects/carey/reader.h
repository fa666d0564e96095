// SPDX-License-Identifier: MIT
// Lines of a .rules file: fields of the generator, `key: value`, and rules, `left=right:ratio`.
#pragma once

#include "grammar/ast/parse_context.h"

#include <optional>
#include <string_view>
#include <vector>

namespace lsys {

/// A text field of the generator's window.
struct CareyKey {
    std::string_view name;
    std::string_view lsys; // name of the setting in .lsys; empty for a statement
};
/// The key before a colon at the start of `text`; null if there is none.
[[nodiscard]] const CareyKey* find_carey_key(std::string_view text);

/// A setting of the file; its spans have no blanks around them.
struct CareySetting {
    const CareyKey* key = nullptr;
    SourceSpan place; // the key and its colon
    SourceSpan value;
};

struct CareyRule {
    SourceSpan left;
    SourceSpan right;                // empty: the rule erases
    std::optional<SourceSpan> ratio; // weight of the rule
};

struct CareyFile {
    std::vector<CareySetting> settings;
    std::vector<CareyRule> rules;
};

/// Reads the settings and rules of a .rules file; reports and skips other lines.
[[nodiscard]] CareyFile read_carey(FileId root, const ParseContext& context);

} // namespace lsys
