// SPDX-License-Identifier: MIT
#include "runtime/pipeline/impl/surrounded_heroes.h"

#include "runtime/environment/neighbours.h"
#include "runtime/forest/surroundings.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <utility>

namespace lsys {

namespace {

/// Neighbours in the middle of the taken quarters of a case, each turned towards its quarter.
std::vector<Neighbour> neighbours_of(Surroundings surroundings, double distance) {
    // Directions at yaw 0, 90, 180 and 270 degrees: x, z.
    constexpr std::array<std::array<double, 2>, 4> kDirections{
        {{1.0, 0.0}, {0.0, -1.0}, {-1.0, 0.0}, {0.0, 1.0}}};
    std::vector<Neighbour> neighbours;
    for (std::uint32_t quarter = 0; quarter < kDirections.size(); ++quarter) {
        if ((taken_quarters(surroundings) >> quarter & 1U) != 0) {
            neighbours.push_back(
                {quarter, distance * kDirections[quarter][0], distance * kDirections[quarter][1]});
        }
    }
    return neighbours;
}

} // namespace

bool senses_shade(const Bytecode& bytecode) {
    return std::any_of(bytecode.symbols.begin(), bytecode.symbols.end(),
                       [&](const BytecodeSymbol& symbol) {
                           if (!asks_environment(symbol.sense)) {
                               return false;
                           }
                           const EnvironmentKind kind =
                               bytecode.environments[static_cast<std::size_t>(symbol.sense)].kind;
                           return kind == EnvironmentKind::Shadow || kind == EnvironmentKind::Sky;
                       });
}

CacheOutcome grow_surrounded_heroes(const Bytecode& bytecode,
                                    const PlantSenses& senses,
                                    CacheOptions options,
                                    std::vector<InstanceCache>& caches,
                                    std::vector<SensedStage>* kept) {
    const std::unique_ptr<EnvironmentSense> alone = senses.make(bytecode);
    RecordingSense recording(*alone, bytecode, options.seed);
    options.senses = &recording;
    CacheOutcome outcome = make_sensing_cache(bytecode, senses, alone.get(), options, kept);
    Neighbours neighbours;
    neighbours.words = recording.take_words();
    const double distance =
        outcome.ok() ? kNeighbourDistance * crown_radius_of(outcome.cache) : 0.0;
    PlantSenses shaded = senses;
    shaded.options.neighbours = &neighbours;
    for (std::uint32_t i = 1; i < kSurroundings && outcome.ok(); ++i) {
        caches.push_back(std::exchange(outcome.cache, {}));
        neighbours.plants = neighbours_of(static_cast<Surroundings>(i), distance);
        const std::unique_ptr<EnvironmentSense> own = shaded.make(bytecode);
        options.senses = own.get();
        outcome = make_sensing_cache(bytecode, senses, own.get(), options, kept);
    }
    if (outcome.ok()) {
        caches.push_back(std::exchange(outcome.cache, {}));
    }
    return outcome;
}

} // namespace lsys
