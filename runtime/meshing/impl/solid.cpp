// SPDX-License-Identifier: MIT
#include "runtime/meshing/impl/solid.h"

#include "runtime/meshing/impl/solid_shapes.h"
#include "runtime/meshing/impl/stem_base.h"
#include "runtime/meshing/impl/tetrahedra.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace lsys {

namespace {

constexpr std::uint32_t kMinSolidSides = 9; // with fewer, thin parts would be lost
/// The edge of a cell is kCellSides * radius / number of sides of a cross-section.
constexpr double kCellSides = 7.2;
/// Default of MeshOptions::min_width, as a fraction of the largest extent of the plant.
constexpr double kMinWidth = 1.0 / 150.0;
/// Min width that the finest cells resolve, as a fraction of the largest extent.
constexpr double kFinestWidth = 2e-5;

struct Bounds3 {
    glm::dvec3 low{std::numeric_limits<double>::max()};
    glm::dvec3 high{-std::numeric_limits<double>::max()};

    void add(const glm::dvec3& point) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    [[nodiscard]] double extent() const {
        const glm::dvec3 size = high - low;
        return std::max({size.x, size.y, size.z, 0.0});
    }
};

bool is_drawn(const Segment& segment) {
    return segment.base_radius > 0.0F || segment.tip_radius > 0.0F;
}

/// Bounds of the axes of segments and of the corners of triangles.
Bounds3 bounds_of(const Skeleton& skeleton, const Mesh& flat) {
    Bounds3 bounds;
    for (const Segment& segment : skeleton.segments) {
        if (is_drawn(segment)) {
            bounds.add(segment.base);
            bounds.add(tip(segment));
        }
    }
    for (const glm::vec3& position : flat.positions) {
        bounds.add(position);
    }
    return bounds;
}

/// Height (y) of the lowest point of the plant, if a standing stem begins there.
std::optional<double> ground_of(const Skeleton& skeleton, const Bounds3& bounds) {
    constexpr float kStanding = 0.5F; // min y of the heading
    const double near = 1e-6 * bounds.extent();
    const bool stands = std::any_of(
        skeleton.segments.begin(), skeleton.segments.end(), [&](const Segment& segment) {
            return segment.parent == kNoSegment && is_drawn(segment) &&
                   heading(segment.frame).y > kStanding &&
                   static_cast<double>(segment.base.y) <= bounds.low.y + near;
        });
    return stands ? std::optional(bounds.low.y) : std::nullopt;
}

/// A piece of a segment.
struct ConePart {
    glm::vec3 base{};
    float base_radius = 0.0F;
    glm::vec3 tip{};
    float tip_radius = 0.0F;
};

/// Cuts stems that flare at the ground into cones.
class Flares {
public:
    explicit Flares(const Skeleton& skeleton)
        : skeleton_(skeleton), flare_(skeleton.tube_shape.flare) {
        if (skeleton.tube_shape.has_flare()) {
            ends_.resize(skeleton.segments.size(), kFar);
        }
    }

    /// Distance along the axis from the ground to the base of segment `i`, if its axis begins with
    /// a stem and the distance is shorter than the flare; else kFar. Call it in the order of
    /// segments.
    float arc_of(std::size_t i) {
        if (ends_.empty()) {
            return kFar;
        }
        const Segment& segment = skeleton_.segments[i];
        const bool continues = segment.parent < i && segment.linked &&
                               skeleton_.segments[segment.parent].order == segment.order;
        const float arc = continues                           ? ends_[segment.parent]
                          : stands_on_ground(segment, flare_) ? 0.0F
                                                              : kFar;
        ends_[i] = arc < flare_.height ? arc + segment.length : kFar;
        return arc;
    }

