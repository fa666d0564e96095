// SPDX-License-Identifier: MIT
// SVG (W3C, "Scalable Vector Graphics 1.1"), where y goes down: the plane z = 0 seen from +Z. Lines
// have the mean diameter of their segments; a run of segments of equal width and colour is one
// polyline. Objects and polygons with a picture have the mean colour of the picture. Units are
// metres.
#include "runtime/export/impl/export_outcome.h"
#include "runtime/export/impl/formats.h"
#include "runtime/export/impl/outline.h"
#include "runtime/export/impl/text.h"
#include "runtime/meshing/looks.h"
#include "runtime/meshing/texture.h"
#include "runtime/turtle/organs.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <map>
#include <tuple>
#include <vector>

namespace lsys {

namespace {

constexpr double kLongerSide = 800.0;   // of the picture, in pixels
constexpr double kMargin = 0.02;        // fraction of the longer side
constexpr float kHairline = 1.0F / 800; // min width of a line, relative to the longer side
constexpr std::size_t kPointBytes = 2 * kNumberBytes + 2;

std::string colour_text(const glm::vec3& linear) {
    return fmt::format("#{:02x}{:02x}{:02x}", srgb_byte(linear.r), srgb_byte(linear.g),
                       srgb_byte(linear.b));
}

float width_of(const Segment& segment) {
    return segment.base_radius + segment.tip_radius;
}

glm::vec3 placed(const PlacedObject& object, const glm::vec3& corner) {
    return object.position + object.frame * (object.size * corner);
}

class Drawing {
public:
    Drawing(const Skeleton& skeleton, const ExportInfo& info, PieceWriter& out)
        : skeleton_(skeleton), info_(info), out_(out) {}

    void write();

private:
    using ObjectKey = std::tuple<TurtleOperation, std::uint32_t, std::uint16_t>;

    const std::vector<Outline>& outlines(const PlacedObject& object);
    void find_bounds();
    void put_head();
    void put_point(const glm::vec2& point);
    void put_segments();
    void put_filled(const std::string& colour, const std::vector<glm::vec2>& corners);
    void put_loops(const PlacedObject& object, const Outline& part);
    void put_polygons();
    void put_object(const PlacedObject& object);

    const Skeleton& skeleton_;
    const ExportInfo& info_;
    PieceWriter& out_;
    std::map<ObjectKey, std::vector<Outline>> outlines_;
    Bounds bounds_;
    float side_ = 0.0F; // m, longer side of the bounds
};

const std::vector<Outline>& Drawing::outlines(const PlacedObject& object) {
    const ObjectKey key{object.kind, object.mesh_file, object.colour};
    auto found = outlines_.find(key);
    if (found == outlines_.end()) {
        const std::vector<UserMesh> none;
        const bool has_user_meshes = info_.user_meshes != nullptr;
        found = outlines_
                    .emplace(key, is_organ(object)
                                      ? organ_outlines(skeleton_, object)
                                      : object_outlines(object,
                                                        has_user_meshes ? *info_.user_meshes : none,
                                                        skeleton_.looks.get()))
                    .first;
    }
    return found->second;
}

void Drawing::find_bounds() {
    for (const Segment& segment : skeleton_.segments) {
        const glm::vec3 radius(0.5F * width_of(segment));
        for (const glm::vec3& end : {segment.base, tip(segment)}) {
            bounds_.add(end - radius);
            bounds_.add(end + radius);
        }
    }
    for (const glm::vec3& corner : skeleton_.corners) {
        bounds_.add(corner);
    }
    for (const PlacedObject& object : skeleton_.objects) {
        bounds_.add(object.position);
        for (const Outline& part : outlines(object)) {
            if (part.loops.empty()) {
                for (const glm::vec3& corner : part.corners) {
                    bounds_.add(placed(object, corner));
                }
            }
            for (const std::vector<glm::vec3>& loop : part.loops) {
                for (const glm::vec3& corner : loop) {
                    bounds_.add(placed(object, corner));
                }
            }
        }
    }
    const glm::vec2 extent(bounds_.high - bounds_.low);
    side_ = std::max(extent.x, extent.y);
    side_ = side_ > 0.0F ? side_ : 1.0F;
}

void Drawing::put_head() {
    const glm::dvec2 margin(kMargin * static_cast<double>(side_));
    const glm::dvec2 low = glm::dvec2(bounds_.low) - margin;
    const glm::dvec2 high = glm::dvec2(bounds_.high) + margin;
    const glm::dvec2 extent = high - low;
    const double scale = kLongerSide / std::max(extent.x, extent.y);
    const auto rounded = [](double value) { return static_cast<float>(value); };
    out_.put(fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                         "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{:.0f}\" "
                         "height=\"{:.0f}\" viewBox=\"{} {} {} {}\">\n"
                         "<title>{}</title>\n<desc>{}: {}. Metres, seen from +Z.</desc>\n",
                         std::max(1.0, scale * extent.x), std::max(1.0, scale * extent.y),
                         rounded(low.x), rounded(-high.y), rounded(extent.x), rounded(extent.y),
                         xml_text(info_.grammar), xml_text(info_.generator),
                         xml_text(origin_line(info_))));
}

void Drawing::put_point(const glm::vec2& point) {
    char* at = put_number(out_.room(kPointBytes), point.x);
    *at++ = ',';
    at = put_number(at, 0.0F - point.y); // avoids -0
    out_.advance_to(at);
}

void Drawing::put_segments() {
    if (skeleton_.segments.empty()) {
        return;
    }
    out_.put("<g fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n");
    const float min_width = kHairline * side_;
    const Segment* last = nullptr;
    for (std::size_t i = 0; i < skeleton_.segments.size() && !out_.stopped(); ++i) {
        const Segment& segment = skeleton_.segments[i];
        const float width = std::max(width_of(segment), min_width);
        const bool same = last != nullptr && last->colour == segment.colour &&
                          std::max(width_of(*last), min_width) == width;
        if (!same || !segment.linked || segment.parent != i - 1) {
            if (last != nullptr) {
                out_.put("\"/>\n");
            }
            if (!same) {
                out_.put(fmt::format(
                    "{}<g stroke=\"{}\" stroke-width=\"{}\">\n", last != nullptr ? "</g>\n" : "",
                    colour_text(plain_colour(skeleton_.looks.get(), segment.colour)), width));
            }
            out_.put("<polyline points=\"");
            put_point(glm::vec2(segment.base));
        }
        out_.put(" ");
        put_point(glm::vec2(tip(segment)));
        last = &segment;
    }
    out_.put("\"/>\n</g>\n</g>\n");
}

void Drawing::put_filled(const std::string& colour, const std::vector<glm::vec2>& corners) {
    out_.put(fmt::format("<polygon fill=\"{}\" points=\"", colour));
    for (std::size_t i = 0; i < corners.size(); ++i) {
        out_.put(i == 0 ? "" : " ");
        put_point(corners[i]);
    }
    out_.put("\"/>\n");
}

void Drawing::put_loops(const PlacedObject& object, const Outline& part) {
    out_.put(fmt::format("<path fill=\"{}\" fill-rule=\"evenodd\" d=\"", colour_text(part.colour)));
    for (const std::vector<glm::vec3>& loop : part.loops) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
            out_.put(i == 0 ? "M" : " ");
            put_point(glm::vec2(placed(object, loop[i])));
        }
        out_.put("z");
    }
    out_.put("\"/>\n");
}

