// SPDX-License-Identifier: MIT
// TubeTriangles: computes the triangles and the number of vertices of runs before vertices are
// written. Vertices are numbered in the order in which TubeWriter writes them.
#pragma once

#include "runtime/meshing/impl/axis_reader.h"
#include "runtime/meshing/triangle_list.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace lsys {

/// Index of each colour in Axes::colours.
class ColourSlots {
public:
    /// `colours`: ascending.
    explicit ColourSlots(std::span<const ItemColour> colours) : colours_(colours) {}

    /// The index of `colour`. Precondition: `colour` is one of the colours.
    std::uint32_t operator[](ItemColour colour) const {
        if (colours_.size() == 1) {
            return 0;
        }
        const auto place = std::lower_bound(colours_.begin(), colours_.end(), colour);
        return static_cast<std::uint32_t>(place - colours_.begin());
    }

private:
    std::span<const ItemColour> colours_;
};

class TubeTriangles {
public:
    /// `lists`: by slot of colour; add() appends triangles to them.
    TubeTriangles(const MeshOptions& options,
                  const ColourSlots& slots,
                  std::span<TriangleList> lists);

    /// Appends the triangles of a run.
    void add(const Run& run);

    /// Count of the vertices of all runs so far.
    [[nodiscard]] std::uint64_t vertices() const { return vertices_; }

private:
    RingCorners add_ring(std::uint32_t sides); // only counts its vertices
    /// Adds a ring and the band between it and last_.
    void link(TriangleList& list, std::uint32_t sides);

    const ColourSlots& slots_;
    std::span<TriangleList> lists_;
    bool seam_;                  // rings have a seam: one vertex more than sides
    std::uint64_t vertices_ = 0; // number of vertices of all runs so far
    RingCorners last_;           // the ring added last
};

} // namespace lsys