    /// The cones of a segment, valid until the next call. `arc`: arc_of() the segment.
    std::span<const ConePart> parts_of(const Segment& segment, float arc) {
        parts_.clear();
        const glm::vec3 end = tip(segment);
        if (!(arc < flare_.height)) {
            parts_.push_back({segment.base, segment.base_radius, end, segment.tip_radius});
            return parts_;
        }
        const BaseWidening wide = widening_of(flare_);
        const auto at = [&](float along) {
            const float share = segment.length > 0.0F ? along / segment.length : 0.0F;
            const float radius =
                segment.base_radius + share * (segment.tip_radius - segment.base_radius);
            return std::pair(segment.base + share * (end - segment.base),
                             wide.widened(radius, arc + along));
        };
        float begin = 0.0F;
        for (std::uint32_t k = 1; k <= kFlareParts + 1; ++k) {
            const float place =
                k > kFlareParts
                    ? segment.length
                    : flare_.height * static_cast<float>(k) / static_cast<float>(kFlareParts) - arc;
            if (place > begin && place <= segment.length) {
                const auto [low, low_radius] = at(begin);
                const auto [high, high_radius] = at(place);
                parts_.push_back({low, low_radius, high, high_radius});
                begin = place;
            }
        }
        return parts_;
    }

private:
    static constexpr float kFar = std::numeric_limits<float>::max();

    const Skeleton& skeleton_;
    const Flare& flare_;
    std::vector<float> ends_; // by segment: distance of its tip from the ground; empty: no flare
    std::vector<ConePart> parts_;
};

Solid make_solid(const Skeleton& skeleton, const Mesh& flat, const MeshOptions& options) {
    const Bounds3 bounds = bounds_of(skeleton, flat);
    Solid solid;
    solid.cell = kCellSides / std::max(options.sides, kMinSolidSides);
    solid.ground = ground_of(skeleton, bounds);
    const double extent = std::max(bounds.extent(), 1e-30);
    const double min_width =
        options.min_width > 0.0F
            ? std::max(static_cast<double>(options.min_width), kFinestWidth * extent)
            : kMinWidth * extent;
    Flares flares(skeleton);
    for (std::size_t i = 0; i < skeleton.segments.size(); ++i) {
        const Segment& segment = skeleton.segments[i];
        const float arc = flares.arc_of(i);
        if (!is_drawn(segment)) {
            continue;
        }
        for (const ConePart& part : flares.parts_of(segment, arc)) {
            SolidShape& cone = solid.shapes.emplace_back(make_cone(
                part.base, std::max(static_cast<double>(part.base_radius), 0.5 * min_width),
                part.tip, std::max(static_cast<double>(part.tip_radius), 0.5 * min_width)));
            cone.palette = segment.colour;
            cone.segment = static_cast<std::uint32_t>(i);
        }
    }
    TriangleReader corner(flat.indices);
    for (std::uint64_t i = 0; i < flat.indices.size(); i += 3) {
        const std::uint32_t first = corner[i];
        SolidShape& plate = solid.shapes.emplace_back(make_plate(
            {flat.positions[first], flat.positions[corner[i + 1]], flat.positions[corner[i + 2]]},
            0.5 * min_width));
        plate.palette = flat.colours[first];
        plate.segment = flat.segments[first][0];
    }
    return solid;
}

/// The connected pieces of a surface, and the volume within each.
class Pieces {
public:
    explicit Pieces(const SolidSurface& surface) : parent_(surface.vertices.size()) {
        std::iota(parent_.begin(), parent_.end(), 0U);
        for (const auto& [a, b, c] : surface.triangles) {
            join(a, b);
            join(a, c);
        }
        volume_.resize(parent_.size());
        for (const auto& [a, b, c] : surface.triangles) {
            const glm::dvec3& origin = surface.vertices[find(a)].position;
            volume_[find(a)] += glm::dot(surface.vertices[a].position - origin,
                                         glm::cross(surface.vertices[b].position - origin,
                                                    surface.vertices[c].position - origin));
        }
    }

