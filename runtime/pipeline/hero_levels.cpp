// SPDX-License-Identifier: MIT
#include "runtime/pipeline/hero_levels.h"

#include "runtime/base/workers.h"
#include "runtime/forest/instance_skeleton.h"
#include "runtime/forest/tree_bounds.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>

namespace lsys {

namespace {

/// Levels are planned without scales and tints: fit_detail_levels() later sets them for the levels
/// that trees use.
constexpr DetailChain kPlantChain{.pictures = true, .first_fitted = kNoDetailLevel};
/// Chain of branches, without impostors: branches are small in the picture before they have few
/// triangles, and pictures of each branch would be large files.
constexpr DetailChain kBranchChain{.last = 8, .first_fitted = kNoDetailLevel};

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

/// An instance to make a Hero of.
struct Part {
    std::uint32_t instance = 0;
    bool ends_at_exits = false; // Hero::ends_at_exits
};
using ListParts = std::function<std::vector<Part>(const InstanceCache& cache)>;

/// Plans the levels of the listed parts of all species and stages.
Outcome<std::vector<Hero>> plan_parts(const GrownForest& grown,
                                      const MeshOptions& options,
                                      const Project& project,
                                      const ListParts& list,
                                      const DetailChain& chain) {
    Step step(project);
    std::vector<Hero> heroes;
    for (std::uint32_t s = 0; s < grown.forest.species.size(); ++s) {
        const ForestSpecies& species = grown.forest.species[s];
        for (std::uint32_t i = 0; i < species.stages.size(); ++i) {
            const InstanceCache& cache = species.stages[i].cache;
            const PartSkeletons skeletons(cache);
            for (const Part& part : list(cache)) {
                Hero& hero = heroes.emplace_back();
                hero.species = s;
                hero.stage = i;
                hero.instance = part.instance;
                hero.ends_at_exits = part.ends_at_exits;
                hero.skeleton = part.ends_at_exits ? skeletons.alone(part.instance)
                                                   : skeletons.whole(part.instance);
            }
        }
    }
    const auto stop = visit_heroes(
        grown, options, project, heroes,
        [&](Hero& hero, const std::vector<UserMesh>& files, const MeshOptions& alone) {
            std::optional<Stop> failed =
                plan_detail_levels(hero.skeleton, files, alone, chain, hero.levels);
            Mesh finest;
            if (!failed) {
                failed = make_detail_mesh(hero.skeleton, files, hero.levels, 0, alone, finest);
            }
            const InstanceCache& cache =
                grown.forest.species[hero.species].stages[hero.stage].cache;
            const glm::dvec3& entry = cache.instances[hero.instance].position;
            for (const glm::vec3& position : finest.positions) {
                hero.bounds.add(position);
                hero.reach = std::max(hero.reach, glm::distance(glm::dvec3(position), entry));
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

} // namespace

Outcome<std::vector<Hero>>
plan_heroes(const GrownForest& grown, const MeshOptions& options, const Project& project) {
    const auto list = [](const InstanceCache& cache) {
        const InstanceSlot& whole = cache.slots[0];
        std::vector<Part> parts;
        for (std::uint32_t v = 0; v < whole.variant_count; ++v) {
            parts.push_back({cache.variants[whole.first_variant + v], false});
        }
        return parts;
    };
    return plan_parts(grown, options, project, list, kPlantChain);
}

Outcome<std::vector<Hero>>
plan_branches(const GrownForest& grown, const MeshOptions& options, const Project& project) {
    const auto list = [](const InstanceCache& cache) {
        const std::vector<bool> reached = reached_slots(cache);
        std::vector<Part> parts;
        for (std::uint32_t i = 0; i < cache.instances.size(); ++i) {
            const Instance& instance = cache.instances[i];
            if (instance.slot != 0 && reached[instance.slot]) {
                parts.push_back({i, false});
            }
            if (instance.exit_count > 0 && reached[instance.slot]) {
                parts.push_back({i, true});
            }
        }
        return parts;
    };
    return plan_parts(grown, options, project, list, kBranchChain);
}

Outcome<void> mesh_heroes(const GrownForest& grown,
                          const MeshOptions& options,
                          const Project& project,
                          std::vector<Hero>& heroes) {
    Step step(project);
    const auto stop = visit_heroes(
        grown, options, project, heroes,
        [&grown](Hero& hero, const std::vector<UserMesh>& files, const MeshOptions& alone) {
            const InstanceCache& cache =
                grown.forest.species[hero.species].stages[hero.stage].cache;
            const bool is_plant = !hero.ends_at_exits && cache.instances[hero.instance].slot == 0;
            const DetailChain& chain = is_plant ? kPlantChain : kBranchChain;
            std::optional<Stop> failed =
                fit_detail_levels(hero.skeleton, files, alone, chain, hero.in_use, hero.levels);
            for (std::size_t k = 0; k < hero.meshes.size() && !failed; ++k) {
                if (hero.in_use[k]) {
                    failed = make_detail_mesh(hero.skeleton, files, hero.levels, k, alone,
                                              hero.meshes[k]);
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
