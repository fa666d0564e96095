// SPDX-License-Identifier: MIT
#include "runtime/scene/scene.h"

#include "runtime/scene/impl/document.h"
#include "runtime/scene/impl/table_reader.h"
#include "runtime/scene/impl/tables.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace lsys {

void copy_stages_to_placement(Scene& scene) {
    const bool dominates = scene.placement.method == PlacementMethod::Domination;
    for (std::size_t i = 0; i < scene.species.size(); ++i) {
        const SceneSpecies& species = scene.species[i];
        PlacementSpecies& placed = scene.placement.species[i];
        placed.stages = static_cast<std::uint32_t>(std::max<std::size_t>(species.stages.size(), 1));
        placed.start = species.start.value_or(dominates ? StageStart::First : StageStart::Random);
        placed.years_of_stage = years_of_stage(scene, i);
    }
}

float years_of_stage(const Scene& scene, std::size_t index) {
    const SceneSpecies& species = scene.species[index];
    if (species.stages.size() <= 1) {
        return 0.0F;
    }
    if (scene.placement.method != PlacementMethod::Domination) {
        return kYearsPerStage;
    }
    return species.years_of_stage > 0.0F ? species.years_of_stage
                                         : std::max(static_cast<float>(scene.placement.years) /
                                                        static_cast<float>(species.stages.size()),
                                                    1.0F);
}

std::uint32_t last_year(const Scene& scene) {
    if (scene.placement.method == PlacementMethod::Domination) {
        return scene.placement.years;
    }
    std::size_t stages = 1;
    for (const SceneSpecies& species : scene.species) {
        stages = std::max(stages, species.stages.size());
    }
    return static_cast<std::uint32_t>(stages - 1);
}

std::optional<Scene> parse_scene(FileId file, const SourceMap& sources, Diagnostics& diagnostics) {
    const std::optional<SceneValue> root = read_toml(file, sources, diagnostics);
    if (!root) {
        return std::nullopt;
    }
    Scene scene;
    Diagnostics found;
    TableReader reader(&*root, {}, found);
    scene.placement.key =
        reader.integer("key", {0, std::numeric_limits<std::int64_t>::max()}).value_or(0);
    scene.goal.variety = reader.number("variety", {0.0, 1.0, true, {}}).value_or(0.0);
    constexpr double kBytesOfMiB = 1024.0 * 1024.0;
    scene.goal.max_bytes = static_cast<std::uint64_t>(
        kBytesOfMiB * reader.number("memory", {1.0e-3, 1.0e6, false, "MiB"}).value_or(0.0));
    const std::optional<double> season = reader.number("season", {0.0, 1.0, false, {}});
    read_terrain_table(reader.table("terrain"), scene, found);
    read_light_table(reader.table("light"), scene, found);
    read_placement_table(reader.table("placement"), scene, found);
    static_cast<void>(reader.entry("species"));
    read_species_list(*root, scene, found);
    for (SceneSpecies& species : scene.species) {
        if (season) {
            species.season = static_cast<float>(*season);
        }
    }
    read_painting_table(reader.table("painted"), scene, found);
    reader.finish();
    copy_stages_to_placement(scene);
    found.sort_by_place();
    for (const Diagnostic& diagnostic : found.all()) {
        diagnostics.add(diagnostic);
    }
    return found.has_errors() ? std::nullopt : std::optional<Scene>(std::move(scene));
}

} // namespace lsys
