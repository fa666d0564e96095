// SPDX-License-Identifier: MIT
// Text that several formats share: numbers, and names and comments escaped for their syntax.
#pragma once

#include "runtime/export/export.h"

#include <fmt/compile.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

/// Max bytes that put_number() writes.
inline constexpr std::size_t kNumberBytes = 24;

/// Writes the shortest digits that read back as the same number; returns their end.
inline char* put_number(char* at, float value) {
    // FMT_COMPILE parses the format at compile time.
    return fmt::format_to(at, FMT_COMPILE("{}"), value);
}
inline char* put_number(char* at, std::uint64_t value) {
    return fmt::format_to(at, FMT_COMPILE("{}"), value);
}
/// Writes `value` rounded to `decimals` decimal places, 0 to 9, without trailing zeros; returns the
/// end.
char* put_rounded(char* at, float value, int decimals);
inline char* put_text(char* at, std::string_view text) {
    return at + text.copy(at, text.size());
}

/// One line of printable text: control characters become blanks.
[[nodiscard]] std::string one_line(std::string_view text);
/// Grammar, seed and generations in one line, for comments.
[[nodiscard]] std::string origin_line(const ExportInfo& info);
/// `metres`, `centimetres` or `millimetres`.
[[nodiscard]] std::string_view unit_text(LengthUnit unit);
/// `1`, `0.01` or `0.001`.
[[nodiscard]] std::string_view metres_per_unit(LengthUnit unit);
/// ExportInfo::name, or `plant`.
[[nodiscard]] std::string plant_name(const ExportInfo& info);
/// Valid UTF-8: invalid bytes become U+FFFD.
[[nodiscard]] std::string valid_utf8(std::string_view text);
/// The text escaped for a JSON string, without quotes.
[[nodiscard]] std::string json_text(std::string_view text);
/// The text escaped for XML, between tags or in an attribute.
[[nodiscard]] std::string xml_text(std::string_view text);
/// A file name as a relative reference (RFC 3986): all characters except unreserved ones are
/// percent-encoded.
[[nodiscard]] std::string uri_text(std::string_view name);
/// A name for OBJ: one line, blanks become underscores, an empty name becomes `_`.
[[nodiscard]] std::string obj_identifier(std::string_view text);
/// A letter or underscore, then letters, digits and underscores: other bytes become underscores.
[[nodiscard]] std::string identifier(std::string_view text);
/// `name`, or if `taken` contains it, `name` with the first suffix _2, _3 ... that makes it unique.
[[nodiscard]] std::string unique_name(const std::vector<std::string>& taken,
                                      const std::string& name);

/// A channel of linear colour as a byte of sRGB (IEC 61966-2-1).
[[nodiscard]] std::uint8_t srgb_byte(float linear);
/// A channel of linear colour in sRGB, 0 to 1.
[[nodiscard]] float srgb(float linear);

} // namespace lsys
