// The segments of the rings of tubes, for a skin: a ring at a joint hangs half on the segment
// before it and half on the one behind it, any other on the segment that it lies at.
#pragma once

#include "runtime/meshing/mesh.h"

#include <span>

namespace lsys {

/// `segments` are those of the vertices that append_tubes() has written, with the same options.
void name_ring_segments(const Skeleton& skeleton,
                        const MeshOptions& options,
                        std::span<VertexSegments> segments);

} // namespace lsys
