// SPDX-License-Identifier: MIT
// ActiveMask: two bits per module, in blocks of 64 modules: whether the module may be rewritten,
// and whether it stores a parameter. Vector instructions look up 32 codes at a time, so that a
// module that is certain to be copied costs a fraction of a table lookup. A module that only
// productions with contexts may rewrite is active only if its neighbours can match one of these
// contexts.
#pragma once

#include "runtime/derive/engine/contexts.h"
#include "runtime/derive/engine/plan.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace lsys {

/// Bits of 64 modules, the first in the lowest bit.
struct ActiveBits {
    std::uint64_t active = 0; // modules that may be rewritten
    std::uint64_t stores = 0; // modules that store a parameter
};

/// std::popcount without the library call that it compiles to for machines without the instruction.
[[nodiscard]] inline std::uint64_t count_bits(std::uint64_t bits) {
    constexpr std::uint64_t kOnes = ~std::uint64_t{0};
    bits -= (bits >> 1) & (kOnes / 3);
    bits = (bits & (kOnes / 5)) + ((bits >> 2) & (kOnes / 5));
    bits = (bits + (bits >> 4)) & (kOnes / 17);
    return (bits * (kOnes / 255)) >> 56;
}

class ActiveMask {
public:
    /// Max modules per call of fill().
    static constexpr std::size_t kModules = 4096;
    /// Modules per ActiveBits.
    static constexpr std::size_t kBlock = 64;

    /// Builds the tables for the current rows of the plan. `contexts` has the modules that a
    /// context search skips; it may be null if no active production has a context.
    void prepare(const Plan& plan, const ContextTables* contexts);

    /// Whether the mask can be used: the program has few enough codes, and every match replaces one
    /// module.
    [[nodiscard]] bool usable() const { return usable_; }
    /// Whether some code has a Choice row.
    [[nodiscard]] bool has_choices() const { return has_choices_; }

    /// Writes the bits of the `count` modules from `first` to bits[0 .. (count + 63) / 64); bits
    /// past the last module are 0. `length` is the length of the word; up to kWordSlack bytes past
    /// its end may be read. Returns the number of active modules.
    template <typename C>
    std::uint64_t fill(const C* codes,
                       std::uint64_t length,
                       std::uint64_t first,
                       std::size_t count,
                       ActiveBits* bits) const;

    /// The number of parameters stored by the modules at `block` whose bits in `stores` are set.
    template <typename C>
    [[nodiscard]] std::uint64_t stored(const C* block, std::uint64_t stores) const {
        if (stores == 0) {
            return 0;
        }
        if (stored_each_ != 0) {
            return count_bits(stores) * stored_each_;
        }
        std::uint64_t sum = 0;
        for (; stores != 0; stores &= stores - 1) {
            sum += rows_[block[std::countr_zero(stores)]].stored;
        }
        return sum;
    }

    /// Bit of Tables::centre for codes of modules that store a parameter.
    static constexpr std::uint8_t kStores = 0x80;
    /// The group of rows that accept any neighbours.
    static constexpr std::uint8_t kAnyNeighbours = 0x01;
    /// Lookup tables with one byte per code. Each bit stands for a group of rows with equal guards.
    struct Tables {
        std::vector<std::uint8_t> centre; // group of the code's row; kStores: stores a parameter
        std::vector<std::uint8_t> left;   // groups that accept the code as left neighbour
        std::vector<std::uint8_t> right;  // groups that accept the code as right neighbour
        std::uint8_t at_begin = kAnyNeighbours; // groups that need no left neighbour
        std::uint8_t at_end = kAnyNeighbours;   // groups that need no right neighbour
        std::size_t banks = 0;                  // number of runs of 16 codes
        bool looks_left = false;                // some group needs a left neighbour
        bool looks_right = false;               // some group needs a right neighbour
    };

private:
    Tables tables_;
    const Row* rows_ = nullptr;
    std::uint32_t stored_each_ = 1; // parameters of each module that has any; 0: not all the same
    bool usable_ = false;
    bool has_choices_ = false;
};

} // namespace lsys
