// SPDX-License-Identifier: MIT
#include "runtime/derive/engine/glibc_rule_draws.h"

#include <algorithm>

namespace lsys {

GlibcRuleDraws::GlibcRuleDraws(const Bytecode& bytecode, std::uint64_t seed)
    : seed_(static_cast<std::uint32_t>(seed)), alternatives_(bytecode.rule_count, 0),
      random_(seed_) {
    for (const BytecodeProduction& production : bytecode.productions) {
        ++alternatives_[production.rule];
    }
}

void GlibcRuleDraws::prepare(std::uint32_t generation) {
    if (next_ == std::uint64_t{generation} + 1) {
        return;
    }
    if (next_ > generation) {
        random_ = GlibcRandom(seed_);
        next_ = 0;
    }
    draws_.resize(alternatives_.size());
    for (; next_ <= generation; ++next_) {
        for (std::uint32_t& number : draws_) {
            number = random_.next();
        }
    }
}

float GlibcRuleDraws::unit(std::uint32_t rule, std::uint32_t number) const {
    const std::uint32_t count = std::max(alternatives_[rule], 1U);
    return (static_cast<float>(number % count) + 0.5F) / static_cast<float>(count);
}

float GlibcRuleDraws::draw(std::uint32_t rule, std::uint32_t generation) const {
    if (next_ == std::uint64_t{generation} + 1) {
        return unit(rule, draws_[rule]);
    }
    GlibcRandom random(seed_);
    const std::uint64_t before = std::uint64_t{generation} * alternatives_.size() + rule;
    for (std::uint64_t i = 0; i < before; ++i) {
        static_cast<void>(random.next());
    }
    return unit(rule, random.next());
}

} // namespace lsys
