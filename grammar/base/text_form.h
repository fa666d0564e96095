// SPDX-License-Identifier: MIT
// Recognition of files that are not UTF-8 text. UTF-16 and binary files get one message instead of
// one for each byte that is illegal in a grammar.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace lsys {

/// The format of bytes that are not text, and advice for the author.
struct NonText {
    std::string what; // "UTF-16 text", "a PNG picture"
    std::string help;
};

/// The format of `bytes` if they are not UTF-8 text, else nullopt. A few control characters or
/// bytes of another encoding still pass as text.
[[nodiscard]] std::optional<NonText> recognise_non_text(std::string_view bytes);

} // namespace lsys
