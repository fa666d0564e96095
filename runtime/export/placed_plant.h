// SPDX-License-Identifier: MIT
// The place of a plant in a file: the pivot of the plant is the origin, lengths are in the unit of
// the file. The command line places a plant after drawing and before export.
#pragma once

#include "runtime/meshing/mesh.h"
#include "runtime/turtle/skeleton.h"

#include <glm/vec3.hpp>

#include <cstdint>

namespace lsys {

struct MeshFilm;
struct PlantAnimation;

/// The point of a plant that becomes the origin of its file.
enum class PlantPivot : std::uint8_t {
    Origin, // the start of the turtle
    Base,   // the base of the first segment; without segments, the middle of the underside
    Centre, // the middle of the box around the plant
};

/// A point of the drawing is at `scale * (point - pivot)` in the file.
struct PlantPlacement {
    glm::vec3 pivot{0.0F};
    float scale = 1.0F;

    friend bool operator==(const PlantPlacement&, const PlantPlacement&) = default;
};

/// The pivot of a plant at rest, in metres. The box is the bounds of measure(), which ignore radii.
[[nodiscard]] glm::vec3 pivot_of(const Skeleton& skeleton, PlantPivot pivot);

/// Moves and scales positions, lengths and radii. Springs and masses stay as they are.
void place(const PlantPlacement& placement, Mesh& mesh);
/// Moves and scales the mesh of the film and all its frames.
void place(const PlantPlacement& placement, MeshFilm& film);
void place(const PlantPlacement& placement, Skeleton& skeleton);
void place(const PlantPlacement& placement, PlantAnimation& animation);

} // namespace lsys
