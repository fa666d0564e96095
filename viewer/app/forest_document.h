// ForestDocument: a scene and its forest, from file to meshes.
#pragma once

#include "grammar/base/outcome.h"
#include "runtime/pipeline/forest.h"
#include "viewer/app/options.h"
#include "viewer/scene/forest_model.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lsys::view {

struct ForestDocument {
    Scene scene; // after all overrides
    GrownForest grown;
    ForestModel model; // refers to `grown`
    MeshOptions mesh_options;
    std::vector<std::string> files; // all files asked for, if recorded
    std::optional<double> tallest;  // m, of the placed trees; none: too many to measure
    double parse_seconds = 0.0;
    double mesh_seconds = 0.0;
};

/// Reads, derives, places and meshes.
[[nodiscard]] Outcome<std::shared_ptr<ForestDocument>>
make_forest_document(const ViewOptions& options, const Project& project);

/// Makes the forest of a window. `edits` of the window are applied after those of `options`. All
/// placed trees are kept: ForestPainting applies `scene.painting`. Heroes are taken from `known`,
/// which may be null, where possible.
[[nodiscard]] Outcome<std::shared_ptr<ForestDocument>>
make_unpainted_forest(const ViewOptions& options,
                      const SceneOverrides& edits,
                      const ForestDocument* known,
                      const Project& project);

/// Default camera: from the side and above, with all trees in view.
[[nodiscard]] Camera overview(const ForestDocument& document, float aspect);

/// Lifts a camera below the ground to the height of a person.
[[nodiscard]] Camera above_ground(const Camera& camera, const Terrain& terrain);

/// Light of a forest; the density of the air depends on its size.
[[nodiscard]] Light forest_light(const ForestDocument& document);

} // namespace lsys::view
