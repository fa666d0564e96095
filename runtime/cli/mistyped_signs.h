// SPDX-License-Identifier: MIT
// Signs that a repair adds may have been typed as another character: `F A` before the next
// statement lacks its `;`, unless `A` is a mistyped `;`.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lsys::lsc {

/// The bytes [begin, end) that a repair added to a text.
struct AddedText {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
};

/// The one character other than blanks that a repair adds; '\0' if it adds none or several.
[[nodiscard]] char added_sign(std::string_view added);

/// The texts in which the sign of `added` replaces a character next to it, or in which an equal sign
/// changes places with the character before the added one. A replacing sign with blanks on its sides
/// is not returned if all others of the text have none, and vice versa.
[[nodiscard]] std::vector<std::string> mistyped_texts(std::string_view text, AddedText added);

} // namespace lsys::lsc
