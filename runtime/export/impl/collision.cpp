// SPDX-License-Identifier: MIT
#include "runtime/export/impl/collision.h"

#include "runtime/export/impl/convex_hull.h"
#include "runtime/export/impl/text.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace lsys {

namespace {

constexpr std::size_t kSides = 8; // corners of a cross-section
/// Max distance of joints from the chord of a piece: the larger of kBendRadii times its thinnest
/// radius and kBendSize times the extent of the plant.
constexpr float kBendRadii = 1.0F;
constexpr float kBendSize = 0.01F;
/// Max ratio of the radii in a piece. A difference of kTaperSize times the extent of the plant is
/// always allowed.
constexpr float kTaper = 1.6F;
constexpr float kTaperSize = 0.002F;
constexpr double kCoveredShare = 0.9; // share of the area of all pieces that shapes cover
constexpr std::size_t kMinShapes = 10;
/// Engines accept hulls of at most 255 triangles; a hull of 128 vertices has 2 * 128 - 4.
constexpr std::size_t kMaxRings = 128 / kSides;

bool is_drawn(const Segment& segment) {
    return segment.length > 0.0F && (segment.base_radius > 0.0F || segment.tip_radius > 0.0F);
}

float mean_radius(const Segment& segment) {
    return 0.5F * (segment.base_radius + segment.tip_radius);
}

/// For each segment the next segment of its bough: the thickest child that begins at its tip; among
/// equals the one in the fewest brackets, then the longest, then the first.
std::vector<std::uint32_t> find_next(const Skeleton& skeleton) {
    const auto& segments = skeleton.segments;
    std::vector<std::uint32_t> next(segments.size(), kNoSegment);
    const auto is_before = [&](std::uint32_t a, std::uint32_t b) {
        const Segment& first = segments[a];
        const Segment& second = segments[b];
        if (first.base_radius != second.base_radius) {
            return first.base_radius > second.base_radius;
        }
        return first.order != second.order ? first.order < second.order
                                           : first.length > second.length;
    };
    for (std::uint32_t i = 0; i < segments.size(); ++i) {
        const Segment& segment = segments[i];
        if (segment.parent >= i || !segment.linked || !is_drawn(segment) ||
            !is_drawn(segments[segment.parent])) {
            continue;
        }
        std::uint32_t& best = next[segment.parent];
        best = best == kNoSegment || is_before(i, best) ? i : best;
    }
    return next;
}

/// Divides the trunk and the boughs of a plant into pieces.
class Boughs {
public:
    explicit Boughs(const Skeleton& skeleton) : segments_(skeleton.segments) {
        const Bounds bounds = measure(skeleton).bounds;
        const glm::vec3 extent = bounds.high - bounds.low;
        extent_ = std::max({extent.x, extent.y, extent.z});
        const std::vector<std::uint32_t> next = find_next(skeleton);
        std::vector<bool> continues(segments_.size(), false);
        for (const std::uint32_t segment : next) {
            if (segment != kNoSegment) {
                continues[segment] = true;
            }
        }
        std::vector<std::uint32_t> axis;
        for (std::uint32_t i = 0; i < segments_.size(); ++i) {
            if (continues[i] || !is_drawn(segments_[i])) {
                continue;
            }
            axis.clear();
            for (std::uint32_t at = i; at != kNoSegment; at = next[at]) {
                axis.push_back(at);
            }
            divide(axis);
        }
    }

    [[nodiscard]] std::vector<BoughPiece> take() { return std::move(pieces_); }

private:
    /// Cuts an axis into the longest runs that are nearly straight and equally thick.
    void divide(const std::vector<std::uint32_t>& axis) {
        std::size_t first = 0;
        while (first < axis.size()) {
            std::size_t count = 1;
            std::size_t step = 1;
            bool growing = true;
            // Steps double while the run fits, then halve (galloping search), so that
            // fits_one_piece() is called a logarithmic number of times per run.
            while (step > 0) {
                const bool fits = first + count + step <= axis.size() &&
                                  fits_one_piece(axis, first, count + step);
                count += fits ? step : 0;
                growing = growing && fits;
                step = growing ? 2 * step : step / 2;
            }
            add(axis, first, count);
            first += count;
        }
    }

