// SPDX-License-Identifier: MIT
#include "runtime/meshing/impl/box_writer.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

namespace lsys {

namespace {

// Signs of right and up at the corners of a square.
constexpr std::array<glm::vec2, 4> kCorners{{{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};
// u goes from 0 to 1 and back to 0 around a branch, so there is no seam.
constexpr std::array<float, 4> kAround{0.0F, 0.5F, 1.0F, 0.5F};

// An opening whose distance from the axis of its branch is below this, in half sides of the socket,
// looks centred.
constexpr float kMinVisibleOffset = 0.01F;

/// `v`, turned by the smallest rotation that takes the unit vector `from` to the unit vector `to`.
glm::vec3 transported(const glm::vec3& v, const glm::vec3& from, const glm::vec3& to) {
    const glm::vec3 axis = glm::cross(from, to);
    const float cosine = glm::dot(from, to);
    if (cosine < -0.9999F) {
        return v;
    }
    return cosine * v + glm::cross(axis, v) + axis * (glm::dot(axis, v) / (1.0F + cosine));
}

/// Sets the axes of a socket: the unit vector `normal`; a unit vector perpendicular to it, as near
/// to `right` as possible; and their cross product.
void set_axes(BoxSocket& socket, const glm::vec3& right, const glm::vec3& normal) {
    socket.normal = normal;
    socket.right = glm::normalize(right - glm::dot(right, normal) * normal);
    socket.up = glm::cross(normal, socket.right);
}

} // namespace

BoxSocket axes_across(const BoxSocket& socket, const glm::vec3& direction) {
    BoxSocket axes;
    set_axes(axes, transported(socket.right, socket.normal, direction), direction);
    return axes;
}

std::uint32_t BoxWriter::add_vertex(const glm::vec3& position, float u, float v, float radius) {
    mesh_.positions.push_back(position);
    mesh_.texture_coordinates.emplace_back(u, v);
    mesh_.radii.push_back(radius);
    return static_cast<std::uint32_t>(mesh_.positions.size() - 1);
}

void BoxWriter::add_face(std::span<const std::uint32_t> corners) {
    mesh_.corners.insert(mesh_.corners.end(), corners.begin(), corners.end());
    mesh_.face_ends.push_back(static_cast<std::uint32_t>(mesh_.corners.size()));
    mesh_.colours.push_back(segment_->colour);
    mesh_.segments.push_back(number_);
}

void BoxWriter::begin_segment(const Segment& segment, std::uint32_t number, float half) {
    segment_ = &segment;
    number_ = number;
    distance_ = 0.0F;
    // The picture is square and covers half of the circumference.
    v_per_length_ = 1.0F / (4.0F * half);
}

void BoxWriter::place_ring(float distance,
                           const glm::vec3& direction,
                           float half,
                           BoxSocket& ring) {
    const glm::vec3 centre = segment_->base + distance * heading(segment_->frame);
    ring.between = BoxSocket{}.between;
    ring.reach = 0.0F;
    ring.continues = false;
    ring.v = end_.v - (distance - distance_) * v_per_length_;
    for (std::size_t i = 0; i < 4; ++i) {
        ring.corners[i] =
            add_vertex(centre + half * (kCorners[i].x * ring.right + kCorners[i].y * ring.up),
                       kAround[i], ring.v, half);
    }
    ring.normal = direction;
}

void BoxWriter::begin_root(float distance, float half, float rim) {
    end_ = {};
    distance_ = distance;
    const glm::vec3 along = heading(segment_->frame);
    set_axes(end_, segment_->frame * glm::vec3(1.0F, 0.0F, 0.0F), along);
    place_ring(distance, along, rim * half, end_);
    add_face(std::array{end_.corners[3], end_.corners[2], end_.corners[1], end_.corners[0]});
    if (rim < 1.0F) {
        fade_radii();
        add_ring(distance, along, half);
        fade_radii();
    }
}

void BoxWriter::begin_at(const BoxSocket& socket) {
    end_ = socket;
    distance_ = socket.reach;
}

void BoxWriter::add_ring(float distance, const glm::vec3& direction, float half) {
    BoxSocket ring;
    const glm::vec3 across = glm::normalize(direction);
    set_axes(ring, transported(end_.right, end_.normal, across), across);
    place_ring(distance, across, half, ring);
    join(end_, ring);
    end_ = ring;
    distance_ = distance;
}

/// Makes grooves fade towards a flat end.
void BoxWriter::fade_radii() {
    for (const std::uint32_t corner : end_.corners) {
        mesh_.radii[corner] = 0.0F;
    }
}

BoxOpening BoxWriter::add_opening(const glm::vec3& along, float half) {
    // Places in the socket, a rectangle, are fractions of its half sides.
    const auto corner = [&](std::size_t i) { return mesh_.positions[end_.corners[i]]; };
    const glm::vec3 middle = 0.25F * (corner(0) + corner(1) + corner(2) + corner(3));
    const glm::vec3 right = 0.25F * (corner(0) - corner(1) - corner(2) + corner(3));
    const glm::vec3 up = 0.25F * (corner(0) + corner(1) - corner(2) - corner(3));
    const glm::vec3 normal = glm::normalize(glm::cross(right, up));
    BoxSocket ring = axes_across(end_, along);
    std::array<glm::vec2, 4> places;
    glm::vec2 low(1e30F);
    glm::vec2 high(-1e30F);
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::vec3 at =
            segment_->base + half * (kCorners[i].x * ring.right + kCorners[i].y * ring.up);
        const glm::vec3 cut =
            at + along * (glm::dot(middle - at, normal) / glm::dot(along, normal)) - middle;
        places[i] = {glm::dot(cut, right) / glm::dot(right, right),
                     glm::dot(cut, up) / glm::dot(up, up)};
        low = glm::min(low, places[i]);
        high = glm::max(high, places[i]);
    }
    BoxOpening opening;
    for (int axis = 0; axis < 2; ++axis) {
        const float extent = 0.5F * (high[axis] - low[axis]);
        const float size = extent > kMaxOpening ? kMaxOpening / extent : 1.0F;
        const float room = std::max(kMaxOpening - size * extent, 0.0F);
        const float from = 0.5F * (low[axis] + high[axis]);
        const float to = std::clamp(from, -room, room);
        opening.moved = opening.moved || std::abs(to - from) > kMinVisibleOffset;
        for (glm::vec2& place : places) {
            place[axis] = to + size * (place[axis] - from);
        }
        opening.size = std::min(opening.size, size);
    }
    ring.v = end_.v;
    ring.reach = 0.0F;
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::vec3 at = middle + places[i].x * right + places[i].y * up;
        opening.reach = std::max(opening.reach, glm::dot(at - segment_->base, along));
        ring.corners[i] = add_vertex(at, kAround[i], ring.v, half);
    }
    join(end_, ring);
    end_ = ring;
    return opening;
}

/// Adds the faces between two rings. A fan from its first corner covers each face.
void BoxWriter::join(const BoxSocket& from, const BoxSocket& to) {
    for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t j = (i + 1) % 4;
        if (from.between[i] == BoxSocket::kNone) {
            add_face(std::array{to.corners[i], from.corners[i], from.corners[j], to.corners[j]});
        } else {
            add_face(std::array{to.corners[i], from.corners[i], from.between[i], from.corners[j],
                                to.corners[j]});
        }
    }
}

