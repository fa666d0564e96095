// ForestDocument: a scene and the forest it makes, from the file to meshes of branches.
#pragma once

#include "grammar/base/outcome.h"
#include "runtime/pipeline/forest.h"
#include "viewer/app/options.h"
#include "viewer/scene/forest_model.h"

#include <memory>
#include <string>
#include <vector>

namespace lsys::view {

struct ForestDocument {
    Scene scene; // as it was asked for
    GrownForest grown;
    ForestModel model; // of `grown`, which must not move
    MeshOptions mesh_options;
    std::vector<std::string> files; // that it is made of, where they were recorded
    double parse_seconds = 0.0;
    double mesh_seconds = 0.0;
};

/// Reads, derives, places and meshes.
[[nodiscard]] Outcome<std::shared_ptr<ForestDocument>>
make_forest_document(const ViewOptions& options, const Project& project);

/// Makes the forest of a window: `edits` of the window are applied after those of `options`, and
/// all placed trees are there: what `scene.painting` erases and adds is up to ForestPainting.
/// Heroes are taken from `known`, which may be null, where it has them.
[[nodiscard]] Outcome<std::shared_ptr<ForestDocument>>
make_unpainted_forest(const ViewOptions& options,
                      const SceneOverrides& edits,
                      const ForestDocument* known,
                      const Project& project);

/// Where a forest is seen from if nobody says: from beside and above, all of it in view.
[[nodiscard]] Camera overview(const ForestDocument& document, float aspect);

/// A camera whose eye is not in the ground: at least as high above it as a person's.
[[nodiscard]] Camera above_ground(const Camera& camera, const Terrain& terrain);

/// The light of a forest: the day of Light, with air as thick as its size asks for.
[[nodiscard]] Light forest_light(const ForestDocument& document);

} // namespace lsys::view
