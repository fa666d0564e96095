// SPDX-License-Identifier: MIT
#include "runtime/meshing/impl/tube_triangles.h"

#include "runtime/meshing/impl/tube_writer.h"

namespace lsys {

TubeTriangles::TubeTriangles(const MeshOptions& options,
                             const ColourSlots& slots,
                             std::span<TriangleList> lists)
    : slots_(slots), lists_(lists), seam_(columns_of(0, options) != 0) {}

RingCorners TubeTriangles::add_ring(std::uint32_t sides) {
    const RingCorners ring{
        .first = static_cast<std::uint32_t>(vertices_), .sides = sides, .seam = seam_};
    vertices_ += ring.columns();
    return ring;
}

/// Adds a ring, and the band of triangles between it and the ring added before.
void TubeTriangles::link(TriangleList& list, std::uint32_t sides) {
    const RingCorners ring = add_ring(sides);
    if (sides == last_.sides) {
        list.append_bands(last_, 1);
    } else {
        list.append_uneven_band(last_, ring);
    }
    last_ = ring;
}

void TubeTriangles::add(const Run& run) {
    const std::span<const Joint> joints = run.joints;
    const std::size_t last = joints.size() - 1;
    TriangleList* list = &lists_[slots_[joints[0].colour]];
    const auto begin = static_cast<std::uint32_t>(vertices_);
    vertices_ += run.begin == TubeEnd::Flat ? 1 : 0;
    last_ = add_ring(joints[0].sides);
    if (run.begin == TubeEnd::Flat) {
        list->append_fan(last_, begin, false, false);
    }
    for (std::size_t i = 1; i <= last; ++i) {
        const Joint& joint = joints[i];
        if (i == last && run.end == TubeEnd::Point) {
            const RingCorners points = add_ring(joint.sides);
            list->append_fan(last_, points.first, true, true);
            last_ = points;
        } else if (i == 1 && run.begin == TubeEnd::Point) {
            const RingCorners points = last_;
            last_ = add_ring(joint.sides);
            list->append_fan(last_, points.first, true, false);
        } else {
            link(*list, joint.sides);
        }
        for (std::uint32_t ring = 1; ring < joint.rings; ++ring) {
            link(*list, joint.sides);
        }
        if (joint.colour != joints[i - 1].colour) { // each colour has its own ring
            list = &lists_[slots_[joint.colour]];
            last_ = add_ring(joint.sides);
        }
    }
    if (run.end == TubeEnd::Point) {
        return;
    }
    for (std::uint32_t i = 0; i < closing_rings(run.end); ++i) {
        if (i == 1 && run.end == TubeEnd::Broken) { // same corners, normals of the break
            last_ = add_ring(joints[last].sides);
        } else {
            link(*list, joints[last].sides);
        }
    }
    list->append_fan(last_, static_cast<std::uint32_t>(vertices_), false, true);
    ++vertices_;
}

} // namespace lsys