BoxJoint BoxWriter::add_joint(float distance, const glm::vec3& direction, float half) {
    BoxJoint joint;
    BoxSocket& top = joint.sides[4];
    set_axes(top, transported(end_.right, end_.normal, direction), direction);
    place_ring(distance, direction, half, top);
    for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t j = (i + 1) % 4;
        BoxSocket& side = joint.sides[i];
        side.corners = {end_.corners[i], end_.corners[j], top.corners[j], top.corners[i]};
        const glm::vec2 out = 0.5F * (kCorners[i] + kCorners[j]);
        side.normal = out.x * top.right + out.y * top.up;
        side.up = -direction;
        side.right = glm::cross(side.up, side.normal);
        side.v = 0.5F * (end_.v + top.v);
    }
    return joint;
}

void BoxWriter::close(float rim) {
    if (rim < 1.0F) {
        fade_radii();
        BoxSocket inner = end_;
        inner.between = BoxSocket{}.between;
        std::array<glm::vec3, 4> corners;
        glm::vec3 middle(0.0F);
        for (std::size_t i = 0; i < 4; ++i) {
            corners[i] = mesh_.positions[end_.corners[i]];
            middle += 0.25F * corners[i];
        }
        for (std::size_t i = 0; i < 4; ++i) {
            inner.corners[i] =
                add_vertex(middle + rim * (corners[i] - middle), kAround[i], end_.v, 0.0F);
        }
        join(end_, inner);
        end_ = inner;
    }
    add_face(end_.corners);
}

/// Adds `tile` to tiles_, halved until each part contains one of the places.
void BoxWriter::cut_tiles(const Tile& tile, std::span<const glm::vec2> places) {
    if (tile.count <= 1) {
        tiles_.push_back(tile);
        return;
    }
    const auto begin = tile_order_.begin() + static_cast<std::ptrdiff_t>(tile.first);
    const auto end = begin + static_cast<std::ptrdiff_t>(tile.count);
    glm::vec2 low = places[*begin];
    glm::vec2 high = low;
    for (auto at = begin; at != end; ++at) {
        low = glm::min(low, places[*at]);
        high = glm::max(high, places[*at]);
    }
    const int axis = high.x - low.x >= high.y - low.y ? 0 : 1;
    std::sort(begin, end, [&](std::size_t a, std::size_t b) {
        return places[a][axis] != places[b][axis] ? places[a][axis] < places[b][axis] : a < b;
    });
    const float middle = 0.5F * (tile.low[axis] + tile.high[axis]);
    Tile lower = tile;
    lower.count = tile.count / 2;
    lower.high[axis] = middle;
    Tile upper = tile;
    upper.first += lower.count;
    upper.count -= lower.count;
    upper.low[axis] = middle;
    // The recursion has at most two levels, since at most kMaxOnSide segments grow here.
    cut_tiles(lower, places);
    cut_tiles(upper, places);
}

