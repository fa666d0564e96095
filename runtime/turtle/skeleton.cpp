// SPDX-License-Identifier: MIT
#include "runtime/turtle/skeleton.h"

#include "runtime/turtle/organs.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

namespace lsys {

namespace {

std::string parent_text(std::uint32_t parent) {
    return parent == kNoSegment ? "-" : fmt::format("{}", parent);
}

std::string vector_text(const glm::vec3& v) {
    return fmt::format("({}, {}, {})", v.x, v.y, v.z);
}

std::string frame_text(const glm::quat& q) {
    return fmt::format("({}, {}, {}, {})", q.w, q.x, q.y, q.z);
}

} // namespace

std::string text_of(ItemColour colour) {
    return is_own(colour) ? fmt::format("#{:06X}", colour - kOwnColour) : fmt::format("{}", colour);
}

namespace {

void append_segment(const Skeleton& skeleton, std::uint64_t index, std::string& text) {
    const Segment& s = skeleton.segments[index];
    fmt::format_to(std::back_inserter(text),
                   "segment {} parent {} order {} base {} frame {} length {} radius {} {} spring "
                   "{} mass {} colour {} sides {}{}",
                   index, parent_text(s.parent), s.order, vector_text(s.base), frame_text(s.frame),
                   s.length, s.base_radius, s.tip_radius, s.spring, s.mass, text_of(s.colour),
                   s.sides, s.linked ? " linked" : "");
}

void append_object(const Skeleton& skeleton, std::uint64_t index, std::string& text) {
    const PlacedObject& o = skeleton.objects[index];
    const bool has_file = o.kind == TurtleOperation::MeshFile;
    const std::string name = is_organ(o) ? "surface"
                             : has_file  ? fmt::format("\"{}\"", skeleton.mesh_files[o.mesh_file])
                                         : std::string(name_of(o.kind));
    fmt::format_to(std::back_inserter(text),
                   "object {} {} parent {} order {} at {} frame {} size {} colour {}", index, name,
                   parent_text(o.parent), o.order, vector_text(o.position), frame_text(o.frame),
                   o.size, text_of(o.colour));
    for (const OrganPoint& point : points_of(skeleton, o)) {
        fmt::format_to(std::back_inserter(text), "{} {} frame {} width {} colour {} sides {}",
                       &point == points_of(skeleton, o).data() ? ":" : ",",
                       vector_text(point.position), frame_text(point.frame), point.width,
                       text_of(point.colour), point.sides);
        if (point.contour != kNoContour) {
            text += fmt::format(" contour {}", (*skeleton.contours)[point.contour].name);
        }
    }
}

void append_polygon(const Skeleton& skeleton, std::uint64_t index, std::string& text) {
    const Polygon& p = skeleton.polygons[index];
    fmt::format_to(std::back_inserter(text), "polygon {} parent {} order {} colour {}{}:", index,
                   parent_text(p.parent), p.order, text_of(p.colour),
                   p.picture == kNoPicture
                       ? std::string()
                       : fmt::format(" picture \"{}\"", skeleton.mesh_files[p.picture]));
    for (std::uint32_t c = 0; c < p.corner_count; ++c) {
        fmt::format_to(std::back_inserter(text), " {}",
                       vector_text(skeleton.corners[p.first_corner + c]));
    }
}

} // namespace

SkeletonStats measure(const Skeleton& skeleton) {
    SkeletonStats stats;
    double farthest = 0.0;
    const auto add_point = [&](const glm::vec3& point) {
        stats.bounds.add(point);
        const glm::dvec2 from_axis(point.x, point.z);
        farthest = std::max(farthest, glm::length(from_axis));
    };
    for (const Segment& segment : skeleton.segments) {
        add_point(segment.base);
        add_point(tip(segment));
        const auto length = static_cast<double>(segment.length);
        const auto a = static_cast<double>(segment.base_radius);
        const auto b = static_cast<double>(segment.tip_radius);
        stats.length += length;
        stats.volume += std::numbers::pi / 3.0 * length * (a * a + a * b + b * b);
        stats.mass += static_cast<double>(segment.mass);
        if (segment.order >= stats.segments_by_order.size()) {
            stats.segments_by_order.resize(segment.order + std::size_t{1});
        }
        ++stats.segments_by_order[segment.order];
    }
    for (const PlacedObject& object : skeleton.objects) {
        for_each_point_of(skeleton, object, add_point);
    }
    for (const glm::vec3& corner : skeleton.corners) {
        add_point(corner);
    }
    stats.height = static_cast<double>(stats.bounds.high.y - stats.bounds.low.y);
    stats.crown_width = 2.0 * farthest;
    return stats;
}

std::uint64_t line_count(const Skeleton& skeleton) {
    return skeleton.segments.size() + skeleton.objects.size() + skeleton.polygons.size();
}

void append_line(const Skeleton& skeleton,
                 std::uint64_t line,
                 OriginPrinter* origins,
                 std::string& text) {
    const LargeVector<Origin>* known = &skeleton.segment_origins;
    if (line < skeleton.segments.size()) {
        append_segment(skeleton, line, text);
    } else if (line -= skeleton.segments.size(); line < skeleton.objects.size()) {
        append_object(skeleton, line, text);
        known = &skeleton.object_origins;
    } else {
        line -= skeleton.objects.size();
        append_polygon(skeleton, line, text);
        known = &skeleton.polygon_origins;
    }
    if (origins != nullptr) {
        text += ' ';
        origins->append((*known)[line], text);
    }
    text += '\n';
}

} // namespace lsys
