// SPDX-License-Identifier: MIT
#include "runtime/environment/impl/exact_total.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace lsys {

namespace {

constexpr std::size_t kWordBits = 64;
constexpr int kMantissaBits = 53;

/// |value| as an odd integer times a power of two. Precondition: value is finite and not 0.
struct OddInteger {
    explicit OddInteger(double value) {
        const auto bits = std::bit_cast<std::uint64_t>(value);
        const auto biased = static_cast<int>(bits >> 52 & 0x7FF);
        mantissa = bits & ((std::uint64_t{1} << 52) - 1);
        if (biased != 0) {
            mantissa |= std::uint64_t{1} << 52;
        }
        const int zeros = std::countr_zero(mantissa);
        mantissa >>= zeros;
        exponent = std::max(biased, 1) - 1075 + zeros;
    }

    std::uint64_t mantissa = 0;
    int exponent = 0;
};

} // namespace

TotalRange::TotalRange(std::span<const SensePlace> places) {
    int lowest = std::numeric_limits<int>::max();
    int highest = std::numeric_limits<int>::min(); // one above the highest bit of any coordinate
    for (const SensePlace& place : places) {
        for (const double coordinate : place.position) {
            if (coordinate != 0.0) {
                const OddInteger number(coordinate);
                lowest = std::min(lowest, number.exponent);
                highest = std::max(highest, number.exponent +
                                                static_cast<int>(std::bit_width(number.mantissa)));
            }
        }
    }
    if (lowest <= highest) {
        lowest_ = lowest;
        const auto bits = static_cast<std::size_t>(highest - lowest) + 34; // 33 of carry, 1 sign
        words_ = (bits + kWordBits - 1) / kWordBits;
    }
}

void TotalRange::subtract(std::uint64_t* total, double coordinate, std::uint64_t times) const {
    for (unsigned bit = 0; times >> bit != 0; ++bit) {
        if ((times >> bit & 1) != 0) {
            add(total, -coordinate, bit);
        }
    }
}

void TotalRange::add(std::uint64_t* total, double coordinate, unsigned doublings) const {
    if (coordinate == 0.0) {
        return;
    }
    const OddInteger number(coordinate);
    const std::size_t shift = static_cast<std::size_t>(number.exponent - lowest_) + doublings;
    const std::size_t bit = shift % kWordBits;
    std::size_t word = shift / kWordBits;
    const std::array<std::uint64_t, 2> parts{number.mantissa << bit,
                                             bit == 0 ? 0 : number.mantissa >> (kWordBits - bit)};
    std::uint64_t carry = 0;
    const bool negative = coordinate < 0.0;
    for (std::size_t i = 0; word < words_ && (i < 2 || carry != 0); ++i, ++word) {
        const std::uint64_t part = i < 2 ? parts[i] : 0;
        const std::uint64_t before = total[word];
        if (negative) {
            const std::uint64_t after = before - part;
            total[word] = after - carry;
            carry = static_cast<std::uint64_t>(before < part) | (after < carry ? 1U : 0U);
        } else {
            const std::uint64_t after = before + part;
            total[word] = after + carry;
            carry = static_cast<std::uint64_t>(after < part) | (total[word] < carry ? 1U : 0U);
        }
    }
}

void TotalRange::add(std::uint64_t* total, const std::uint64_t* other) const {
    std::uint64_t carry = 0;
    for (std::size_t word = 0; word < words_; ++word) {
        const std::uint64_t after = total[word] + other[word];
        const std::uint64_t overflow = after < other[word] ? 1U : 0U;
        total[word] = after + carry;
        carry = overflow | (total[word] < carry ? 1U : 0U);
    }
}

double TotalRange::rounded(const std::uint64_t* total) const {
    Total magnitude{};
    std::copy_n(total, words_, magnitude.begin());
    const bool negative = total[words_ - 1] >> (kWordBits - 1) != 0;
    if (negative) {
        std::uint64_t carry = 1;
        for (std::size_t word = 0; word < words_; ++word) {
            magnitude[word] = ~magnitude[word] + carry;
            carry = carry != 0 && magnitude[word] == 0 ? 1 : 0;
        }
    }
    std::size_t top = words_;
    while (top > 0 && magnitude[top - 1] == 0) {
        --top;
    }
    if (top == 0) {
        return 0.0;
    }
    // `upper`: the 64 bits of the number from its top bit on. `below`: whether any lower bit is
    // set.
    const auto empty = static_cast<std::size_t>(std::countl_zero(magnitude[top - 1]));
    std::uint64_t upper = magnitude[top - 1] << empty;
    bool below = false;
    if (top > 1) {
        if (empty > 0) {
            upper |= magnitude[top - 2] >> (kWordBits - empty);
        }
        below = (empty > 0 ? magnitude[top - 2] << empty : magnitude[top - 2]) != 0;
        below = below || std::any_of(magnitude.begin(),
                                     magnitude.begin() + static_cast<std::ptrdiff_t>(top - 2),
                                     [](std::uint64_t word) { return word != 0; });
    }
    constexpr unsigned kDropped = kWordBits - kMantissaBits;
    const std::uint64_t rest = upper & ((std::uint64_t{1} << kDropped) - 1);
    constexpr std::uint64_t kHalf = std::uint64_t{1} << (kDropped - 1);
    std::uint64_t mantissa = upper >> kDropped;
    if (rest > kHalf || (rest == kHalf && (below || mantissa % 2 == 1))) {
        ++mantissa;
    }
    const int exponent = lowest_ + static_cast<int>(top * kWordBits - empty) - kMantissaBits;
    const double value = std::ldexp(static_cast<double>(mantissa), exponent);
    return negative ? -value : value;
}

} // namespace lsys
