// SPDX-License-Identifier: MIT
#include "runtime/export/placed_plant.h"

#include "runtime/meshing/mesh_film.h"
#include "runtime/physics/animation.h"

namespace lsys {

namespace {

void place_points(const PlantPlacement& placement, LargeVector<glm::vec3>& points) {
    for (glm::vec3& point : points) {
        point = placement.scale * (point - placement.pivot);
    }
}

} // namespace

glm::vec3 pivot_of(const Skeleton& skeleton, PlantPivot pivot) {
    if (pivot == PlantPivot::Origin) {
        return glm::vec3(0.0F);
    }
    if (pivot == PlantPivot::Base && !skeleton.segments.empty()) {
        return skeleton.segments[0].base;
    }
    const Bounds bounds = measure(skeleton).bounds;
    const glm::vec3 middle = 0.5F * (bounds.low + bounds.high);
    return pivot == PlantPivot::Centre ? middle : glm::vec3(middle.x, bounds.low.y, middle.z);
}

void place(const PlantPlacement& placement, Mesh& mesh) {
    place_points(placement, mesh.positions);
}

void place(const PlantPlacement& placement, MeshFilm& film) {
    place(placement, film.mesh);
    for (MeshFilm::Shape& shape : film.shapes) {
        for (MeshFilm::Frame& frame : shape.earlier) {
            place_points(placement, frame.positions);
        }
    }
}

void place(const PlantPlacement& placement, Skeleton& skeleton) {
    const float scale = placement.scale;
    for (Segment& segment : skeleton.segments) {
        segment.base = scale * (segment.base - placement.pivot);
        segment.length *= scale;
        segment.base_radius *= scale;
        segment.tip_radius *= scale;
    }
    for (PlacedObject& object : skeleton.objects) {
        object.position = scale * (object.position - placement.pivot);
        object.size *= scale;
    }
    place_points(placement, skeleton.corners);
}

void place(const PlantPlacement& placement, PlantAnimation& animation) {
    for (SegmentPlace& at : animation.places) {
        at.base = placement.scale * (at.base - placement.pivot);
    }
}

} // namespace lsys
