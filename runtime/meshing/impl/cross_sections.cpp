// SPDX-License-Identifier: MIT
#include "runtime/meshing/impl/cross_sections.h"

#include "runtime/meshing/impl/directions.h"

#include <algorithm>
#include <cmath>

namespace lsys {

namespace {

glm::dvec2 place(const ContourPoint& point) {
    return {static_cast<double>(point.x), static_cast<double>(point.y)};
}

/// Whether the points `span` and `span` + 1 are one corner.
bool is_corner(ContourPointer contour, std::size_t span) {
    return contour->points[span] == contour->points[span + 1];
}

/// Cubic Catmull-Rom between b and c (Catmull & Rom 1974, uniform).
glm::dvec2 catmull_rom(
    const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, const glm::dvec2& d, double t) {
    const glm::dvec2 slope_b = 0.5 * (c - a);
    const glm::dvec2 slope_c = 0.5 * (d - b);
    const glm::dvec2 square = 3.0 * (c - b) - 2.0 * slope_b - slope_c;
    const glm::dvec2 cube = 2.0 * (b - c) + slope_b + slope_c;
    return b + t * (slope_b + t * (square + t * cube));
}

/// The point of a run at `t` spans from its begin.
glm::dvec2
point_of_run(ContourPointer contour, const ContourLayout& layout, const ContourRun& run, double t) {
    const std::size_t last = contour->points.size() - 1;
    const std::uint32_t span =
        std::min(static_cast<std::uint32_t>(std::floor(t)), run.span_count - 1);
    const std::size_t k = run.first_span + span;
    const glm::dvec2 b = place(contour->points[k]);
    const glm::dvec2 c = place(contour->points[k + 1]);
    // Beyond an end of the run the curve goes on straight, unless it goes on over the seam.
    glm::dvec2 a = 2.0 * b - c;
    glm::dvec2 d = 2.0 * c - b;
    if (span > 0) {
        a = place(contour->points[k - 1]);
    } else if (k == 0 && layout.seam_is_smooth) {
        a = place(contour->points[last - 1]);
    }
    if (span + 1 < run.span_count) {
        d = place(contour->points[k + 2]);
    } else if (k + 1 == last && layout.seam_is_smooth) {
        d = place(contour->points[1]);
    }
    return catmull_rom(a, b, c, d, t - static_cast<double>(span));
}

} // namespace

std::uint32_t ContourLayout::column_count() const {
    std::uint32_t count = 0;
    for (const ContourRun& run : runs) {
        count += run.sides + 1;
    }
    return count;
}

bool is_closed(ContourPointer contour) {
    return contour == nullptr || contour->points.front() == contour->points.back();
}

bool can_blend(ContourPointer a, ContourPointer b) {
    if (a == b) {
        return true;
    }
    return a != nullptr && b != nullptr && a->points.size() == b->points.size() &&
           is_closed(a) == is_closed(b);
}

ContourLayout layout_of(std::span<const ContourPointer> contours, std::uint32_t sides) {
    ContourLayout layout;
    layout.closed = is_closed(contours.front());
    if (contours.front() == nullptr) {
        layout.runs.push_back({0, 0, sides});
        layout.seam_is_smooth = true;
        return layout;
    }
    const auto spans = static_cast<std::uint32_t>(contours.front()->points.size() - 1);
    const auto any_corner = [&](std::uint32_t span) {
        return std::ranges::any_of(contours,
                                   [&](ContourPointer each) { return is_corner(each, span); });
    };
    std::uint32_t drawn = 0; // spans that are no corner in at least one contour
    bool goes_on = false;    // whether the next span belongs to the last run
    for (std::uint32_t span = 0; span < spans; ++span) {
        const bool breaks = any_corner(span);
        if (breaks && std::ranges::all_of(
                          contours, [&](ContourPointer each) { return is_corner(each, span); })) {
            goes_on = false;
            continue;
        }
        if (breaks || !goes_on) {
            layout.runs.push_back({span, 0, 0});
        }
        ++layout.runs.back().span_count;
        ++drawn;
        goes_on = !breaks;
    }
    layout.seam_is_smooth = layout.closed && !any_corner(0) && !any_corner(spans - 1);
    std::uint32_t before = 0;
    std::uint32_t sides_before = 0;
    for (ContourRun& run : layout.runs) {
        before += run.span_count;
        const std::uint32_t end = (before * sides + drawn / 2) / drawn;
        run.sides = std::max(end, sides_before + 1) - sides_before;
        sides_before += run.sides;
    }
    return layout;
}

std::vector<glm::dvec2> columns_of(ContourPointer contour, const ContourLayout& layout) {
    std::vector<glm::dvec2> columns;
    columns.reserve(layout.column_count());
    for (const ContourRun& run : layout.runs) {
        for (std::uint32_t i = 0; i <= run.sides; ++i) {
            if (contour == nullptr) {
                const Direction& at = directions(run.sides)[i];
                columns.emplace_back(0.5 * static_cast<double>(at.cosine),
                                     0.5 * static_cast<double>(at.sine));
                continue;
            }
            const double t = static_cast<double>(i) * run.span_count / run.sides;
            columns.push_back(point_of_run(contour, layout, run, t));
        }
    }
    return columns;
}

double signed_area(std::span<const glm::dvec2> columns) {
    double area = 0.0;
    for (std::size_t i = 0; i < columns.size(); ++i) {
        const glm::dvec2& a = columns[i];
        const glm::dvec2& b = columns[(i + 1) % columns.size()];
        area += a.x * b.y - a.y * b.x;
    }
    return area;
}

} // namespace lsys
