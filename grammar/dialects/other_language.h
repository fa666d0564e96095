// SPDX-License-Identifier: MIT
// Recognition of files whose text is in another language than their name says: a cpfg model, JSON
// or Markdown named `.lsys`. They get one message, which names the language, instead of one for
// each line.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace lsys {

struct OtherLanguage {
    std::string name;        // "a cpfg L-system"
    std::string help;        // advice to the author
    std::uint32_t begin = 0; // first byte of the line that shows the language
    std::uint32_t end = 0;
};

/// The language of a text without any statement of .lsys; nullopt if no line shows it.
[[nodiscard]] std::optional<OtherLanguage> recognise_other_language(std::string_view text);
/// Whether a text is of a program that no dialect reads, although parts of it may look like one:
/// lpfg, RubberPlant, a panel of L-studio.
[[nodiscard]] bool is_other_program(std::string_view text);
/// Whether a text that no dialect recognises is of a language that lsc does not read, such as JSON
/// or C.
[[nodiscard]] bool is_unread_language(std::string_view text);
/// Whether a text whose name does not show its language is in the notation of papers or of L-Py.
/// Messages explain the lines of these notations that no dialect reads.
[[nodiscard]] bool is_foreign_notation(std::string_view text);

} // namespace lsys
