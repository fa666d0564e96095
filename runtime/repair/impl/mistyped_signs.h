// SPDX-License-Identifier: MIT
// Finds other repairs for a sign that a repair adds: the author may have typed another character in
// its place. `F A` before the next statement lacks its `;`, unless `A` is a mistyped `;`.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lsys::repair {

/// The bytes [begin, end) that a repair added to a text.
struct AddedText {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
};

/// The one character other than blanks that a repair adds; '\0' if it adds none or several.
[[nodiscard]] char added_sign(std::string_view added);

/// Other repairs of the text without the addition. A replacement puts the added sign in place of
/// the nearest character before or after the addition. An exchange swaps the nearest character
/// before the addition with a sign like the added one that stands directly before this character. A
/// replacement is omitted if the text has other signs like it, none of them has blanks on the same
/// sides as the replacement, and the replacement does not follow a `:`.
[[nodiscard]] std::vector<std::string> mistyped_texts(std::string_view text, AddedText added);

} // namespace lsys::repair
