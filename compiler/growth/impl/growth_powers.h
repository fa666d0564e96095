// SPDX-License-Identifier: MIT
// Growth over very many generations by powers of the growth matrix, for programs of few classes.
// Powers are made by repeated squaring.
#pragma once

#include "compiler/growth/impl/growth_walk.h"
#include "compiler/growth/impl/module_classes.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace lsys::analysis {

class GrowthPowers {
public:
    static constexpr std::size_t kMaxClasses = 48;

    /// Returns nothing if the program has no classes or more than kMaxClasses, if cyclic rewriting
    /// has more than kMaxClasses rules, or if a generation is not a linear map of the counts.
    [[nodiscard]] static std::optional<GrowthPowers> make(ModuleClasses& classes);

    /// Advances the walk to generation `age`. Precondition: age >= walk.age().
    void advance_to(GrowthWalk& walk, std::uint32_t age);
    /// Advances the walk while its lower bound is at most `max_modules`, at most to `age`.
    /// Precondition: never_shrinks().
    void advance_while_fitting(GrowthWalk& walk, std::uint32_t age, std::uint64_t max_modules);
    [[nodiscard]] bool never_shrinks() const { return never_shrinks_; }

private:
    using Matrix = std::vector<Count>; // row-major: [class before][class after]
    struct Power {
        Matrix low; // bounds of the counts
        Matrix high;
    };

    GrowthPowers() = default;
    const Power& power(std::size_t exponent); // the map of 2^exponent periods
    [[nodiscard]] GrowthWalk
    advanced_by(const GrowthWalk& walk, const Power& power, std::uint32_t generations);

    std::size_t size_ = 0;     // number of classes: rows and columns of a Matrix
    std::uint32_t period_ = 1; // generations; the number of rules in cyclic rewriting, else 1
    bool never_shrinks_ = true;
    std::vector<Power> powers_; // the maps of 1, 2, 4, ... periods
};

} // namespace lsys::analysis