    /// Whether a vertex is on the outside of a piece, not on the surface of a cavity.
    [[nodiscard]] bool is_outside(std::uint32_t vertex) { return volume_[find(vertex)] > 0.0; }
    [[nodiscard]] std::uint64_t count() const {
        return static_cast<std::uint64_t>(
            std::count_if(volume_.begin(), volume_.end(), [](double v) { return v > 0.0; }));
    }

private:
    std::uint32_t find(std::uint32_t vertex) {
        while (parent_[vertex] != vertex) {
            parent_[vertex] = parent_[parent_[vertex]];
            vertex = parent_[vertex];
        }
        return vertex;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        a = find(a);
        b = find(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

    std::vector<std::uint32_t> parent_; // by vertex; the first vertex of a piece is its own parent
    std::vector<double> volume_;        // six times the volume, at the first vertex of each piece
};

/// Normal of each vertex: the mean of the normals of the triangles around it, weighted by area.
std::vector<glm::dvec3> normals_of(const SolidSurface& surface) {
    std::vector<glm::dvec3> normals(surface.vertices.size(), glm::dvec3(0.0));
    for (const auto& triangle : surface.triangles) {
        const glm::dvec3& corner = surface.vertices[triangle[0]].position;
        const glm::dvec3 normal = glm::cross(surface.vertices[triangle[1]].position - corner,
                                             surface.vertices[triangle[2]].position - corner);
        for (const std::uint32_t vertex : triangle) {
            normals[vertex] += normal;
        }
    }
    return normals;
}

/// A vertex whose normal has the direction `along`.
MeshVertex
make_vertex(const glm::dvec3& position, const glm::dvec3& along, const SolidShape& shape) {
    const double length = glm::length(along);
    const glm::vec3 normal = length > 0.0 ? glm::vec3(along / length) : glm::vec3(0, 1, 0);
    const glm::vec3 other = std::abs(normal.x) < 0.5F ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    return {.position = position,
            .normal = normal,
            .tangent = glm::vec4(glm::normalize(glm::cross(normal, other)), 1.0F),
            .palette = shape.palette,
            .segment = shape.segment};
}

} // namespace

std::optional<Stop> append_solid(const Skeleton& skeleton,
                                 const Mesh& flat,
                                 const MeshOptions& options,
                                 MeshBuilder& builder,
                                 std::uint64_t& shells) {
    const Solid solid = make_solid(skeleton, flat, options);
    std::optional<SolidSurface> surface =
        extract_surface(solid, options.max_bytes, options.threads);
    if (!surface) {
        return Stop::Limit;
    }
    Pieces pieces(*surface);
    shells = pieces.count();
    std::erase_if(surface->triangles,
                  [&](const auto& triangle) { return !pieces.is_outside(triangle[0]); });
    constexpr std::uint32_t kUnused = ~0U;
    std::vector<std::uint32_t> number(surface->vertices.size(), kUnused);
    std::uint32_t vertices = 0;
    std::map<ItemColour, std::uint64_t> indices_of_palette;
    const auto palette_of = [&](const std::array<std::uint32_t, 3>& triangle) {
        return solid.shapes[surface->vertices[triangle[0]].shape].palette;
    };
    for (const auto& triangle : surface->triangles) {
        indices_of_palette[palette_of(triangle)] += 3;
        for (const std::uint32_t vertex : triangle) {
            if (number[vertex] == kUnused) {
                number[vertex] = vertices++;
            }
        }
    }
    std::vector<MeshBuilder::PartSize> parts;
    std::map<ItemColour, std::size_t> part_of_palette;
    for (const auto& [palette, count] : indices_of_palette) {
        part_of_palette[palette] = parts.size();
        parts.push_back(
            {.material = {.kind = MaterialKind::Plain, .palette = palette}, .index_count = count});
    }
    MeshBlock block;
    std::vector<std::span<std::uint32_t>> indices;
    if (parts.empty() || !builder.reserve_parts(parts, vertices, block, indices)) {
        return std::nullopt;
    }
    const std::vector<glm::dvec3> normals = normals_of(*surface);
    for (std::size_t i = 0; i < number.size(); ++i) {
        const SolidVertex& vertex = surface->vertices[i];
        if (number[i] != kUnused) {
            block.set(number[i],
                      make_vertex(vertex.position, normals[i], solid.shapes[vertex.shape]));
        }
    }
    std::vector<std::size_t> filled(parts.size());
    for (const auto& triangle : surface->triangles) {
        const std::size_t part = part_of_palette[palette_of(triangle)];
        for (const std::uint32_t vertex : triangle) {
            indices[part][filled[part]++] = block.first_vertex + number[vertex];
        }
    }
    return std::nullopt;
}

} // namespace lsys
