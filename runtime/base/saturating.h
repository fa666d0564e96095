// SPDX-License-Identifier: MIT
// Arithmetic of sizes that stays at the maximum of the type instead of wrapping.
#pragma once

#include <cstdint>
#include <limits>

namespace lsys {

[[nodiscard]] constexpr std::uint64_t saturating_add(std::uint64_t a, std::uint64_t b) {
    constexpr std::uint64_t kMax = std::numeric_limits<std::uint64_t>::max();
    return a > kMax - b ? kMax : a + b;
}
[[nodiscard]] constexpr std::uint64_t saturating_multiply(std::uint64_t a, std::uint64_t b) {
    constexpr std::uint64_t kMax = std::numeric_limits<std::uint64_t>::max();
    return b != 0 && a > kMax / b ? kMax : a * b;
}

} // namespace lsys
