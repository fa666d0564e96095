// SPDX-License-Identifier: MIT
// HeroTable: maps the trees of a forest, and the instances of which trees are assembled, to heroes.
#pragma once

#include "runtime/forest/forest.h"
#include "runtime/pipeline/hero_levels.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace lsys {

inline constexpr std::size_t kNoHero = ~std::size_t{0};

/// The heroes with which an instance can be drawn. An instance without exits has only `whole`.
struct InstanceHeroes {
    std::size_t whole = kNoHero; // the instance with stand-ins at its exits
    std::size_t alone = kNoHero; // the instance without stand-ins
};

class HeroTable {
public:
    /// `heroes`: the results of plan_heroes() and plan_branches(). `forest` must outlive the table.
    HeroTable(const Forest& forest, std::span<const Hero> heroes);

    /// The index of the hero that is the plant with the root instance of the tree.
    [[nodiscard]] std::size_t hero_of(const Tree& tree) const;
    /// The heroes of all instances in the cache of a tree, or of a stage of a species.
    [[nodiscard]] std::span<const InstanceHeroes> instances_of(const Tree& tree) const;
    [[nodiscard]] std::span<const InstanceHeroes> instances_of(std::uint32_t species,
                                                               std::uint32_t stage) const;

private:
    const Forest& forest_;
    std::vector<std::vector<std::vector<InstanceHeroes>>> heroes_; // by species, stage, instance
};

} // namespace lsys
