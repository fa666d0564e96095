// Segments of the rings of tubes, for a skin: a ring at a joint hangs half on the segment before it
// and half on the segment behind it, any other ring on the segment beside it.
#pragma once

#include "runtime/meshing/mesh.h"

#include <span>

namespace lsys {

/// Fills `segments` of the vertices that append_tubes() wrote with the same options.
void name_ring_segments(const Skeleton& skeleton,
                        const MeshOptions& options,
                        std::span<VertexSegments> segments);

} // namespace lsys
