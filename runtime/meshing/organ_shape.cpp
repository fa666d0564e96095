// SPDX-License-Identifier: MIT
#include "runtime/meshing/organ_shape.h"

#include "runtime/meshing/impl/organ_sheets.h"
#include "runtime/meshing/impl/surfaces.h"
#include "runtime/meshing/impl/triangulate.h"
#include "runtime/meshing/looks.h"
#include "runtime/turtle/organs.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <unordered_map>
#include <utility>

namespace lsys {

namespace {

class OrganWriter {
public:
    explicit OrganWriter(const Looks* looks) : looks_(looks) {}

    OrganShape write(const std::vector<OrganSheet>& sheets, ItemColour end_colour) {
        for (std::size_t i = 0; i < sheets.size(); ++i) {
            const OrganSheet& sheet = sheets[i];
            const OrganSheet* const before = i > 0 ? &sheets[i - 1] : nullptr;
            if (before != nullptr && before->layout.closed && sheet.layout.closed) {
                write_step(*before, sheet);
            } else {
                write_cap(sheet, sheet.rings.front(), true, sheet.rings.front().colour);
            }
            write_sheet(sheet);
            const bool goes_on =
                i + 1 < sheets.size() && sheet.layout.closed && sheets[i + 1].layout.closed;
            if (!goes_on) {
                write_cap(sheet, sheet.rings.back(), false,
                          i + 1 < sheets.size() ? sheet.rings.back().colour : end_colour);
            }
        }
        for (OrganPart& part : shape_.parts) {
            complete_tangents(part.shape);
        }
        return std::move(shape_);
    }

private:
    ShapePart& part_of(ItemColour colour, bool closed) {
        const auto found =
            std::find_if(shape_.parts.begin(), shape_.parts.end(), [&](const OrganPart& part) {
                return part.colour == colour && part.shape.material.two_sided == !closed;
            });
        if (found != shape_.parts.end()) {
            return found->shape;
        }
        OrganPart& part = shape_.parts.emplace_back();
        part.colour = colour;
        part.shape.material = wood_material(colour);
        part.shape.material.two_sided = !closed;
        return part.shape;
    }

    /// Appends a triangle unless two corners are at one place.
    static void
    append_triangle(ShapePart& part, std::array<std::uint32_t, 3> corners, bool turned) {
        const auto at = [&](std::size_t i) { return part.positions[corners[i]]; };
        if (at(0) == at(1) || at(1) == at(2) || at(2) == at(0)) {
            return;
        }
        if (turned) {
            std::swap(corners[1], corners[2]);
        }
        part.indices.insert(part.indices.end(), corners.begin(), corners.end());
    }

    void write_sheet(const OrganSheet& sheet) {
        const std::vector<glm::dvec3> normals = normals_of(sheet);
        const std::uint32_t columns = sheet.layout.column_count();
        // Seen from outside, a picture whose u follows the contour would be mirrored.
        const bool is_mirrored = sheet.layout.closed && sheet.turns_inwards;
        std::size_t row = 0;
        while (row + 1 < sheet.rings.size()) { // rows of one colour
            std::size_t last = row + 1;
            while (last + 1 < sheet.rings.size() &&
                   sheet.rings[last].colour == sheet.rings[row].colour) {
                ++last;
            }
            ShapePart& part = part_of(sheet.rings[row].colour, sheet.layout.closed);
            const auto first = static_cast<std::uint32_t>(part.positions.size());
            const float length = picture_length(looks_, sheet.rings[row].colour);
            for (std::size_t r = row; r <= last; ++r) {
                const OrganRing& ring = sheet.rings[r];
                const double v = -ring.along / static_cast<double>(length);
                for (std::uint32_t c = 0; c < columns; ++c) {
                    const double u = is_mirrored ? 1.0 - ring.around[c] : ring.around[c];
                    append_vertex(part, ring.positions[c], normals[r * columns + c], {u, v});
                }
            }
            for (std::size_t r = row; r < last; ++r) {
                write_strip(sheet, first + static_cast<std::uint32_t>(r - row) * columns, part);
            }
            row = last;
        }
    }

