// SPDX-License-Identifier: MIT
// Search for the first of a few characters.
#pragma once

#include <cstddef>
#include <string_view>

namespace lsys {

/// The offset of the first of the characters in `text` at or after `at`; the size of the text if it
/// has none. Unlike std::string_view::find_first_of() it compares blocks of characters, which the
/// compiler turns into vector instructions.
template <char... kCharacters>
[[nodiscard]] std::size_t find_any(std::string_view text, std::size_t at) {
    constexpr std::size_t kBlock = 32;
    const auto is_found = [](char c) { return ((c == kCharacters) | ...); };
    for (; at + kBlock <= text.size(); at += kBlock) {
        unsigned char found = 0;
        for (std::size_t i = 0; i < kBlock; ++i) {
            found |= static_cast<unsigned char>(is_found(text[at + i]));
        }
        if (found != 0) {
            break;
        }
    }
    while (at < text.size() && !is_found(text[at])) {
        ++at;
    }
    return at;
}

} // namespace lsys
