#include "runtime/export/placed_plant.h"

#include "runtime/physics/animation.h"

namespace lsys {

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
    for (glm::vec3& position : mesh.positions) {
        position = placement.scale * (position - placement.pivot);
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
    for (glm::vec3& corner : skeleton.corners) {
        corner = scale * (corner - placement.pivot);
    }
}

void place(const PlantPlacement& placement, PlantAnimation& animation) {
    for (SegmentPlace& at : animation.places) {
        at.base = placement.scale * (at.base - placement.pivot);
    }
}

} // namespace lsys
