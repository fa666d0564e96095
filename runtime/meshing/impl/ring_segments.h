// SPDX-License-Identifier: MIT
// Segments of the rings of tubes, for a skin: a ring at a joint is bound half to the segment before
// it and half to the segment after it, any other ring to the nearest segment.
#pragma once

#include "runtime/meshing/mesh.h"

#include <span>

namespace lsys {

/// Fills `segments` of the vertices that append_tubes() wrote with the same options.
void fill_ring_segments(const Skeleton& skeleton,
                        const MeshOptions& options,
                        std::span<VertexSegments> segments);

} // namespace lsys