void Drawing::put_polygons() {
    std::map<std::uint32_t, glm::vec3> pictures; // mean colours
    const std::vector<UserMesh> none;
    const std::vector<UserMesh>& files = info_.user_meshes != nullptr ? *info_.user_meshes : none;
    std::vector<glm::vec2> points;
    for (std::size_t i = 0; i < skeleton_.polygons.size() && !out_.stopped(); ++i) {
        const Polygon& polygon = skeleton_.polygons[i];
        points.clear();
        for (std::uint32_t c = 0; c < polygon.corner_count; ++c) {
            points.emplace_back(skeleton_.corners[polygon.first_corner + c]);
        }
        glm::vec3 colour = plain_colour(skeleton_.looks.get(), polygon.colour);
        if (polygon.picture < files.size() && files[polygon.picture].picture != nullptr) {
            const auto [found, added] = pictures.try_emplace(polygon.picture);
            if (added) {
                found->second = mean_colour(*files[polygon.picture].picture);
            }
            const Look* const look =
                skeleton_.looks == nullptr ? nullptr : skeleton_.looks->find(polygon.colour);
            if (look == nullptr || look->picture == nullptr) {
                colour = found->second * (look != nullptr ? look->colour.value_or(glm::vec3(1.0F))
                                                          : glm::vec3(1.0F));
            }
        }
        put_filled(colour_text(colour), points);
    }
}

void Drawing::put_object(const PlacedObject& object) {
    std::vector<glm::vec2> points;
    for (const Outline& part : outlines(object)) {
        if (!part.loops.empty()) {
            put_loops(object, part);
            continue;
        }
        points.clear();
        for (const glm::vec3& corner : part.corners) {
            points.emplace_back(placed(object, corner));
        }
        const std::vector<glm::vec2> corners = convex_hull(points);
        if (corners.size() >= 3) {
            put_filled(colour_text(part.colour), corners);
        }
    }
}

void Drawing::write() {
    find_bounds();
    put_head();
    put_segments();
    put_polygons();
    for (std::size_t i = 0; i < skeleton_.objects.size() && !out_.stopped(); ++i) {
        put_object(skeleton_.objects[i]);
    }
    out_.put("</svg>\n");
}

} // namespace

Outcome<void> write_svg(const ExportJob& job, PieceWriter& out) {
    Drawing(job.skeleton, job.info, out).write();
    return finish(out);
}

} // namespace lsys
