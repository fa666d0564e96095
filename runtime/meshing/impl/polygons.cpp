// SPDX-License-Identifier: MIT
#include "runtime/meshing/impl/polygons.h"

#include "runtime/base/workers.h"
#include "runtime/meshing/impl/groups.h"
#include "runtime/meshing/impl/triangulate.h"
#include "runtime/meshing/looks.h"
#include "runtime/meshing/texture.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace lsys {

namespace {

constexpr std::uint64_t kCornersPerPiece = 1U << 14;

/// The plane of a polygon: unit axes, `across` x `along` = `normal`.
struct Plane {
    glm::dvec3 across{};
    glm::dvec3 along{};
    glm::dvec3 normal{};
};

bool normalize(glm::dvec3& v) {
    // The vector is scaled first, because squares of its coordinates may exceed the range of a
    // double.
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (!(largest > 0.0)) {
        return false;
    }
    v /= largest;
    v /= std::sqrt(glm::dot(v, v));
    return true;
}

std::span<const glm::vec3> corners_of(const Skeleton& skeleton, const Polygon& polygon) {
    return std::span(skeleton.corners).subspan(polygon.first_corner, polygon.corner_count);
}

/// Newell's normal of a polygon, or if its areas cancel each other, the normal of the largest
/// triangle of a fan. Returns false for a polygon without area.
bool find_normal(std::span<const glm::vec3> corners, glm::dvec3& normal) {
    glm::dvec3 largest{0.0};
    double max_length = 0.0;
    double extent = 0.0;
    const glm::dvec3 first(corners.front());
    normal = glm::dvec3(0.0);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        const glm::dvec3 a = glm::dvec3(corners[i]) - first;
        const glm::dvec3 b = glm::dvec3(corners[i + 1]) - first;
        const glm::dvec3 area = glm::cross(a, b);
        const double length = std::sqrt(glm::dot(area, area));
        extent = std::max({extent, glm::dot(a, a), glm::dot(b, b)});
        if (length > max_length) {
            max_length = length;
            largest = area;
        }
        normal += area;
    }
    if (!(max_length > 1e-13 * extent)) {
        return false;
    }
    if (!(std::sqrt(glm::dot(normal, normal)) > 1e-9 * max_length)) {
        normal = largest;
    }
    return normalize(normal);
}

bool find_plane(std::span<const glm::vec3> corners, const glm::quat& frame, Plane& plane) {
    if (!find_normal(corners, plane.normal)) {
        return false;
    }
    const glm::dquat turtle(frame);
    if (glm::dot(plane.normal, turtle * glm::dvec3(0.0, 0.0, 1.0)) < 0.0) {
        plane.normal = -plane.normal;
    }
    plane.along = turtle * glm::dvec3(0.0, 1.0, 0.0);
    if (std::abs(glm::dot(plane.along, plane.normal)) > 0.999) {
        plane.along = turtle * glm::dvec3(0.0, 0.0, 1.0);
    }
    plane.along -= glm::dot(plane.along, plane.normal) * plane.normal;
    if (!normalize(plane.along)) {
        return false;
    }
    plane.across = glm::cross(plane.along, plane.normal);
    return true;
}

/// Projects the corners onto the plane, as seen from the side of the normal.
void project(std::span<const glm::vec3> corners,
             const Plane& plane,
             std::vector<glm::dvec2>& flat) {
    flat.clear();
    const glm::dvec3 first(corners.front());
    for (const glm::vec3& corner : corners) {
        const glm::dvec3 at = glm::dvec3(corner) - first;
        flat.emplace_back(glm::dot(at, plane.across), glm::dot(at, plane.along));
    }
}

/// Polygons of one group that one thread handles at a time.
struct Piece {
    std::uint64_t first_item = 0; // index in Job::items
    std::uint64_t item_count = 0;
    std::vector<std::uint32_t> triangles;    // three corners per triangle, by number in the polygon
    std::vector<std::uint32_t> index_counts; // one per polygon; 0 if it has no area
    std::uint64_t vertex_count = 0;
    std::uint64_t first_vertex = 0; // in the block of the group
    std::uint64_t first_index = 0;  // place of the first of its indices in the block of the group
};

/// The polygons to write.
struct Job {
    const Skeleton& skeleton;
    const LargeVector<std::uint32_t>& items; // indexes of polygons, sorted by group
};

void triangulate(const Job& job, Piece& piece) {
    Triangulator triangulator;
    std::vector<glm::dvec2> flat;
    for (std::uint64_t i = 0; i < piece.item_count; ++i) {
        const Polygon& polygon = job.skeleton.polygons[job.items[piece.first_item + i]];
        const std::span<const glm::vec3> corners = corners_of(job.skeleton, polygon);
        const std::size_t before = piece.triangles.size();
        Plane plane;
        if (find_plane(corners, polygon.frame, plane)) {
            project(corners, plane, flat);
            triangulator.append(flat, piece.triangles);
        }
        const std::size_t added = piece.triangles.size() - before;
        piece.index_counts.push_back(static_cast<std::uint32_t>(added));
        piece.vertex_count += added > 0 ? corners.size() : 0;
    }
}

