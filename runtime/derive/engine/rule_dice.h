// The draws of `choice generation` under `random glibc`: one call of rand() for each rule in each
// generation, in order, whether the rule has a choice or not; of c alternatives it takes number
// rand() mod c.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "runtime/base/glibc_random.h"

#include <cstdint>
#include <vector>

namespace lsys {

class RuleDice {
public:
    RuleDice(const Bytecode& bytecode, std::uint64_t seed);

    /// Makes the draws of a generation known.
    void roll(std::uint32_t generation);
    /// As u in [0, 1): the middle of the part of an alternative, if all weigh the same. Of a
    /// generation that was not rolled it takes as long as all generations before.
    [[nodiscard]] float draw(std::uint32_t rule, std::uint32_t generation) const;

private:
    [[nodiscard]] float unit(std::uint32_t rule, std::uint32_t number) const;

    std::uint32_t seed_;
    std::vector<std::uint32_t> alternatives_; // by rule
    GlibcRandom random_;                      // at the start of next_
    std::uint64_t next_ = 0;                  // generation
    std::vector<std::uint32_t> rolled_;       // by rule, of generation next_ - 1
};

} // namespace lsys
