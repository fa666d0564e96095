// SPDX-License-Identifier: MIT
// Finds other repairs for a sign that a repair adds: the author may have typed another character in
// its place. `F A` before the next statement lacks its `;`, unless `A` is a mistyped `;`.
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

/// Texts without the added sign, in which another character may have been mistyped. Either the sign
/// replaces a character next to the added one, or the character before the added one changes places
/// with a sign of the same kind before it. A replacement is omitted if the text has other signs of
/// this kind and none of them has blanks on the same sides.
[[nodiscard]] std::vector<std::string> mistyped_texts(std::string_view text, AddedText added);

} // namespace lsys::lsc
