// SPDX-License-Identifier: MIT
#include "compiler/growth/impl/count_math.h"

namespace lsys::analysis {

void add_large_times(Count& sum, const Count& value, std::uint64_t times) {
    // A value of up to 60 bits times 64 bits, plus a sum below 2^126, fits 128 bits.
    constexpr int kRoom = 60;
    if (!sum.exceeds && !value.exceeds && value.value.high == 0 && value.value.low >> kRoom == 0 &&
        sum.value.high >> 62 == 0) {
        sum.value = sum.value + full_product(value.value.low, times);
        return;
    }
    sum = sum + value * Count{times, false, 0.0};
}

} // namespace lsys::analysis
