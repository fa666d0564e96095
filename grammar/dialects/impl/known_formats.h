// SPDX-License-Identifier: MIT
// Recognition of programming languages and file formats by lines that only they have, so that a
// file of one of them gets one message.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

namespace lsys {

struct KnownFormat {
    std::string_view name; // "a Rust program"
    std::size_t line = 0;  // index of the first line that shows it
};

/// The format of lines without blanks at their ends, none of them empty; nullopt if none is shown.
[[nodiscard]] std::optional<KnownFormat> find_known_format(std::span<const std::string_view> lines);
/// "plain prose" for sentences of a natural language, or "a table of ..." for lines with the same
/// number of commas; nullopt for other texts.
[[nodiscard]] std::optional<KnownFormat> find_plain_text(std::span<const std::string_view> lines);

} // namespace lsys