    /// Triangles between the rings whose vertices begin at `low` and one ring later.
    static void write_strip(const OrganSheet& sheet, std::uint32_t low, ShapePart& part) {
        const std::uint32_t columns = sheet.layout.column_count();
        std::uint32_t column = 0;
        for (const ContourRun& run : sheet.layout.runs) {
            for (std::uint32_t i = 0; i < run.sides; ++i) {
                const std::uint32_t a = low + column + i;
                const std::uint32_t d = a + columns;
                append_triangle(part, {a, a + 1, d + 1}, sheet.turns_inwards);
                append_triangle(part, {a, d + 1, d}, sheet.turns_inwards);
            }
            column += run.sides + 1;
        }
    }

    /// Numbers of the columns around a ring, each place once.
    static std::vector<std::uint32_t> outline_of(const ContourLayout& layout) {
        std::vector<std::uint32_t> outline;
        std::uint32_t column = 0;
        for (const ContourRun& run : layout.runs) {
            for (std::uint32_t i = 0; i < run.sides; ++i) {
                outline.push_back(column + i);
            }
            column += run.sides + 1;
        }
        return outline;
    }

    /// Closes a ring by a flat cap.
    void write_cap(const OrganSheet& sheet, const OrganRing& ring, bool begins, ItemColour colour) {
        if (!sheet.layout.closed || ring.is_point()) {
            return;
        }
        ShapePart& part = part_of(colour, true);
        const glm::dvec3 normal = begins ? -ring.heading : ring.heading;
        const double scale = 1.0 / ring.circumference;
        const auto first = static_cast<std::uint32_t>(part.positions.size());
        std::vector<glm::dvec2> flat; // the outline seen from outside; clockwise if `turned`
        glm::dvec2 middle(0.0);
        glm::dvec3 centre(0.0);
        for (const std::uint32_t column : outline_of(sheet.layout)) {
            const glm::dvec2& at = ring.contour_points[column];
            flat.push_back(begins ? at : glm::dvec2(at.y, at.x));
            middle += flat.back();
            centre += ring.positions[column];
            append_vertex(part, ring.positions[column], normal, scale * at);
        }
        const auto count = static_cast<std::uint32_t>(flat.size());
        middle /= static_cast<double>(count);
        centre /= static_cast<double>(count);
        const bool turned = signed_area(flat) < 0.0;
        if (is_star(flat, middle, turned)) {
            const glm::dvec2 texture = begins ? middle : glm::dvec2(middle.y, middle.x);
            const std::uint32_t centre_vertex =
                append_vertex(part, centre, normal, scale * texture);
            for (std::uint32_t i = 0; i < count; ++i) {
                append_triangle(part, {centre_vertex, first + i, first + (i + 1) % count}, turned);
            }
            return;
        }
        if (turned) {
            std::reverse(flat.begin(), flat.end());
        }
        std::vector<std::uint32_t> triangles;
        Triangulator().append(flat, triangles);
        for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) {
            const auto vertex = [&](std::size_t k) {
                return first + (turned ? count - 1 - triangles[i + k] : triangles[i + k]);
            };
            append_triangle(part, {vertex(0), vertex(1), vertex(2)}, false);
        }
    }

    /// Whether every edge is seen from `middle` in the same sense.
    static bool
    is_star(const std::vector<glm::dvec2>& flat, const glm::dvec2& middle, bool turned) {
        for (std::size_t i = 0; i < flat.size(); ++i) {
            const glm::dvec2 a = flat[i] - middle;
            const glm::dvec2 b = flat[(i + 1) % flat.size()] - middle;
            const double area = a.x * b.y - a.y * b.x;
            if (!((turned ? -area : area) > 0.0)) {
                return false;
            }
        }
        return true;
    }

