// SPDX-License-Identifier: MIT
#include "runtime/pipeline/hero_levels.h"

#include "grammar/base/contract.h"
#include "runtime/base/workers.h"
#include "runtime/forest/instance_skeleton.h"

#include <functional>
#include <optional>
#include <utility>

namespace lsys {

namespace {

/// Planning fits no level: fit_detail_levels() later fits the levels that trees use.
constexpr DetailChain kChain{.pictures = true, .first_fitted = kNoDetailLevel};

using Visit = std::function<std::optional<Stop>(
    Hero& hero, const std::vector<UserMesh>& files, const MeshOptions& alone)>;

/// Calls visit for all heroes, in parallel. Returns the stop of the first hero that has one.
std::optional<Stop> visit_heroes(const GrownForest& grown,
                                 const MeshOptions& options,
                                 const Project& project,
                                 std::vector<Hero>& heroes,
                                 const Visit& visit) {
    MeshOptions alone = options;
    alone.threads = 1; // heroes are meshed in parallel
    alone.max_bytes = project.limits.max_bytes;
    std::vector<std::optional<Stop>> stops(heroes.size());
    Workers(project.threads).for_each(heroes.size(), [&](std::uint64_t number) {
        Hero& hero = heroes[number];
        stops[number] = visit(hero, grown.user_meshes[hero.species], alone);
    });
    const auto stopped =
        std::find_if(stops.begin(), stops.end(), [](const auto& stop) { return stop.has_value(); });
    return stopped == stops.end() ? std::nullopt : *stopped;
}

} // namespace

Outcome<std::vector<Hero>>
plan_heroes(const GrownForest& grown, const MeshOptions& options, const Project& project) {
    Step step(project);
    std::vector<Hero> heroes;
    for (std::uint32_t s = 0; s < grown.forest.species.size(); ++s) {
        const ForestSpecies& species = grown.forest.species[s];
        for (std::uint32_t i = 0; i < species.stages.size(); ++i) {
            const InstanceCache& cache = species.stages[i].cache;
            const InstanceSlot& whole = cache.slots[0];
            for (std::uint32_t v = 0; v < whole.variant_count; ++v) {
                const std::uint32_t instance = cache.variants[whole.first_variant + v];
                LSYS_CHECK(cache.instances[instance].exit_count == 0, instance);
                Hero& hero = heroes.emplace_back();
                hero.species = s;
                hero.stage = i;
                hero.instance = instance;
                hero.skeleton = skeleton_of(cache, cache.instances[instance]);
            }
        }
    }
    const auto stop = visit_heroes(
        grown, options, project, heroes,
        [](Hero& hero, const std::vector<UserMesh>& files, const MeshOptions& alone) {
            std::optional<Stop> failed =
                plan_detail_levels(hero.skeleton, files, alone, kChain, hero.levels);
            Mesh finest;
            if (!failed) {
                failed = make_detail_mesh(hero.skeleton, files, hero.levels, 0, alone, finest);
            }
            for (const glm::vec3& position : finest.positions) {
                hero.bounds.add(position);
            }
            hero.in_use.resize(hero.levels.levels.size());
            hero.meshes.resize(hero.levels.levels.size());
            return failed;
        });
    if (stop) {
        return end_mesh_of_heroes(*stop, step);
    }
    return step.done(std::move(heroes));
}

Outcome<void> mesh_heroes(const GrownForest& grown,
                          const MeshOptions& options,
                          const Project& project,
                          std::vector<Hero>& heroes) {
    Step step(project);
    const auto stop =
        visit_heroes(grown, options, project, heroes,
                     [](Hero& hero, const std::vector<UserMesh>& files, const MeshOptions& alone) {
                         std::optional<Stop> failed = fit_detail_levels(
                             hero.skeleton, files, alone, kChain, hero.in_use, hero.levels);
                         for (std::size_t k = 0; k < hero.meshes.size() && !failed; ++k) {
                             if (hero.in_use[k]) {
                                 failed = make_detail_mesh(hero.skeleton, files, hero.levels, k,
                                                           alone, hero.meshes[k]);
                             }
                         }
                         return failed;
                     });
    if (stop) {
        return end_mesh_of_heroes(*stop, step);
    }
    return step.done();
}

} // namespace lsys
