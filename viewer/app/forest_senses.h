// SPDX-License-Identifier: MIT
// What the trees of a forest sense, for pictures: obstacles of the trees near a place, and light,
// markers and directions of the nearest tree. Each tree is drawn with what its hero sensed.
#pragma once

#include "viewer/app/forest_document.h"
#include "viewer/app/sense_view.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace lsys::view {

/// Max trees whose obstacles are drawn.
inline constexpr std::size_t kMaxObstacleTrees = 64;

/// Whether a species of the forest has environments to show.
[[nodiscard]] bool has_senses(const ForestDocument& document);

/// Finds the trees with senses that are nearest to a place, on the ground.
class NearestSensing {
public:
    /// `document` outlives the object.
    NearestSensing(const ForestDocument& document, const glm::dvec3& place)
        : document_(document), place_(place) {}

    /// Adds a tree, unless it senses nothing.
    void add(const Tree& tree);
    /// Up to kMaxObstacleTrees trees, nearest first; trees at the same distance by their numbers.
    [[nodiscard]] std::vector<Tree> take();

private:
    struct Found {
        double square = 0.0; // m2, square of the distance from place_
        Tree tree;
    };
    static bool is_nearer(const Found& a, const Found& b);

    const ForestDocument& document_;
    glm::dvec3 place_;
    std::vector<Found> found_; // a heap with the farthest tree first
};

/// Displacements of environments by species.
using SpeciesMoves = std::vector<std::vector<EnvironmentMove>>;

/// Draws what `trees`, found by NearestSensing, sense. `moves`: displacements of environments since
/// the forest has grown; empty: none.
[[nodiscard]] SenseDrawing make_forest_sense_drawing(const ForestDocument& document,
                                                     const std::vector<Tree>& trees,
                                                     const SenseLook& look,
                                                     const SpeciesMoves& moves);
/// make_forest_sense_drawing() without moves, of the trees nearest to the target of a camera.
[[nodiscard]] SenseDrawing
forest_sense_drawing(const ForestDocument& document, const SenseLook& look, const Camera& camera);

/// An obstacle that a ray meets, and the tree that senses it.
struct ForestObstacleHit {
    ObstacleHit obstacle;
    Tree tree;
};
/// The first obstacle of make_forest_sense_drawing() on a ray.
[[nodiscard]] std::optional<ForestObstacleHit> first_forest_obstacle(const ForestDocument& document,
                                                                     const std::vector<Tree>& trees,
                                                                     const SpeciesMoves& moves,
                                                                     const Ray& ray);
/// `vector` (world, m) in the axes and metres in which the tree's hero sensed, before its scaling.
[[nodiscard]] glm::dvec3
in_sensing_metres(const ForestDocument& document, const Tree& tree, const glm::dvec3& vector);

} // namespace lsys::view
