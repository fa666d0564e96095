// SPDX-License-Identifier: MIT
#include "runtime/export/impl/forest_plan.h"
#include "runtime/export/impl/json_writer.h"
#include "runtime/forest/different_trees.h"
#include "runtime/forest/surroundings.h"

#include <fmt/format.h>

#include <map>
#include <utility>

namespace lsys {

namespace {

/// Sums over the slots with the same branch id and age; hits to dropped: as in InstanceSlot.
struct KeyCounts {
    std::uint64_t slots = 0;
    std::uint64_t instances = 0;
    std::uint64_t hits = 0;
    std::uint64_t misses = 0;
    std::uint64_t recorded = 0;
    std::uint64_t dropped = 0;

    void add(const InstanceSlot& slot) {
        ++slots;
        instances += slot.variant_count;
        hits += slot.hits;
        misses += slot.misses;
        recorded += slot.recorded;
        dropped += slot.dropped;
    }
    void put(JsonWriter& json) const {
        json.member("slots", slots).member("instances", instances);
        json.member("hits", hits).member("misses", misses);
        json.member("recorded", recorded).member("dropped", dropped).name("hit_rate");
        const std::uint64_t wanted = hits + misses;
        json.literal(wanted == 0 ? "null"
                                 : fmt::format("{:.4f}", static_cast<double>(hits) /
                                                             static_cast<double>(wanted)));
    }
};

void put_cache(JsonWriter& json, const InstanceCache& cache) {
    KeyCounts all;
    std::map<std::pair<std::uint32_t, std::uint32_t>, KeyCounts> by_key;
    for (const InstanceSlot& slot : cache.slots) {
        all.add(slot);
        by_key[{slot.id, slot.age}].add(slot);
    }
    all.put(json);
    json.array("keys");
    for (const auto& [key, counts] : by_key) {
        json.object().member("id", key.first).member("age", key.second);
        counts.put(json);
        json.end();
    }
    json.end();
}

std::uint64_t cache_bytes(const ExportedStage& stage) {
    return stage.cache->byte_count() + stage.cache->skeleton.byte_count();
}

void put_species(JsonWriter& json,
                 const ForestSpecies& species,
                 std::span<const ExportedStage> stages) {
    std::uint64_t trees = 0;
    for (const ExportedStage& stage : stages) {
        trees += stage.trees;
    }
    json.object().member("name", species.name).member("trees", trees).array("stages");
    for (const ExportedStage& stage : stages) {
        json.object().member("generations", species.stages[stage.stage_index].generations);
        if (species.senses_surroundings) {
            json.member("surroundings", kSurroundingsNames[stage.stage_index % kSurroundings]);
        }
        json.member("trees", stage.trees).member("heroes", stage.cache->heroes);
        json.member("segments", stage.cache->skeleton.segments.size());
        json.member("vertices", stage.meshes->mesh.positions.size());
        json.member("cache_bytes", cache_bytes(stage));
        json.member("mesh_bytes", stage.meshes->byte_count());
        put_cache(json, *stage.cache);
        json.end();
    }
    json.end().end();
}

} // namespace

std::string forest_stats_json(const ForestScene& scene, const ForestStatsOptions& options) {
    const Forest& forest = scene.forest;
    const ForestPlan plan(scene, 0.0F, options.threads);
    const ForestCounts counts = count_forest(forest, options.threads);
    std::uint64_t bytes = 0;
    for (const ExportedStage& stage : plan.stages()) {
        bytes += cache_bytes(stage) + stage.meshes->byte_count();
    }
    return json_document([&](JsonWriter& json) {
        json.object().member("key", forest.key).member("trees", counts.trees);
        if (options.different_trees) {
            json.member("different_trees", count_different_trees(forest, options.threads));
        }
        json.member("branches", counts.branches).member("most_branches", counts.max_branches);
        json.member("segments", counts.segments).member("objects", counts.objects);
        json.member("polygons", counts.polygons).member("triangles", plan.triangle_count());
        json.member("bytes", bytes).member("digest", fmt::format("{:016x}", counts.digest));
        json.array("species");
        std::span<const ExportedStage> stages = plan.stages(); // sorted by species
        for (const ForestSpecies& species : forest.species) {
            put_species(json, species, stages.first(species.stages.size()));
            stages = stages.subspan(species.stages.size());
        }
        json.end().end();
    });
}

} // namespace lsys
