// Marks: of each module of a stretch, whether it may be rewritten and whether it stores a
// parameter, as bits of 64 modules each. Found by comparing vectors of codes, so that modules which
// are surely copied cost a fraction of a look at them: a module of a production with a context is
// marked only if its neighbours may be those of the context.
#pragma once

#include "runtime/derive/engine/contexts.h"
#include "runtime/derive/engine/plan.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace lsys {

/// Of 64 modules, the first in the lowest bit.
struct MarkBits {
    std::uint64_t active = 0; // may be rewritten
    std::uint64_t stores = 0; // stores a parameter
};

/// std::popcount without a call, which it is where the machine need not have the instruction.
[[nodiscard]] inline std::uint64_t count_bits(std::uint64_t bits) {
    constexpr std::uint64_t kOnes = ~std::uint64_t{0};
    bits -= (bits >> 1) & (kOnes / 3);
    bits = (bits & (kOnes / 5)) + ((bits >> 2) & (kOnes / 5));
    bits = (bits + (bits >> 4)) & (kOnes / 17);
    return (bits * (kOnes / 255)) >> 56;
}

class Marks {
public:
    /// Modules that fill() takes at most.
    static constexpr std::size_t kModules = 4096;
    static constexpr std::size_t kBlock = 64;

    /// Made for the plan as it is prepared. `contexts` tells what a search for contexts passes by;
    /// it may be null where no production in force has one.
    void prepare(const Plan& plan, const ContextTables* contexts);

    /// False: too many codes, or a match takes several modules.
    [[nodiscard]] bool usable() const { return usable_; }
    /// Whether some module is rewritten by chance alone.
    [[nodiscard]] bool has_choices() const { return has_choices_; }

    /// The marks of the `count` modules from `first`, in bits[0 .. (count + 63) / 64); bits past
    /// the last module are 0. `length`: of the word, which may be read with kWordSlack past it.
    /// Returns how many are active.
    template <typename C>
    std::uint64_t fill(const C* codes,
                       std::uint64_t length,
                       std::uint64_t first,
                       std::size_t count,
                       MarkBits* bits) const;

    /// The number of parameters stored by those of the 64 modules at `block` whose bits are set.
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

    static constexpr std::uint8_t kStores = 0x80;
    /// The group of what is rewritten whatever its neighbours are.
    static constexpr std::uint8_t kAnywhere = 0x01;
    /// What is looked up by code, a byte each: the groups of productions a module may be rewritten
    /// by, and those which may have it for a left or a right neighbour.
    struct Tables {
        std::vector<std::uint8_t> centre; // kStores: stores a parameter
        std::vector<std::uint8_t> left;
        std::vector<std::uint8_t> right;
        std::uint8_t at_begin = kAnywhere; // of the groups that need no left neighbour
        std::uint8_t at_end = kAnywhere;   // no right one
        std::size_t banks = 0;             // of 16 codes
        bool looks_left = false;
        bool looks_right = false;
    };

private:
    Tables tables_;
    const Row* rows_ = nullptr;
    std::uint32_t stored_each_ = 1; // by every module that stores any; 0: they differ
    bool usable_ = false;
    bool has_choices_ = false;
};

} // namespace lsys
