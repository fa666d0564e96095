// SPDX-License-Identifier: MIT
// Multiply-add of counts: the inner step of the growth analysis, fast while counts are below 2^128.
#pragma once

#include "compiler/growth/growth.h"

#include <cstdint>

namespace lsys::analysis {

[[nodiscard]] inline bool is_zero(const Count& count) {
    return !count.exceeds && count.value == 0;
}

/// sum += value * times, for counts of any size.
void add_large_times(Count& sum, const Count& value, std::uint64_t times);

/// sum += value * times. Always inline: otherwise it is a call in code that is compiled for size.
[[gnu::always_inline]] inline void add_times(Count& sum, const Count& value, std::uint64_t times) {
    // Most counts are small: two factors below 2^31, plus a sum below 2^63, fit 64 bits.
    if (!sum.exceeds && !value.exceeds && (sum.value.high | value.value.high) == 0 &&
        sum.value.low >> 63 == 0 && (value.value.low | times) >> 31 == 0) {
        sum.value.low += value.value.low * times;
        return;
    }
    add_large_times(sum, value, times);
}

inline void add_times(GenerationSize& sum, const GenerationSize& size, std::uint64_t times) {
    add_times(sum.modules, size.modules, times);
    add_times(sum.parameters, size.parameters, times);
    add_times(sum.segments, size.segments, times);
    add_times(sum.bytes, size.bytes, times);
}

} // namespace lsys::analysis
