// SPDX-License-Identifier: MIT
// ForestDocument: a scene and its forest, with all data from the file to the meshes.
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

class SquareSource;

struct ForestDocument {
    Scene scene; // after all overrides
    /// While a window plays growth, the trees are the trees of the moment that is shown; meanwhile
    /// only the main thread of the window reads or changes them.
    GrownForest grown;
    ForestModel model; // refers to `grown`
    /// The source of the trees of a streamed forest; `grown` then has no trees. Null for other
    /// forests. Refers to `grown`.
    std::shared_ptr<const SquareSource> squares;
    MeshOptions mesh_options;
    std::vector<std::string> files; // all requested files, readable or not; set by make_forest()
    // Height of the tallest placed tree, m; empty: too many trees to measure.
    std::optional<double> tallest;
    /// Time of the year, 0 to 1, of the first species whose grammar has a constant `season` that
    /// the scene does not define; nullopt: no such species. Set only in a window.
    std::optional<float> season;
    double parse_seconds = 0.0; // time to read and parse the scene and its grammars
    double mesh_seconds = 0.0;  // time to make the meshes of `model`
};

/// Reads the files of a scene, derives its heroes, places its trees and makes the meshes.
[[nodiscard]] Outcome<std::shared_ptr<ForestDocument>>
make_forest_document(const ViewOptions& options, const Project& project);

/// Makes the forest that a window shows. `edits` of the window are applied after the overrides of
/// `options`. `scene.painting` is not applied: ForestPainting erases and adds its trees. Heroes are
/// taken from `known` where possible; `known` may be null.
[[nodiscard]] Outcome<std::shared_ptr<ForestDocument>>
make_unpainted_forest(const ViewOptions& options,
                      const SceneOverrides& edits,
                      const ForestDocument* known,
                      const Project& project);

/// The default camera. It shows the whole forest from the side and above. If trees would then be
/// lower than a quarter of the picture, it shows the forest from the edge instead, above the
/// crowns, or a streamed forest from its middle, above the crowns. `aspect`: width / height.
[[nodiscard]] Camera first_view(const ForestDocument& document, float aspect);

/// Number of trees; in a streamed forest, an upper estimate.
[[nodiscard]] std::uint64_t tree_count(const ForestDocument& document);

/// Moves a camera that is below the ground up to the eye height of a person.
[[nodiscard]] Camera above_ground(const Camera& camera, const Terrain& terrain);

/// Default visibility in a forest in km. It is proportional to the size of the forest, so that far
/// trees keep their contrast in forests of any size; kStreamedVisibility in a streamed forest.
[[nodiscard]] double default_visibility(const ForestDocument& document);
/// Light of a forest. `visibility`: km, above 0; nullopt: default_visibility(). `changes`: values
/// that replace the values of the scene.
[[nodiscard]] Light forest_light(const ForestDocument& document,
                                 std::optional<double> visibility,
                                 const SceneLight& changes);

/// Place in the world in m on the ground vertically below or above the target of a camera.
[[nodiscard]] glm::dvec3 figure_at(const ForestDocument& document, const Camera& camera);

} // namespace lsys::view
