// SPDX-License-Identifier: MIT
// EditDistance: how much names differ from one name, for nearest_name().
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace lsys {

/// The distance counts insertions, deletions, replacements and exchanges of two neighbours (optimal
/// string alignment). Each counts 2, the replacement of a letter by its other case 1.
class EditDistance {
public:
    static constexpr std::size_t kMaxLength = 64; // max length of both names

    /// Precondition: wanted.size() <= kMaxLength.
    explicit EditDistance(std::string_view wanted);

    /// At most distance(), and much faster: twice the number of edits, without letter case.
    /// Precondition: `wanted` is not empty.
    [[nodiscard]] std::size_t lower_bound(std::string_view name) const;
    /// Precondition: name.size() <= kMaxLength.
    [[nodiscard]] std::size_t distance(std::string_view name) const;

private:
    std::string_view wanted_;
    /// Bit i is set if letter i of `wanted` is this byte in lower case.
    std::array<std::uint64_t, 256> places_{};
};

/// The byte in lower case, if it is an ASCII letter.
[[nodiscard]] constexpr unsigned char lower_case(char c) {
    return static_cast<unsigned char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
}

} // namespace lsys
