// SPDX-License-Identifier: MIT
// Four numbers in binary32 at once, for bounds of distances, and two in binary64. Every operation is
// rounded as that of one number, so all machines have the same bits.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace lsys {

inline constexpr std::size_t kLanes = 4;
using Lanes = float __attribute__((vector_size(4 * kLanes)));
using Pair = double __attribute__((vector_size(16)));
using LaneMask = std::int32_t __attribute__((vector_size(4 * kLanes))); // -1 or 0

/// Square roots are rounded correctly everywhere.
[[nodiscard]] inline Lanes square_roots(Lanes numbers) {
#if defined(__SSE2__)
    return _mm_sqrt_ps(numbers);
#else
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        numbers[lane] = std::sqrt(numbers[lane]);
    }
    return numbers;
#endif
}

/// The greater of two numbers; `b` for NaN.
[[nodiscard]] inline Lanes greater(Lanes a, Lanes b) {
    return a > b ? a : b;
}

[[nodiscard]] inline Pair greater(Pair a, Pair b) {
    return a > b ? a : b;
}
/// The lesser of two numbers; `b` for NaN.
[[nodiscard]] inline Pair lesser(Pair a, Pair b) {
    return a < b ? a : b;
}

/// 0 for negative numbers and NaN.
[[nodiscard]] inline Lanes not_negative(Lanes numbers) {
    return greater(numbers, Lanes{});
}

/// Absolute values.
[[nodiscard]] inline Lanes magnitudes(Lanes numbers) {
    return std::bit_cast<Lanes>(std::bit_cast<LaneMask>(numbers) & 0x7FFFFFFF);
}

/// Each coordinate in all four lanes.
[[nodiscard]] inline std::array<Lanes, 3> in_all_lanes(const std::array<float, 3>& point) {
    return {Lanes{} + point[0], Lanes{} + point[1], Lanes{} + point[2]};
}

/// Bit i is set if lane i is -1.
[[nodiscard]] inline std::uint32_t lane_bits(LaneMask mask) {
#if defined(__SSE2__)
    return static_cast<std::uint32_t>(_mm_movemask_ps(std::bit_cast<__m128>(mask)));
#else
    std::uint32_t bits = 0;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        bits |= mask[lane] != 0 ? std::uint32_t{1} << lane : 0U;
    }
    return bits;
#endif
}

/// Precondition: `bits` is not 0.
[[nodiscard]] inline std::size_t lowest_lane(std::uint32_t bits) {
    return static_cast<std::size_t>(std::countr_zero(bits));
}

/// `value` in binary32 or a little more. Infinity beyond the range, and for NaN.
[[nodiscard]] inline float upper_float(double value) {
    constexpr double kLargest = 0x1p126;
    return value < kLargest ? static_cast<float>(value * (1.0 + 0x1p-22))
                            : std::numeric_limits<float>::infinity();
}

} // namespace lsys