    /// Whether the segments are nearly straight and about equally thick.
    [[nodiscard]] bool fits_one_piece(const std::vector<std::uint32_t>& axis,
                                      std::size_t first,
                                      std::size_t count) const {
        const glm::vec3 from = segments_[axis[first]].base;
        const glm::vec3 chord = tip(segments_[axis[first + count - 1]]) - from;
        const float length = glm::length(chord);
        if (!(length > 0.0F)) {
            return false;
        }
        float thinnest = mean_radius(segments_[axis[first]]);
        float thickest = thinnest;
        float farthest = 0.0F;
        for (std::size_t i = first; i < first + count; ++i) {
            const Segment& segment = segments_[axis[i]];
            thinnest = std::min(thinnest, mean_radius(segment));
            thickest = std::max(thickest, mean_radius(segment));
            const glm::vec3 arm = tip(segment) - from;
            const float along = glm::dot(arm, chord) / length;
            const float outside = std::max({along - length, -along, 0.0F});
            farthest = std::max(farthest, outside);
            farthest = std::max(farthest, glm::length(glm::cross(arm, chord)) / length);
        }
        return farthest <= std::max(kBendRadii * thinnest, kBendSize * extent_) &&
               thickest <= std::max(kTaper * thinnest, thinnest + kTaperSize * extent_);
    }

    void add(const std::vector<std::uint32_t>& axis, std::size_t first, std::size_t count) {
        BoughPiece piece;
        const auto begin = axis.begin() + static_cast<std::ptrdiff_t>(first);
        piece.segments.assign(begin, begin + static_cast<std::ptrdiff_t>(count));
        piece.from = segments_[piece.segments.front()].base;
        piece.to = tip(segments_[piece.segments.back()]);
        double length = 0.0;
        double half_area = 0.0; // m^2, half of the projected area
        for (const std::uint32_t number : piece.segments) {
            const Segment& segment = segments_[number];
            length += static_cast<double>(segment.length);
            half_area +=
                static_cast<double>(segment.length) * static_cast<double>(mean_radius(segment));
        }
        piece.radius = static_cast<float>(half_area / length);
        piece.area = 2.0 * half_area;
        pieces_.push_back(std::move(piece));
    }

