#include "runtime/scene/scene.h"

#include "runtime/scene/impl/document.h"
#include "runtime/scene/impl/table_reader.h"
#include "runtime/scene/impl/tables.h"

#include <cstdint>
#include <limits>

namespace lsys {

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
    read_terrain_table(reader.table("terrain"), scene, found);
    read_placement_table(reader.table("placement"), scene, found);
    static_cast<void>(reader.entry("species"));
    read_species_list(*root, scene, found);
    read_painting_table(reader.table("painted"), scene, found);
    reader.finish();
    found.sort_by_place();
    for (const Diagnostic& diagnostic : found.all()) {
        diagnostics.add(diagnostic);
    }
    return found.has_errors() ? std::nullopt : std::optional<Scene>(std::move(scene));
}

} // namespace lsys
