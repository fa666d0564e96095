// SPDX-License-Identifier: MIT
// The control mesh of MeshMethod::Boxes: a box of square cross-section for each segment; the boxes
// of a plant are joined at the joints into one closed mesh (docs/documents.md, S: the report on the
// .sys forest, 2005). Each child grows out of that side of the joint whose normal is nearest to its
// heading; a side with several children is divided into tiles. A child for which no side has room
// becomes a closed box that begins within its parent.
#pragma once

#include "runtime/meshing/impl/catmull_clark.h"
#include "runtime/meshing/mesh.h"

namespace lsys {

struct BoxShape {
    float width = 1.0F; // half side of the box of a segment / radius of the segment
    /// Whether the mesh will be smoothed. Flat ends then get a rim that keeps them flat, and a
    /// branch may be narrower in its opening, the hole in the side of its parent's box. If false,
    /// each box has exactly the widths of its segment.
    bool smoothed = true;
};

/// Makes the control mesh, in which every edge has two faces. Segments without length or width, or
/// too thin for floats, are left out.
[[nodiscard]] PolygonMesh make_boxes(const Skeleton& skeleton, const BoxShape& shape);

} // namespace lsys