    const LargeVector<Segment>& segments_;
    float extent_ = 0.0F; // m, largest side of the plant's bounding box
    std::vector<BoughPiece> pieces_;
};

/// Two unit vectors perpendicular to `axis` and to each other; the two and `axis`, in this order,
/// are right-handed.
std::array<glm::vec3, 2> across(const glm::vec3& axis) {
    const glm::vec3 other =
        std::abs(axis.y) < 0.9F ? glm::vec3(0.0F, 1.0F, 0.0F) : glm::vec3(1.0F, 0.0F, 0.0F);
    const glm::vec3 first = glm::normalize(glm::cross(axis, other));
    return {first, glm::cross(axis, first)};
}

/// cos and sin of the angle of corner `side` of a cross-section.
glm::vec2 corner_of(std::size_t side) {
    constexpr double kHalf = std::numbers::sqrt2 / 2.0;
    constexpr std::array<double, kSides> kCosines{1, kHalf, 0, -kHalf, -1, -kHalf, 0, kHalf};
    return {static_cast<float>(kCosines[side]), static_cast<float>(kCosines[(side + 6) % kSides])};
}

void add_ring(const glm::vec3& middle,
              const std::array<glm::vec3, 2>& sides,
              float radius,
              std::vector<glm::vec3>& vertices) {
    for (std::size_t i = 0; i < kSides; ++i) {
        const glm::vec2 corner = corner_of(i);
        vertices.push_back(middle + radius * (corner.x * sides[0] + corner.y * sides[1]));
    }
}

/// Makes a capsule of a vertex (a pole), four rings of vertices and a second pole. The poles are
/// the two vertices that are farthest apart, since importers find the axis of the capsule by them.
/// The round ends lie within the piece if the piece is long enough.
void make_capsule(const BoughPiece& piece, CollisionShape& shape) {
    const glm::vec3 chord = piece.to - piece.from;
    const float length = glm::length(chord);
    const glm::vec3 axis = length > 0.0F ? chord / length : glm::vec3(0.0F, 1.0F, 0.0F);
    const float radius = piece.radius;
    const float inset = std::min(radius, 0.49F * length);
    const glm::vec3 low = piece.from + inset * axis;
    const glm::vec3 high = piece.to - inset * axis;
    const std::array<glm::vec3, 2> sides = across(axis);
    constexpr auto kSlant = static_cast<float>(std::numbers::sqrt2 / 2.0);
    shape.vertices.push_back(low - radius * axis);
    add_ring(low - kSlant * radius * axis, sides, kSlant * radius, shape.vertices);
    add_ring(low, sides, radius, shape.vertices);
    add_ring(high, sides, radius, shape.vertices);
    add_ring(high + kSlant * radius * axis, sides, kSlant * radius, shape.vertices);
    shape.vertices.push_back(high + radius * axis);
    constexpr std::uint32_t kRings = 4;
    constexpr auto kCount = static_cast<std::uint32_t>(kSides);
    const auto ring = [](std::uint32_t number, std::uint32_t side) {
        return 1 + number * kCount + side % kCount;
    };
    for (std::uint32_t side = 0; side < kCount; ++side) {
        shape.triangles.push_back({0, ring(0, side + 1), ring(0, side)});
        for (std::uint32_t i = 0; i + 1 < kRings; ++i) {
            shape.triangles.push_back({ring(i, side), ring(i, side + 1), ring(i + 1, side + 1)});
            shape.triangles.push_back({ring(i, side), ring(i + 1, side + 1), ring(i + 1, side)});
        }
        shape.triangles.push_back(
            {ring(kRings - 1, side), ring(kRings - 1, side + 1), 1 + kRings * kCount});
    }
}

/// Makes the hull of the cross-sections at the ends of segments, of at most kMaxRings
/// cross-sections.
void make_hull(const Skeleton& skeleton, const BoughPiece& piece, CollisionShape& shape) {
    std::vector<glm::vec3> points;
    const std::size_t joints = piece.segments.size() + 1;
    const std::size_t rings = std::min(joints, kMaxRings);
    for (std::size_t i = 0; i < rings; ++i) {
        const std::size_t joint = i * (joints - 1) / (rings - 1);
        const Segment& segment = skeleton.segments[piece.segments[joint > 0 ? joint - 1 : 0]];
        const bool at_base = joint == 0;
        // A tip without width is a point; the hull removes its duplicates.
        add_ring(at_base ? segment.base : tip(segment), across(heading(segment.frame)),
                 at_base ? segment.base_radius : segment.tip_radius, points);
    }
    ConvexHull hull = convex_hull(points);
    shape.vertices = std::move(hull.vertices);
    shape.triangles = std::move(hull.triangles);
}

std::string name_of(const ExportInfo& info, std::size_t number) {
    const std::string name = plant_name(info);
    switch (info.collision_names) {
    case CollisionNames::Godot:
        return fmt::format("{}_{:02}-convcolonly", name, number);
    case CollisionNames::Unity:
        return fmt::format("{}_collider_{:02}", name, number);
    case CollisionNames::Unreal:
        break;
    }
    const bool capsules = info.collision == CollisionKind::Capsules;
    return fmt::format("{}_{}_{:02}", capsules ? "UCP" : "UCX", name, number);
}

} // namespace

std::vector<BoughPiece> find_boughs(const Skeleton& skeleton) {
    std::vector<BoughPiece> pieces = Boughs(skeleton).take();
    std::stable_sort(pieces.begin(), pieces.end(),
                     [](const BoughPiece& a, const BoughPiece& b) { return a.area > b.area; });
    double all = 0.0;
    for (const BoughPiece& piece : pieces) {
        all += piece.area;
    }
    double sum = 0.0;
    std::size_t count = 0;
    while (count < pieces.size() && count < kMaxCollisionShapes &&
           (count < kMinShapes || sum < kCoveredShare * all)) {
        sum += pieces[count++].area;
    }
    pieces.resize(count);
    return pieces;
}

std::vector<CollisionShape> make_collision(const Skeleton& skeleton, const ExportInfo& info) {
    std::vector<CollisionShape> shapes;
    if (info.collision == CollisionKind::None) {
        return shapes;
    }
    for (const BoughPiece& piece : find_boughs(skeleton)) {
        CollisionShape shape;
        if (info.collision == CollisionKind::Capsules) {
            make_capsule(piece, shape);
        } else {
            make_hull(skeleton, piece, shape);
        }
        if (!shape.triangles.empty()) {
            shape.name = name_of(info, shapes.size());
            shapes.push_back(std::move(shape));
        }
    }
    return shapes;
}

} // namespace lsys
