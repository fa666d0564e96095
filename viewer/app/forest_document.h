// SPDX-License-Identifier: MIT
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

class SquareSource;

struct ForestDocument {
    Scene scene; // after all overrides
    /// While a window plays growth, the trees are those of the moment shown; then only the main
    /// thread of the window reads or changes them.
    GrownForest grown;
    ForestModel model; // refers to `grown`
    /// The trees of a streamed forest; `grown` then has none. Null for other forests. Refers to
    /// `grown`.
    std::shared_ptr<const SquareSource> squares;
    MeshOptions mesh_options;
    std::vector<std::string> files; // all requested files, readable or not, if recorded
    // Height of the tallest placed tree, m; empty: too many trees to measure.
    std::optional<double> tallest;
    /// Time of the year of the first species that follows Scene::species.season; empty: none does.
    /// Only in a window.
    std::optional<float> season;
    double parse_seconds = 0.0;
    double mesh_seconds = 0.0;
};

/// Reads, derives, places and meshes.
[[nodiscard]] Outcome<std::shared_ptr<ForestDocument>>
make_forest_document(const ViewOptions& options, const Project& project);

/// Makes the forest that a window shows. `edits` of the window are applied after the overrides of
/// `options`. All placed trees are kept: ForestPainting applies `scene.painting`. Heroes are taken
/// from `known`, which may be null, where possible.
[[nodiscard]] Outcome<std::shared_ptr<ForestDocument>>
make_unpainted_forest(const ViewOptions& options,
                      const SceneOverrides& edits,
                      const ForestDocument* known,
                      const Project& project);

/// Default camera. It shows the whole forest from the side and above. If trees would then be lower
/// than a quarter of the picture, it shows the forest from its edge, above the crowns; a streamed
/// forest from its middle, above the crowns. `aspect`: width / height.
[[nodiscard]] Camera first_view(const ForestDocument& document, float aspect);

/// Number of trees; in a streamed forest, an upper estimate.
[[nodiscard]] std::uint64_t tree_count(const ForestDocument& document);

/// Lifts a camera below the ground to the height of a person.
[[nodiscard]] Camera above_ground(const Camera& camera, const Terrain& terrain);

/// Default visibility in a forest, km: in proportion to its size, so that far trees keep their
/// contrast in forests of any size; kStreamedVisibility in a streamed forest.
[[nodiscard]] double default_visibility(const ForestDocument& document);
/// Light of a forest. `visibility`: km, above 0; empty: default_visibility(). `changes`: values
/// that replace the scene's.
[[nodiscard]] Light forest_light(const ForestDocument& document,
                                 std::optional<double> visibility,
                                 const SceneLight& changes);

/// Place on the ground below or above the target of a camera, in the world, m.
[[nodiscard]] glm::dvec3 figure_at(const ForestDocument& document, const Camera& camera);

} // namespace lsys::view
