// SPDX-License-Identifier: MIT
// SensedHeroes: what the heroes of a species sensed last, for viewers of forests.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "runtime/forest/instance_cache.h"
#include "runtime/pipeline/sensed_plant.h"
#include "runtime/pipeline/senses.h"
#include "runtime/turtle/skeleton.h"

#include <cstdint>
#include <vector>

namespace lsys {

/// Max heroes of a stage that are kept, to bound the memory.
inline constexpr std::uint32_t kMaxSensedHeroes = 16;

/// The heroes of a stage.
struct SensedStage {
    std::vector<SensedPlant> heroes; // by number; only the first one has obstacles
    Bounds bounds;                   // of all drawn heroes, m
};

struct SensedHeroes {
    std::vector<SensedStage> stages; // by index in ForestSpecies::stages
};

/// make_instance_cache() for heroes that sense through `hero_sense`, which may be null.
/// `options.senses`: `hero_sense` or a sense that passes words on to it. If neither `kept` nor
/// `hero_sense` is null, appends the stage of the heroes to `kept`, without bounds.
[[nodiscard]] CacheOutcome make_sensing_cache(const Bytecode& bytecode,
                                              const PlantSenses& senses,
                                              const EnvironmentSense* hero_sense,
                                              CacheOptions options,
                                              std::vector<SensedStage>* kept);

/// Completes the stages of a species after its heroes have their size. `scale`: factor by which
/// `#set height` or `#set scale` has scaled them. `caches`: by stage.
void finish_sensed_heroes(double scale,
                          const std::vector<const InstanceCache*>& caches,
                          SensedHeroes& heroes);

} // namespace lsys
