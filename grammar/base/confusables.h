// SPDX-License-Identifier: MIT
// Confusables (Unicode TS 39): characters that look like an ASCII character and stand in its place
// in text copied from PDF files and word processors.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace lsys {

struct Confusable {
    char32_t character = 0;
    std::string_view ascii; // the replacement; may be empty
    std::string_view name;  // for messages: "minus sign"
};

/// Nullopt if `character` is not a confusable. Covers all full-width forms of ASCII.
[[nodiscard]] std::optional<Confusable> find_confusable(char32_t character);

/// Whether a character beyond ASCII is likely to be a letter; false for ASCII.
[[nodiscard]] bool is_letter_beyond_ascii(char32_t character);

/// The number of a character as text: "U+2212".
[[nodiscard]] std::string code_point_name(char32_t character);

} // namespace lsys
