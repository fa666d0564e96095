// SPDX-License-Identifier: MIT
#include "tests/reference/philox.h"

namespace lsys::reference {

PhiloxCounter philox4x32_10(PhiloxCounter counter, PhiloxKey key) {
    // The multipliers of Philox4x32, and the increments of its key: the golden ratio and sqrt(3)-1.
    constexpr std::uint64_t kMultiplier0 = 0xD2511F53;
    constexpr std::uint64_t kMultiplier1 = 0xCD9E8D57;
    constexpr std::uint32_t kWeyl0 = 0x9E3779B9;
    constexpr std::uint32_t kWeyl1 = 0xBB67AE85;

    for (int round = 0; round < 10; ++round) {
        const std::uint64_t product0 = kMultiplier0 * counter[0];
        const std::uint64_t product1 = kMultiplier1 * counter[2];
        const auto high0 = static_cast<std::uint32_t>(product0 >> 32U);
        const auto low0 = static_cast<std::uint32_t>(product0);
        const auto high1 = static_cast<std::uint32_t>(product1 >> 32U);
        const auto low1 = static_cast<std::uint32_t>(product1);
        counter = {high1 ^ counter[1] ^ key[0], low1, high0 ^ counter[3] ^ key[1], low0};
        key[0] += kWeyl0;
        key[1] += kWeyl1;
    }
    return counter;
}

float uniform(std::uint64_t seed,
              std::uint64_t position,
              std::uint32_t generation,
              std::uint64_t draw) {
    const PhiloxKey key = {static_cast<std::uint32_t>(seed),
                           static_cast<std::uint32_t>(seed >> 32U)};
    const PhiloxCounter counter = {static_cast<std::uint32_t>(position),
                                   static_cast<std::uint32_t>(position >> 32U), generation,
                                   static_cast<std::uint32_t>(draw / 4)};
    const std::uint32_t word = philox4x32_10(counter, key)[draw % 4];
    return static_cast<float>(word >> 8U) * 0x1p-24F;
}

} // namespace lsys::reference
