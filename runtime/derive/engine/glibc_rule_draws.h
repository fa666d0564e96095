// SPDX-License-Identifier: MIT
// GlibcRuleDraws: the draws of `choice generation` under `random glibc`: one call of rand() per
// rule and generation, in order, whether the rule has a choice or not. A rule with c alternatives
// takes alternative number rand() mod c.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "runtime/base/glibc_random.h"

#include <cstdint>
#include <vector>

namespace lsys {

class GlibcRuleDraws {
public:
    GlibcRuleDraws(const Bytecode& bytecode, std::uint64_t seed);

    /// Makes the draws of all rules in a generation.
    void prepare(std::uint32_t generation);
    /// The draw as u in [0, 1): the middle of interval rand() mod c of c equal intervals. Slow for
    /// a generation other than the last prepared one: calls rand() again from its seed on.
    [[nodiscard]] float draw(std::uint32_t rule, std::uint32_t generation) const;

private:
    /// The draw u of a rule for the result `number` of rand().
    [[nodiscard]] float unit(std::uint32_t rule, std::uint32_t number) const;

    std::uint32_t seed_;
    std::vector<std::uint32_t> alternatives_; // number of productions, by rule
    GlibcRandom random_;                      // state of rand() at the start of generation next_
    std::uint64_t next_ = 0;                  // generation after the last prepared one
    std::vector<std::uint32_t> draws_;        // by rule, in generation next_ - 1
};

} // namespace lsys
