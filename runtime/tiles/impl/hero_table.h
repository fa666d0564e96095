// SPDX-License-Identifier: MIT
// HeroTable: maps each tree of a forest to its hero.
#pragma once

#include "runtime/forest/forest.h"
#include "runtime/pipeline/hero_levels.h"

#include <cstddef>
#include <span>
#include <vector>

namespace lsys {

class HeroTable {
public:
    /// `heroes`: the result of plan_heroes(). `forest` must outlive the table.
    HeroTable(const Forest& forest, std::span<const Hero> heroes);

    /// The index of the tree's hero.
    [[nodiscard]] std::size_t hero_of(const Tree& tree) const;

private:
    const Forest& forest_;
    std::vector<std::vector<std::vector<std::size_t>>> heroes_; // by species, stage and instance
};

} // namespace lsys
