// SPDX-License-Identifier: MIT
// Heroes of a species that senses its surroundings: for each case of Surroundings a cache of
// plants that grew with neighbours in the taken quarters.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "runtime/forest/instance_cache.h"
#include "runtime/pipeline/sensed_heroes.h"
#include "runtime/pipeline/senses.h"

#include <vector>

namespace lsys {

/// Whether the plants ask an environment of a kind that neighbours shade.
[[nodiscard]] bool senses_shade(const Bytecode& bytecode);

/// Appends a cache for each case, in the order of Surroundings, to `caches`. The neighbours are the
/// first hero without neighbours, kNeighbourDistance crown radii away in the middle of each taken
/// quarter. Returns the outcome of the last cache without its value; if it is not ok(), the caches
/// are incomplete. `options.senses` is not used. `kept`: as in make_sensing_cache(). Precondition:
/// senses_shade(bytecode).
[[nodiscard]] CacheOutcome grow_surrounded_heroes(const Bytecode& bytecode,
                                                  const PlantSenses& senses,
                                                  CacheOptions options,
                                                  std::vector<InstanceCache>& caches,
                                                  std::vector<SensedStage>* kept);

} // namespace lsys
