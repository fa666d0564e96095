// SPDX-License-Identifier: MIT
#include "compiler/growth/impl/growth_powers.h"

#include "compiler/growth/impl/count_math.h"
#include "grammar/base/contract.h"

#include <algorithm>
#include <span>

namespace lsys::analysis {

namespace {

std::vector<Count>
product(const std::vector<Count>& a, const std::vector<Count>& b, std::size_t size) {
    LSYS_CHECK(size != 0);
    std::vector<Count> result(a.size());
    for (std::size_t row = 0; row < a.size() / size; ++row) {
        for (std::size_t k = 0; k < size; ++k) {
            const Count& factor = a[row * size + k];
            if (is_zero(factor)) {
                continue;
            }
            for (std::size_t column = 0; column < size; ++column) {
                const Count& other = b[k * size + column];
                if (!is_zero(other)) {
                    Count& sum = result[row * size + column];
                    sum = sum + factor * other;
                }
            }
        }
    }
    return result;
}

} // namespace

std::optional<GrowthPowers> GrowthPowers::make(ModuleClasses& classes) {
    const Bytecode& bytecode = classes.bytecode();
    GrowthWalk walk(classes);
    if (!walk.is_linear()) {
        return std::nullopt;
    }
    for (std::size_t i = 0; i < classes.count(); ++i) {
        if (classes.count() > kMaxClasses) {
            return std::nullopt;
        }
        classes.expand(static_cast<ClassId>(i), 0);
    }
    GrowthPowers powers;
    powers.size_ = classes.count();
    if (powers.size_ == 0) {
        return std::nullopt;
    }
    if (bytecode.settings.rewriting == RewritingMode::Cyclic) {
        powers.period_ = std::max<std::uint32_t>(1, bytecode.rewriting_rule_count());
        if (powers.period_ > kMaxClasses) {
            return std::nullopt;
        }
    }
    const std::size_t size = powers.size_;
    Power first{Matrix(size * size), Matrix(size * size)};
    std::vector<Count> unit(size);
    for (std::size_t row = 0; row < size; ++row) {
        unit[row].value = 1;
        walk.load(0, unit, unit);
        unit[row].value = 0;
        Count before{1, false, 0.0};
        for (std::uint32_t i = 0; i < powers.period_; ++i) {
            walk.advance();
            const Count after = walk.low().modules;
            powers.never_shrinks_ = powers.never_shrinks_ && !less(after, before);
            before = after;
        }
        for (std::size_t column = 0; column < size; ++column) {
            first.low[row * size + column] = walk.low(static_cast<ClassId>(column));
            first.high[row * size + column] = walk.high(static_cast<ClassId>(column));
        }
    }
    powers.powers_.push_back(std::move(first));
    return powers;
}

const GrowthPowers::Power& GrowthPowers::power(std::size_t exponent) {
    while (powers_.size() <= exponent) {
        const Power& last = powers_.back();
        Power next{product(last.low, last.low, size_), product(last.high, last.high, size_)};
        powers_.push_back(std::move(next));
    }
    return powers_[exponent];
}

GrowthWalk
GrowthPowers::advanced_by(const GrowthWalk& walk, const Power& power, std::uint32_t generations) {
    std::vector<Count> low(size_);
    std::vector<Count> high(size_);
    for (std::size_t i = 0; i < size_; ++i) {
        low[i] = walk.low(static_cast<ClassId>(i));
        high[i] = walk.high(static_cast<ClassId>(i));
    }
    GrowthWalk result = walk;
    result.load(walk.age() + generations, product(low, power.low, size_),
                product(high, power.high, size_));
    return result;
}

void GrowthPowers::advance_to(GrowthWalk& walk, std::uint32_t age) {
    LSYS_CHECK(age >= walk.age(), age, walk.age());
    // A power covers whole periods, and in cyclic rewriting a period begins with the first rule.
    while (walk.age() < age && walk.age() % period_ != 0) {
        walk.advance();
    }
    std::uint32_t periods = (age - walk.age()) / period_;
    for (std::size_t exponent = 0; periods != 0; ++exponent, periods /= 2) {
        if (periods % 2 != 0) {
            walk = advanced_by(walk, power(exponent), period_ << exponent);
        }
    }
    while (walk.age() < age) {
        walk.advance();
    }
}

void GrowthPowers::advance_while_fitting(GrowthWalk& walk,
                                         std::uint32_t age,
                                         std::uint64_t max_modules) {
    LSYS_CHECK(never_shrinks_);
    const auto one = [&] {
        GrowthWalk next = walk;
        next.advance();
        const bool fits = next.low().modules.at_most(max_modules);
        if (fits) {
            walk = std::move(next);
        }
        return fits;
    };
    while (walk.age() < age && walk.age() % period_ != 0) {
        if (!one()) {
            return;
        }
    }
    std::size_t exponent = 0;
    while (exponent < 31 && (std::uint64_t{period_} << (exponent + 1)) <= age - walk.age()) {
        ++exponent;
    }
    for (std::size_t e = exponent + 1; e-- > 0;) {
        const std::uint64_t generations = std::uint64_t{period_} << e;
        if (generations > age - walk.age()) {
            continue;
        }
        GrowthWalk next = advanced_by(walk, power(e), static_cast<std::uint32_t>(generations));
        if (next.low().modules.at_most(max_modules)) {
            walk = std::move(next);
        }
    }
    while (walk.age() < age && one()) {
    }
}

} // namespace lsys::analysis
