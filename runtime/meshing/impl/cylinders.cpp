// SPDX-License-Identifier: MIT
#include "runtime/meshing/impl/cylinders.h"

#include "runtime/base/workers.h"
#include "runtime/meshing/impl/directions.h"
#include "runtime/meshing/impl/groups.h"
#include "runtime/meshing/looks.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

namespace lsys {

namespace {

constexpr std::uint64_t kSegmentsPerPiece = 4096;
constexpr std::uint32_t kMaxLevels = 8; // a higher MeshOptions::level counts as this
constexpr float kMaxRadius = 1e18F;     // m

/// The cone of a segment: rings of `sides` corners, or points.
struct Cone {
    std::uint32_t sides = 0; // 0: the segment is not drawn
    float base_radius = 0.0F;
    float tip_radius = 0.0F;

    [[nodiscard]] std::uint32_t caps() const {
        return (base_radius > 0.0F ? 1U : 0U) + (tip_radius > 0.0F ? 1U : 0U);
    }
    /// A ring has one vertex more than sides, for the seam; a point has a vertex for each side.
    [[nodiscard]] std::uint32_t vertices() const {
        return sides == 0 ? 0 : 2 * sides + caps() * (sides + 1);
    }
    [[nodiscard]] std::uint32_t indices() const {
        return sides == 0 ? 0 : 3 * (caps() * sides + caps() * (sides - 2));
    }
};

Cone cone_of(const Segment& segment, const MeshOptions& options) {
    const std::uint32_t whole =
        usable_sides(options.sides != 0 ? options.sides : std::uint32_t{segment.sides});
    Cone cone;
    cone.sides = std::max(whole >> std::min(options.level, kMaxLevels), kMinSides);
    // A radius that is too small for the resolution of floats at this place counts as 0.
    const glm::vec3 end = tip(segment);
    float far = 0.0F;
    for (int i = 0; i < 3; ++i) {
        far = std::max({far, std::abs(segment.base[i]), std::abs(end[i])});
    }
    const auto drawn = [&](float radius) {
        const float min_radius = std::max(4e-7F * static_cast<float>(cone.sides) * far, 1e-18F);
        return radius > min_radius ? std::min(radius, kMaxRadius) : 0.0F;
    };
    cone.base_radius = drawn(segment.base_radius);
    cone.tip_radius = drawn(segment.tip_radius);
    if (!(segment.length > std::max(1e-6F * far, 1e-18F)) || cone.caps() == 0) {
        cone = {};
    }
    return cone;
}

/// Writes cones one after the other.
class ConeWriter {
public:
    ConeWriter(const MeshBlock& block,
               std::span<std::uint32_t> indices,
               const Looks* looks,
               std::uint64_t vertex,
               std::uint64_t index)
        : block_(block), indices_(indices), looks_(looks), vertex_(vertex), index_(index) {}

    void write(const Segment& segment, std::uint32_t number, const Cone& cone) {
        number_ = number;
        axes_ = glm::mat3_cast(segment.frame);
        ring_directions_ = directions(cone.sides);
        const float length = segment.length;
        const float slope = cone.base_radius - cone.tip_radius;
        const glm::vec2 normal = glm::normalize(glm::vec2(length, slope));
        const float v =
            -length / (std::numbers::pi_v<float> * (cone.base_radius + cone.tip_radius) *
                       picture_length(looks_, segment.colour));
        const std::uint64_t low = vertex_;
        put_ring(segment, cone.sides, {segment.base, cone.base_radius, normal, 0.0F});
        const std::uint64_t high = vertex_;
        put_ring(segment, cone.sides, {tip(segment), cone.tip_radius, normal, v});
        for (std::uint32_t i = 0; i < cone.sides; ++i) {
            if (cone.base_radius > 0.0F) {
                put_triangle(low + i, low + i + 1, high + i + (cone.tip_radius > 0.0F ? 1U : 0U));
            }
            if (cone.tip_radius > 0.0F) {
                put_triangle(low + i, high + i + 1, high + i);
            }
        }
        if (cone.base_radius > 0.0F) {
            put_cap(segment, cone.sides, {segment.base, cone.base_radius, {0.0F, -1.0F}, 0.0F});
        }
        if (cone.tip_radius > 0.0F) {
            put_cap(segment, cone.sides, {tip(segment), cone.tip_radius, {0.0F, 1.0F}, 0.0F});
        }
    }

private:
    struct Ring {
        glm::vec3 centre;
        float radius;
        glm::vec2 normal; // components away from the axis and along the axis
        float v;          // texture coordinate
    };

    void put_ring(const Segment& segment, std::uint32_t sides, const Ring& ring) {
        const bool point = ring.radius == 0.0F;
        const float step = 1.0F / static_cast<float>(sides);
        for (std::uint32_t i = 0; i < sides + (point ? 0U : 1U); ++i) {
            glm::vec3 out =
                ring_directions_[i].cosine * axes_[2] + ring_directions_[i].sine * axes_[0];
            glm::vec3 across =
                ring_directions_[i].cosine * axes_[0] - ring_directions_[i].sine * axes_[2];
            if (point) { // the vertex of a side lies halfway to the next corner
                out += ring_directions_[i + 1].cosine * axes_[2] +
                       ring_directions_[i + 1].sine * axes_[0];
                out = glm::normalize(out);
                across = glm::cross(axes_[1], out);
            }
            block_.set(
                vertex_++,
                {.position = ring.centre + ring.radius * out,
                 .normal = ring.normal.x * out + ring.normal.y * axes_[1],
                 .texture_coordinate = {(static_cast<float>(i) + (point ? 0.5F : 0.0F)) * step,
                                        ring.v},
                 .tangent = glm::vec4(across, 1.0F),
                 .palette = segment.colour,
                 .segment = number_});
        }
    }