    /// Joins the last ring of a closed sheet to the first ring of the next, which lies in the same
    /// plane and has other columns.
    void write_step(const OrganSheet& low, const OrganSheet& high) {
        std::vector<StepCorner> from = corners_of(low, low.rings.back());
        std::vector<StepCorner> to = corners_of(high, high.rings.front());
        // The rings begin at different places; the step begins at the nearest pair.
        const auto distance = [&](const StepCorner& corner) {
            return glm::length(corner.position - from.front().position);
        };
        const auto nearest =
            std::min_element(to.begin(), to.end(), [&](const StepCorner& a, const StepCorner& b) {
                return distance(a) < distance(b);
            });
        std::rotate(to.begin(), nearest, to.end());
        const glm::dvec3 heading = high.rings.front().heading;
        // Triangles that face ahead, and triangles that face back, which have vertices of their own.
        std::array<std::vector<std::array<const StepCorner*, 3>>, 2> sides;
        const auto add = [&](const StepCorner& a, const StepCorner& b, const StepCorner& c) {
            const std::array<const StepCorner*, 3> corners =
                high.turns_inwards ? std::array{&a, &c, &b} : std::array{&a, &b, &c};
            const glm::dvec3 area = glm::cross(corners[1]->position - corners[0]->position,
                                               corners[2]->position - corners[0]->position);
            sides[glm::dot(area, heading) > 0.0 ? 0 : 1].push_back(corners);
        };
        const auto low_corner = [&](std::size_t i) -> const StepCorner& {
            return from[i % from.size()];
        };
        const auto high_corner = [&](std::size_t k) -> const StepCorner& {
            return to[k % to.size()];
        };
        for (std::size_t i = 0, k = 0; i < from.size() || k < to.size();) {
            const double low_diagonal =
                glm::length(low_corner(i + 1).position - high_corner(k).position);
            const double high_diagonal =
                glm::length(low_corner(i).position - high_corner(k + 1).position);
            if (k == to.size() || (i < from.size() && low_diagonal <= high_diagonal)) {
                add(low_corner(i), low_corner(i + 1), high_corner(k));
                ++i;
            } else {
                add(low_corner(i), high_corner(k + 1), high_corner(k));
                ++k;
            }
        }
        ShapePart& part = part_of(high.rings.front().colour, true);
        for (const std::size_t side : {0U, 1U}) {
            std::unordered_map<const StepCorner*, std::uint32_t> vertices;
            for (const auto& corners : sides[side]) {
                std::array<std::uint32_t, 3> triangle{};
                for (std::size_t i = 0; i < corners.size(); ++i) {
                    const auto [found, is_new] = vertices.try_emplace(corners[i], 0);
                    if (is_new) {
                        found->second =
                            append_vertex(part, corners[i]->position,
                                          side == 0 ? heading : -heading, corners[i]->texture);
                    }
                    triangle[i] = found->second;
                }
                append_triangle(part, triangle, false);
            }
        }
    }

    /// A corner of one of the two rings that write_step() joins.
    struct StepCorner {
        glm::dvec3 position{};
        glm::dvec2 texture{};
    };
    static std::vector<StepCorner> corners_of(const OrganSheet& sheet, const OrganRing& ring) {
        std::vector<StepCorner> corners;
        for (const std::uint32_t column : outline_of(sheet.layout)) {
            corners.push_back({ring.positions[column],
                               ring.contour_points[column] / std::max(ring.circumference, 1e-30)});
        }
        return corners;
    }

    const Looks* looks_;
    OrganShape shape_;
};

std::vector<OrganSheet> sheets_of(const Skeleton& skeleton,
                                  const PlacedObject& object,
                                  std::uint32_t sides,
                                  std::uint32_t level) {
    return organ_sheets(points_of(skeleton, object), skeleton.contours.get(), sides, level);
}

} // namespace

OrganShape make_organ(const Skeleton& skeleton,
                      const PlacedObject& object,
                      std::uint32_t sides,
                      std::uint32_t level) {
    return OrganWriter(skeleton.looks.get())
        .write(sheets_of(skeleton, object, sides, level),
               points_of(skeleton, object).back().colour);
}

std::vector<OrganStrip> organ_strips(const Skeleton& skeleton, const PlacedObject& object) {
    std::vector<OrganStrip> strips;
    for (const OrganSheet& sheet : sheets_of(skeleton, object, 0, 0)) {
        for (std::size_t row = 0; row + 1 < sheet.rings.size(); ++row) {
            OrganStrip& strip = strips.emplace_back();
            strip.colour = sheet.rings[row].colour;
            for (const std::size_t r : {row, row + 1}) {
                for (const glm::dvec3& at : sheet.rings[r].positions) {
                    strip.corners.emplace_back(at);
                }
            }
        }
    }
    return strips;
}

} // namespace lsys
