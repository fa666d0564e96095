// Pieces of text that several formats share: numbers written into a buffer, and names and comments
// that cannot break the syntax around them.
#pragma once

#include "runtime/export/export.h"

#include <fmt/compile.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

/// Bytes that put_number() may write at most.
inline constexpr std::size_t kNumberBytes = 24;

/// The shortest text that reads back as the same number. Returns where it ends.
inline char* put_number(char* at, float value) {
    // FMT_COMPILE makes a string of its own type; no format is parsed here.
    return fmt::format_to(at, FMT_COMPILE("{}"), value);
}
inline char* put_number(char* at, std::uint64_t value) {
    return fmt::format_to(at, FMT_COMPILE("{}"), value);
}
inline char* put_text(char* at, std::string_view text) {
    return at + text.copy(at, text.size());
}

/// One line of printable text: control characters become blanks.
[[nodiscard]] std::string one_line(std::string_view text);
/// What follows "generator" in comments: the grammar, seed and generations in one line.
[[nodiscard]] std::string origin_line(const ExportInfo& info);
/// Valid UTF-8: what is not becomes U+FFFD.
[[nodiscard]] std::string valid_utf8(std::string_view text);
/// Between the quotes of a JSON string.
[[nodiscard]] std::string json_text(std::string_view text);
/// Between tags of XML, or the quotes of an attribute.
[[nodiscard]] std::string xml_text(std::string_view text);
/// A word without blanks, as names in OBJ have to be.
[[nodiscard]] std::string word(std::string_view text);
/// A letter or underscore, then letters, digits and underscores.
[[nodiscard]] std::string identifier(std::string_view text);
/// `name`, or with the least number behind it that makes it none of `taken`.
[[nodiscard]] std::string unlike(const std::vector<std::string>& taken, const std::string& name);

/// A channel of linear colour as a byte of sRGB (IEC 61966-2-1).
[[nodiscard]] std::uint8_t srgb_byte(float linear);
[[nodiscard]] float srgb(float linear);

} // namespace lsys