    void put_cap(const Segment& segment, std::uint32_t sides, const Ring& ring) {
        const std::uint64_t first = vertex_;
        const bool up = ring.normal.y > 0.0F;
        for (std::uint32_t i = 0; i < sides; ++i) {
            const Direction& at = ring_directions_[i];
            const glm::vec3 out = at.cosine * axes_[2] + at.sine * axes_[0];
            block_.set(vertex_++, {.position = ring.centre + ring.radius * out,
                                   .normal = ring.normal.y * axes_[1],
                                   .texture_coordinate = {0.5F + 0.5F * at.sine,
                                                          0.5F + (up ? 0.5F : -0.5F) * at.cosine},
                                   .tangent = glm::vec4(axes_[0], 1.0F),
                                   .palette = segment.colour,
                                   .segment = number_});
        }
        for (std::uint32_t i = 1; i + 1 < sides; ++i) {
            put_triangle(first, first + i + (up ? 0U : 1U), first + i + (up ? 1U : 0U));
        }
    }

    void put_triangle(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
        for (const std::uint64_t corner : {a, b, c}) {
            indices_[index_++] = static_cast<std::uint32_t>(block_.first_vertex + corner);
        }
    }

    const MeshBlock& block_;
    std::span<std::uint32_t> indices_; // room for the indices of the current part
    const Looks* looks_;               // of the skeleton, may be null
    std::uint64_t vertex_;             // the next vertex to write
    std::uint64_t index_;              // the next item of indices_ to write
    glm::mat3 axes_{1.0F};
    const Direction* ring_directions_ = nullptr;
    std::uint32_t number_ = kNoSegment; // number of the current segment
};

/// Segments of one colour that one thread writes.
struct Piece {
    std::uint64_t first = 0; // items [first, end) of Groups::items
    std::uint64_t end = 0;
    std::size_t part = 0;       // number of the group
    std::uint64_t vertices = 0; // count of vertices, later the number of the first
    std::uint64_t indices = 0;  // count of indices, later the place of the first in the part
};

} // namespace

void append_cylinders(const Skeleton& skeleton, const MeshOptions& options, MeshBuilder& builder) {
    const Groups groups = group_items(skeleton.segments.size(), [&](std::uint64_t i) {
        const Segment& segment = skeleton.segments[i];
        return cone_of(segment, options).sides == 0 ? kNoGroup : std::uint64_t{segment.colour};
    });
    if (groups.items.empty()) {
        return;
    }
    // Sorting groups by colour sorts materials too: bark first, then plain colours by index.
    std::vector<Piece> pieces;
    std::vector<std::size_t> first_piece;
    for (const Group& group : groups.groups) {
        first_piece.push_back(pieces.size());
        for (std::uint64_t i = 0; i < group.count; i += kSegmentsPerPiece) {
            Piece& piece = pieces.emplace_back();
            piece.first = group.first + i;
            piece.end = group.first + std::min(group.count, i + kSegmentsPerPiece);
            piece.part = first_piece.size() - 1;
        }
    }
    first_piece.push_back(pieces.size());
    Workers workers(options.threads);
    workers.for_each(pieces.size(), [&](std::uint64_t i) {
        Piece& piece = pieces[i];
        for (std::uint64_t item = piece.first; item < piece.end; ++item) {
            const Cone cone = cone_of(skeleton.segments[groups.items[item]], options);
            piece.vertices += cone.vertices();
            piece.indices += cone.indices();
        }
    });
    std::uint64_t vertices = 0;
    std::vector<MeshBuilder::PartSize> sizes;
    for (std::size_t group = 0; group < groups.groups.size(); ++group) {
        std::uint64_t indices = 0; // count of indices in the part
        for (std::size_t i = first_piece[group]; i < first_piece[group + 1]; ++i) {
            Piece& piece = pieces[i];
            vertices += std::exchange(piece.vertices, vertices);
            indices += std::exchange(piece.indices, indices);
        }
        const auto palette = static_cast<ItemColour>(groups.groups[group].key);
        sizes.push_back(
            {.material = wood_material(palette), .index_count = indices, .word = "wood"});
    }
    MeshBlock block;
    std::vector<std::span<std::uint32_t>> indices;
    if (!builder.reserve_parts(sizes, vertices, block, indices)) {
        return;
    }
    workers.for_each(pieces.size(), [&](std::uint64_t i) {
        ConeWriter writer(block, indices[pieces[i].part], skeleton.looks.get(), pieces[i].vertices,
                          pieces[i].indices);
        for (std::uint64_t item = pieces[i].first; item < pieces[i].end; ++item) {
            const std::uint32_t number = groups.items[item];
            const Segment& segment = skeleton.segments[number];
            writer.write(segment, number, cone_of(segment, options));
        }
    });
}

} // namespace lsys