void write_vertices(const Skeleton& skeleton,
                    const Polygon& polygon,
                    ItemColour palette,
                    std::uint64_t first_vertex,
                    const MeshBlock& block,
                    std::vector<glm::dvec2>& flat) {
    const std::span<const glm::vec3> corners = corners_of(skeleton, polygon);
    Plane plane;
    if (!find_plane(corners, polygon.frame, plane)) {
        return;
    }
    project(corners, plane, flat);
    glm::dvec2 low = flat.front();
    glm::dvec2 high = low;
    for (const glm::dvec2& at : flat) {
        low = glm::min(low, at);
        high = glm::max(high, at);
    }
    const glm::dvec2 size = glm::max(high - low, glm::dvec2(1e-300));
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec2 place = (flat[i] - low) / size;
        block.set(first_vertex + i, {.position = corners[i],
                                     .normal = glm::vec3(plane.normal),
                                     .texture_coordinate = {place.x, 1.0 - place.y},
                                     .tangent = glm::vec4(glm::vec3(plane.across), 1.0F),
                                     .palette = palette,
                                     .segment = polygon.parent});
    }
}

void write(const Job& job, const Piece& piece, ItemColour palette, const MeshBlock& block) {
    std::uint64_t vertex = piece.first_vertex;
    std::uint64_t index = piece.first_index;
    std::size_t read = 0;
    std::vector<glm::dvec2> flat;
    for (std::uint64_t i = 0; i < piece.item_count; ++i) {
        if (piece.index_counts[i] == 0) {
            continue;
        }
        const Polygon& polygon = job.skeleton.polygons[job.items[piece.first_item + i]];
        write_vertices(job.skeleton, polygon, palette, vertex, block, flat);
        const auto base = static_cast<std::uint32_t>(block.first_vertex + vertex);
        for (std::uint32_t j = 0; j < piece.index_counts[i]; ++j) {
            block.indices[index++] = base + piece.triangles[read++];
        }
        vertex += polygon.corner_count;
    }
}

constexpr unsigned kPictureShift = 32;

/// Number of the picture, from 1, and colour, packed into one number that orders the parts.
std::uint64_t
key_of(const Polygon& polygon, const std::vector<UserMesh>& user_meshes, const Looks* looks) {
    if (polygon.picture < user_meshes.size() && user_meshes[polygon.picture].picture != nullptr) {
        // Without a `#material` the picture decides the colour.
        const bool has_look = looks != nullptr && looks->find(polygon.colour) != nullptr;
        return std::uint64_t{polygon.picture + 1U} << kPictureShift |
               (has_look ? std::max(polygon.colour, 1U) : 1U); // leaf green
    }
    return std::max<std::uint64_t>(polygon.colour, 1); // 0 means leaf green
}

std::vector<Piece> cut_into_pieces(const Job& job, const Group& group) {
    std::vector<Piece> pieces;
    std::uint64_t corners = kCornersPerPiece;
    for (std::uint64_t i = group.first; i < group.first + group.count; ++i) {
        if (corners >= kCornersPerPiece) {
            pieces.emplace_back().first_item = i;
            corners = 0;
        }
        ++pieces.back().item_count;
        corners += job.skeleton.polygons[job.items[i]].corner_count;
    }
    return pieces;
}

} // namespace

void append_polygons(const Skeleton& skeleton,
                     const std::vector<UserMesh>& user_meshes,
                     const MeshOptions& options,
                     MeshBuilder& builder) {
    const Groups groups = group_items(skeleton.polygons.size(), [&](std::uint64_t i) {
        return key_of(skeleton.polygons[i], user_meshes, skeleton.looks.get());
    });
    const Job job{.skeleton = skeleton, .items = groups.items};
    Workers workers(options.threads);
    for (const Group& group : groups.groups) {
        std::vector<Piece> pieces = cut_into_pieces(job, group);
        workers.for_each(pieces.size(), [&](std::uint64_t i) { triangulate(job, pieces[i]); });
        std::uint64_t vertices = 0;
        std::uint64_t indices = 0;
        for (Piece& piece : pieces) {
            piece.first_vertex = vertices;
            piece.first_index = indices;
            vertices += piece.vertex_count;
            indices += piece.triangles.size();
        }
        const auto palette = static_cast<ItemColour>(group.key & 0xFFFFFFFFU);
        const auto picture = static_cast<std::uint16_t>(group.key >> kPictureShift);
        const MaterialKey material{.kind = palette == 1 ? MaterialKind::Leaf : MaterialKind::Plain,
                                   .palette = palette,
                                   .two_sided = true,
                                   .cut_out = picture != 0 &&
                                              has_holes(*user_meshes[picture - 1U].picture),
                                   .textured = picture != 0,
                                   .picture = picture};
        MeshBlock block;
        if (!builder.reserve(builder.part(material, "polygon"), vertices, indices, block)) {
            return;
        }
        workers.for_each(pieces.size(),
                         [&](std::uint64_t i) { write(job, pieces[i], palette, block); });
    }
}

} // namespace lsys
