// SPDX-License-Identifier: MIT
#pragma once

namespace lsys {

/// Calls visit(corner) for the eight corners of a box along the axes.
template <typename Vector, typename Visit>
void for_each_corner(const Vector& low, const Vector& high, const Visit& visit) {
    for (unsigned corner = 0; corner < 8; ++corner) {
        visit(Vector((corner & 1U) != 0 ? high.x : low.x, (corner & 2U) != 0 ? high.y : low.y,
                     (corner & 4U) != 0 ? high.z : low.z));
    }
}

} // namespace lsys
