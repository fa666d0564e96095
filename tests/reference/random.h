// SPDX-License-Identifier: MIT
// Random numbers for the generator and the printer of random grammars: consecutive Philox words, so
// that a seed gives the same grammar with every standard library and on every machine.

#pragma once

#include "tests/reference/philox.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace lsys::reference {

class Random {
public:
    // `stream`: number of the purpose; random numbers for different purposes are independent,
    // although the seed is the same.
    Random(std::uint64_t seed, std::uint32_t stream) : seed_(seed), stream_(stream) {}

    std::uint32_t word() {
        const PhiloxKey key = {static_cast<std::uint32_t>(seed_),
                               static_cast<std::uint32_t>(seed_ >> 32U)};
        return philox4x32_10({count_++, stream_, 0x6C737973, 0}, key)[0];
    }

    // A number from 0 to bound - 1. Precondition: bound > 0. The small bias does not matter here.
    std::size_t below(std::size_t bound) { return word() % bound; }

    // A number from `low` to `high`, both included.
    int between(int low, int high) {
        return low + static_cast<int>(below(static_cast<std::size_t>(high - low + 1)));
    }

    bool percent(std::size_t chance) { return below(100) < chance; }

    template <typename T>
    const T& pick(const std::vector<T>& values) {
        return values[below(values.size())];
    }

    template <typename T>
    void shuffle(std::vector<T>& values) {
        for (std::size_t i = values.size(); i > 1; --i) {
            std::swap(values[i - 1], values[below(i)]);
        }
    }

private:
    std::uint64_t seed_;
    std::uint32_t stream_;
    std::uint32_t count_ = 0; // of words drawn so far
};

} // namespace lsys::reference
