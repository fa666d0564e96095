// SPDX-License-Identifier: MIT
// Open organs: organs after their SURFACE_BEGIN and before their end. An organ belongs to the branch
// that begins it; a branch within has organs of its own.
#pragma once

#include "runtime/derive/origin.h"
#include "runtime/turtle/impl/pose.h"
#include "runtime/turtle/skeleton.h"

#include <cstdint>
#include <vector>

namespace lsys {

/// A point of an open organ. `point` has its attributes; its place and frame are `pose`.
struct OpenOrganPoint {
    Pose pose;
    OrganPoint point;
};

struct OpenOrgan {
    std::size_t depth = 0;  // open brackets at its begin
    std::size_t first = 0;  // index of its first point in OpenOrgans::points
    bool continues = false; // begun by a `[`: continues the organ of the outer branch
    PlacedObject object;
    Origin origin;              // of its SURFACE_BEGIN
    std::uint64_t position = 0; // of its SURFACE_BEGIN in the word
    Code code = 0;              // of its SURFACE_BEGIN
};

struct OpenOrgans {
    std::vector<OpenOrgan> open;        // the innermost last
    std::vector<OpenOrganPoint> points; // of all open organs, the innermost last

    /// Whether the organ begun last belongs to the branch with `depth` open brackets.
    [[nodiscard]] bool is_open_at(std::size_t depth) const {
        return !open.empty() && open.back().depth == depth;
    }
};

} // namespace lsys