/// The vertex at a place within a side, -1 to 1 in both directions.
std::uint32_t BoxWriter::tile_corner(const BoxSocket& side, const glm::vec2& place) {
    const auto found = std::find(tile_corners_.begin(), tile_corners_.end(), place);
    if (found != tile_corners_.end()) {
        return tile_vertices_[static_cast<std::size_t>(found - tile_corners_.begin())];
    }
    const glm::vec2 at = 0.5F + 0.5F * kInnerPart * place;
    const std::array<float, 4> weights{at.x * at.y, (1.0F - at.x) * at.y,
                                       (1.0F - at.x) * (1.0F - at.y), at.x * (1.0F - at.y)};
    glm::vec3 position(0.0F);
    glm::vec2 texture_coordinate(0.0F);
    float radius = 0.0F;
    for (std::size_t i = 0; i < 4; ++i) {
        position += weights[i] * mesh_.positions[side.corners[i]];
        texture_coordinate += weights[i] * mesh_.texture_coordinates[side.corners[i]];
        radius += weights[i] * mesh_.radii[side.corners[i]];
    }
    tile_corners_.push_back(place);
    tile_vertices_.push_back(
        add_vertex(position, texture_coordinate.x, texture_coordinate.y, radius));
    return tile_vertices_.back();
}

/// The face between an edge of a side and the tiles along it.
void BoxWriter::add_border(const BoxSocket& side, std::size_t edge) {
    const glm::vec2 from = kCorners[edge];
    const glm::vec2 to = kCorners[(edge + 1) % 4];
    std::vector<std::pair<float, std::uint32_t>> inner;
    for (std::size_t i = 0; i < tile_corners_.size(); ++i) {
        const glm::vec2& at = tile_corners_[i];
        if ((from.x == to.x && at.x == from.x) || (from.y == to.y && at.y == from.y)) {
            inner.emplace_back(-glm::dot(at, to - from), tile_vertices_[i]);
        }
    }
    std::sort(inner.begin(), inner.end());
    std::vector<std::uint32_t> corners{side.corners[edge], side.corners[(edge + 1) % 4]};
    for (const auto& [order, vertex] : inner) {
        corners.push_back(vertex);
    }
    add_face(corners);
}

std::span<const BoxSocket> BoxWriter::divide(const BoxSocket& side,
                                             std::span<const glm::vec2> places) {
    sockets_.assign(places.size(), side);
    if (places.empty()) {
        add_face(side.corners);
    }
    if (places.size() <= 1) {
        return sockets_;
    }
    tile_order_.resize(places.size());
    std::iota(tile_order_.begin(), tile_order_.end(), std::size_t{0});
    tiles_.clear();
    tile_corners_.clear();
    tile_vertices_.clear();
    cut_tiles({.low = glm::vec2(-1.0F), .high = glm::vec2(1.0F), .count = places.size()}, places);
    const auto corner_place = [](const Tile& tile, std::size_t i) {
        return glm::vec2(kCorners[i].x > 0.0F ? tile.high.x : tile.low.x,
                         kCorners[i].y > 0.0F ? tile.high.y : tile.low.y);
    };
    for (const Tile& tile : tiles_) {
        for (std::size_t i = 0; i < 4; ++i) {
            sockets_[tile_order_[tile.first]].corners[i] = tile_corner(side, corner_place(tile, i));
        }
    }
    for (const Tile& tile : tiles_) {
        BoxSocket& socket = sockets_[tile_order_[tile.first]];
        for (std::size_t i = 0; i < 4; ++i) {
            // Tiles are halves of tiles, so a corner of a neighbouring tile on this edge lies at
            // the middle of the edge.
            const glm::vec2 middle =
                0.5F * (corner_place(tile, i) + corner_place(tile, (i + 1) % 4));
            const auto found = std::find(tile_corners_.begin(), tile_corners_.end(), middle);
            if (found != tile_corners_.end()) {
                socket.between[i] =
                    tile_vertices_[static_cast<std::size_t>(found - tile_corners_.begin())];
            }
        }
    }
    for (std::size_t edge = 0; edge < 4; ++edge) {
        add_border(side, edge);
    }
    return sockets_;
}

PolygonMesh BoxWriter::take() {
    return std::move(mesh_);
}

} // namespace lsys
