// SPDX-License-Identifier: MIT
// Cross-sections of organs: the columns of vertices around a contour. Through the points of a
// contour runs a Catmull-Rom curve; a point that stands twice in a row is a corner, where the curve
// breaks. A smooth stretch between two corners is a run.
#pragma once

#include "runtime/turtle/skeleton.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace lsys {

/// A contour of the grammar; null: a circle of diameter 1.
using ContourPointer = const BytecodeContour*;

/// Columns 0 ... `sides` over the spans [first_span, first_span + span_count); span k lies between
/// the points k and k + 1 of the contour.
struct ContourRun {
    std::uint32_t first_span = 0;
    std::uint32_t span_count = 0; // 0: the circle
    std::uint32_t sides = 0;

    friend bool operator==(const ContourRun&, const ContourRun&) = default;
};

/// The columns of a ring. Each run has columns of its own, so corners and the seam have two.
struct ContourLayout {
    std::vector<ContourRun> runs;
    bool closed = false;         // the last column of a ring is the first one again
    bool seam_is_smooth = false; // closed, without a corner where it begins

    [[nodiscard]] std::uint32_t column_count() const;
};

[[nodiscard]] bool is_closed(ContourPointer contour);
/// Whether a ring can change evenly from one contour to the other: they have equal counts of
/// points, and both or none are closed.
[[nodiscard]] bool can_blend(ContourPointer a, ContourPointer b);

/// The layout for all of these contours; a corner of any of them is a corner. It has `sides` sides,
/// or one per run if there are more runs. Precondition: can_blend() for each pair.
[[nodiscard]] ContourLayout layout_of(std::span<const ContourPointer> contours,
                                      std::uint32_t sides);

/// The columns of a contour: x along the turtle's right axis, y along its up axis.
[[nodiscard]] std::vector<glm::dvec2> columns_of(ContourPointer contour,
                                                 const ContourLayout& layout);

/// Twice the area that the columns enclose, positive if they turn from x to y.
[[nodiscard]] double signed_area(std::span<const glm::dvec2> columns);

} // namespace lsys
