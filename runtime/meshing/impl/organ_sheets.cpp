// SPDX-License-Identifier: MIT
#include "runtime/meshing/impl/organ_sheets.h"

#include "runtime/meshing/impl/directions.h"
#include "runtime/meshing/impl/organ_axis.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace lsys {

namespace {

/// Steps between two points with different contours, so that the blend looks round.
constexpr std::uint32_t kBlendSteps = 6;

std::uint32_t sides_of(std::span<const OrganPoint> points, std::uint32_t wanted) {
    std::uint32_t sides = wanted;
    for (std::size_t i = 0; wanted == 0 && i < points.size(); ++i) {
        sides = std::max<std::uint32_t>(sides, points[i].sides);
    }
    return usable_sides(sides);
}

/// Sets the contour points, the circumference and `around` of a ring.
void set_columns(const std::vector<glm::dvec2>& a,
                 const std::vector<glm::dvec2>& b,
                 double part,
                 double width,
                 OrganRing& ring) {
    std::vector<double> lengths;
    double length = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        ring.contour_points.push_back(a[i] + part * (b[i] - a[i]));
        length += i == 0 ? 0.0 : glm::length(ring.contour_points[i] - ring.contour_points[i - 1]);
        lengths.push_back(length);
    }
    for (std::size_t i = 0; i < a.size(); ++i) {
        ring.around.push_back(length > 0.0 ? lengths[i] / length : 0.0);
        ring.contour_points[i] *= width;
    }
    ring.circumference = length * width;
}

void place_columns(const AxisStation& station, OrganRing& ring) {
    ring.heading = station.heading;
    for (const glm::dvec2& at : ring.contour_points) {
        ring.positions.push_back(station.position + at.x * station.right + at.y * station.up);
    }
}

/// Length of `step`, the way from ring a to ring b, in units of the mean of their circumferences.
double length_in_circumferences(const glm::dvec3& step, const OrganRing& a, const OrganRing& b) {
    const double mean = 0.5 * (a.circumference + b.circumference);
    return mean > 0.0 ? glm::length(step) / mean : 0.0;
}

/// The direction at `at` of the line through three neighbours; either neighbour may be null.
glm::dvec3
direction_through(const glm::dvec3* before, const glm::dvec3& at, const glm::dvec3* after) {
    glm::dvec3 sum(0.0);
    for (const glm::dvec3& step : {before != nullptr ? at - *before : glm::dvec3(0.0),
                                   after != nullptr ? *after - at : glm::dvec3(0.0)}) {
        const double length = glm::length(step);
        sum += length > 0.0 ? step / length : glm::dvec3(0.0);
    }
    return sum;
}

/// Neighbours of a column within its run, or over a smooth seam; kNone: none.
struct Neighbours {
    std::uint32_t before = kNone;
    std::uint32_t after = kNone;
};

std::vector<Neighbours> neighbours_of(const ContourLayout& layout) {
    std::vector<Neighbours> all;
    const std::uint32_t count = layout.column_count();
    for (const ContourRun& run : layout.runs) {
        const auto first = static_cast<std::uint32_t>(all.size());
        for (std::uint32_t i = 0; i <= run.sides; ++i) {
            all.push_back({i > 0 ? first + i - 1 : kNone, i < run.sides ? first + i + 1 : kNone});
        }
    }
    if (layout.seam_is_smooth) {
        all.front().before = count - 2;
        all.back().after = 1;
    }
    return all;
}

} // namespace

std::vector<OrganSheet> organ_sheets(std::span<const OrganPoint> points,
                                     const std::vector<BytecodeContour>* contours,
                                     std::uint32_t sides,
                                     std::uint32_t level) {
    const auto contour_of = [&](std::size_t i) -> ContourPointer {
        return points[i].contour == kNoContour ? nullptr : &(*contours)[points[i].contour];
    };
    const std::uint32_t fine = sides_of(points, sides);
    const std::uint32_t used = std::max(kMinSides, level < 32 ? fine >> level : 0U);
    std::vector<OrganSheet> sheets;
    double along = 0.0;
    std::size_t begin = 0;
    while (begin + 1 < points.size()) {
        std::vector<ContourPointer> blended{contour_of(begin)};
        std::size_t end = begin + 1; // the last point of the sheet
        while (end < points.size() && can_blend(blended.front(), contour_of(end))) {
            blended.push_back(contour_of(end++));
        }
        // A contour that cannot blend with the one before begins a new sheet at its point.
        end = std::min(end, points.size() - 1);
        OrganSheet sheet;
        sheet.layout = layout_of(blended, used);
        for (std::size_t i = begin; i < end; ++i) {
            const ContourPointer from = contour_of(i);
            const ContourPointer to = i + 1 - begin < blended.size() ? contour_of(i + 1) : from;
            const std::vector<glm::dvec2> a = columns_of(from, sheet.layout);
            const std::vector<glm::dvec2> b = columns_of(to, sheet.layout);
            const std::vector<AxisStation> stations =
                stations_between(points[i], points[i + 1], level, from == to ? 1 : kBlendSteps);
            if (i > begin) {
                sheet.rings.back().colour = points[i].colour;
            }
            for (std::size_t k = i == begin ? 0 : 1; k < stations.size(); ++k) {
                OrganRing ring;
                set_columns(a, b, stations[k].part, stations[k].width, ring);
                place_columns(stations[k], ring);
                ring.colour = points[i].colour;
                if (k > 0) {
                    along += length_in_circumferences(
                        stations[k].position - stations[k - 1].position, sheet.rings.back(), ring);
                }
                ring.along = along;
                sheet.rings.push_back(std::move(ring));
            }
            sheet.turns_inwards =
                i == begin ? sheet.layout.closed && signed_area(a) > 0.0 : sheet.turns_inwards;
        }
        sheets.push_back(std::move(sheet));
        begin = end;
    }
    return sheets;
}

std::vector<glm::dvec3> normals_of(const OrganSheet& sheet) {
    const std::vector<Neighbours> neighbours = neighbours_of(sheet.layout);
    const std::size_t columns = neighbours.size();
    const std::size_t count = sheet.rings.size();
    const double side = sheet.turns_inwards ? -1.0 : 1.0;
    const auto across = [&](std::size_t row, std::size_t column) {
        const std::vector<glm::dvec3>& ring = sheet.rings[row].positions;
        const Neighbours& near = neighbours[column];
        return direction_through(near.before == kNone ? nullptr : &ring[near.before], ring[column],
                                 near.after == kNone ? nullptr : &ring[near.after]);
    };
    std::vector<glm::dvec3> normals;
    normals.reserve(count * columns);
    for (std::size_t row = 0; row < count; ++row) {
        // A ring that is a point has the directions of the ring beside it.
        const bool is_point = sheet.rings[row].is_point();
        const std::size_t like = !is_point ? row : row + 1 < count ? row + 1 : row - 1;
        for (std::size_t column = 0; column < columns; ++column) {
            const glm::dvec3 along = direction_through(
                row > 0 ? &sheet.rings[row - 1].positions[column] : nullptr,
                sheet.rings[row].positions[column],
                row + 1 < count ? &sheet.rings[row + 1].positions[column] : nullptr);
            const glm::dvec3 normal = side * glm::cross(across(like, column), along);
            const double length = glm::length(normal);
            normals.push_back(length > 0.0 ? normal / length : sheet.rings[row].heading);
        }
    }
    return normals;
}

} // namespace lsys
