// SPDX-License-Identifier: MIT
// The start of the local values of a production (docs/language.md section 4.5).
#pragma once

#include <cstddef>
#include <string_view>

namespace lsys {

/// Whether the part of a production at `at`, after its third `:`, begins with local values: `let`,
/// an identifier and a single `=`, with blanks and comments between them.
[[nodiscard]] bool begins_local_values(std::string_view text, std::size_t at);

} // namespace lsys
