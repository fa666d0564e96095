// SPDX-License-Identifier: MIT
#include "runtime/tiles/impl/hero_table.h"

namespace lsys {

HeroTable::HeroTable(const Forest& forest, std::span<const Hero> heroes) : forest_(forest) {
    for (const ForestSpecies& species : forest.species) {
        std::vector<std::vector<std::size_t>>& stages = heroes_.emplace_back();
        for (const ForestStage& stage : species.stages) {
            stages.emplace_back(stage.cache.instances.size());
        }
    }
    for (std::size_t i = 0; i < heroes.size(); ++i) {
        heroes_[heroes[i].species][heroes[i].stage][heroes[i].instance] = i;
    }
}

std::size_t HeroTable::hero_of(const Tree& tree) const {
    TreeExpander expander(forest_.cache_of(tree), forest_.key);
    return heroes_[tree.species][forest_.stage_of(tree)][expander.root_instance(tree)];
}

} // namespace lsys
