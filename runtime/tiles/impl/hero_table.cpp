// SPDX-License-Identifier: MIT
#include "runtime/tiles/impl/hero_table.h"

namespace lsys {

HeroTable::HeroTable(const Forest& forest, std::span<const Hero> heroes) : forest_(forest) {
    for (const ForestSpecies& species : forest.species) {
        std::vector<std::vector<InstanceHeroes>>& stages = heroes_.emplace_back();
        for (const ForestStage& stage : species.stages) {
            stages.emplace_back(stage.cache.instances.size());
        }
    }
    for (std::size_t i = 0; i < heroes.size(); ++i) {
        const Hero& hero = heroes[i];
        InstanceHeroes& instance = heroes_[hero.species][hero.stage][hero.instance];
        (hero.ends_at_exits ? instance.alone : instance.whole) = i;
    }
}

std::size_t HeroTable::hero_of(const Tree& tree) const {
    TreeExpander expander(forest_.cache_of(tree), forest_.key);
    return instances_of(tree)[expander.root_instance(tree)].whole;
}

std::span<const InstanceHeroes> HeroTable::instances_of(const Tree& tree) const {
    return instances_of(tree.species, forest_.stage_of(tree));
}

std::span<const InstanceHeroes> HeroTable::instances_of(std::uint32_t species,
                                                        std::uint32_t stage) const {
    return heroes_[species][stage];
}

} // namespace lsys
