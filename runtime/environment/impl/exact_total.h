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

/// Max words of a total: 2^-1074 to 2^1024, a sign, and 33 bits for the number of terms.
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
    /// Adds a coordinate of one of the places, times 2^doublings, to `total`, an array of words().
    void add(std::uint64_t* total, double coordinate, unsigned doublings = 0) const;
    /// Subtracts a coordinate `times` times from a total of `times` coordinates, at most 2^32.
    void subtract(std::uint64_t* total, double coordinate, std::uint64_t times) const;
    /// Adds a total to another.
    void add(std::uint64_t* total, const std::uint64_t* other) const;
    /// The total, rounded once to the nearest binary64, ties to even.
    [[nodiscard]] double rounded(const std::uint64_t* total) const;

private:
    int lowest_ = 0; // exponent of bit 0
    std::size_t words_ = 1;
};

} // namespace lsys
