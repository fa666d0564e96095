// SPDX-License-Identifier: MIT
// TotalRange: exact sums of coordinates, as fixed-point numbers. An exact sum does not depend on
// the order of its terms, so the sums of groups of places can be computed once and reused.
#pragma once

#include "runtime/environment/environment.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace lsys {

/// Max 64-bit words of a total: bits from 2^-1074 to 2^1024, a sign, and 32 bits for the number of
/// terms.
inline constexpr std::size_t kMaxTotalWords = 34;

/// A total in two's complement, the least word first. Words beyond TotalRange::words() are unused.
using Total = std::array<std::uint64_t, kMaxTotalWords>;

/// The range of bits that totals of the coordinates of given places need.
class TotalRange {
public:
    /// Precondition: all coordinates are finite; fewer than 2^32 places.
    explicit TotalRange(std::span<const SensePlace> places);

    /// 64-bit words of a total.
    [[nodiscard]] std::size_t words() const { return words_; }
    /// Adds a coordinate of one of the places to `total`, an array of words().
    void add(std::uint64_t* total, double coordinate) const;
    void subtract(std::uint64_t* total, double coordinate) const { add(total, -coordinate); }
    /// Adds a total to another.
    void add(std::uint64_t* total, const std::uint64_t* other) const;
    /// The total, rounded once to the nearest binary64, ties to even.
    [[nodiscard]] double rounded(const std::uint64_t* total) const;

private:
    int lowest_ = 0; // exponent of bit 0
    std::size_t words_ = 1;
};

} // namespace lsys
