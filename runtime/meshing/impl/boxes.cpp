// SPDX-License-Identifier: MIT
#include "runtime/meshing/impl/boxes.h"

#include "grammar/base/contract.h"
#include "runtime/base/workers.h"
#include "runtime/meshing/impl/box_joints.h"
#include "runtime/meshing/impl/catmull_clark.h"
#include "runtime/meshing/impl/grooves.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace lsys {

namespace {

// Half side of a box / radius of its segment. A smoothed square tube has a radius of 0.65 of its
// half diagonal; the cross-section of an unsmoothed box has the area of the circle.
constexpr float kSmoothedWidth = 1.075F;
constexpr float kBoxWidth = 0.886F;
constexpr std::uint64_t kMaxCorners = std::uint64_t{1} << 31;
constexpr std::uint64_t kMaxSegments = 100'000'000;
constexpr std::uint64_t kVerticesPerPiece = 1U << 14;

/// Triangles of the faces, by part.
struct Parts {
    std::vector<MeshBuilder::PartSize> sizes;    // by ascending material
    std::vector<std::span<std::uint32_t>> room;  // for the indices of each part
    std::map<ItemColour, std::size_t> of_colour; // index in `sizes` and `room`
};

/// The parts after `steps` subdivision steps; each step makes a quad for each corner of a face.
Parts find_parts(const PolygonMesh& mesh, std::uint32_t steps) {
    std::map<MaterialKey, std::uint64_t> sizes;
    std::uint32_t begin = 0;
    for (std::size_t face = 0; face < mesh.face_ends.size(); ++face) {
        const std::uint64_t corners = mesh.face_ends[face] - begin;
        sizes[wood_material(mesh.colours[face])] +=
            steps > 0 ? 6 * corners << (2 * (steps - 1)) : 3 * (corners - 2);
        begin = mesh.face_ends[face];
    }
    Parts parts;
    for (const auto& [material, count] : sizes) {
        parts.of_colour[material.palette] = parts.sizes.size();
        parts.sizes.push_back({.material = material, .index_count = count, .word = "wood"});
    }
    return parts;
}

/// A normal of the face with the corners [begin, end), as long as twice the area of the face.
glm::vec3 face_area(const PolygonMesh& mesh, std::uint32_t begin, std::uint32_t end) {
    const glm::vec3& first = mesh.positions[mesh.corners[begin]];
    if (end - begin == 4) {
        return glm::cross(mesh.positions[mesh.corners[begin + 2]] - first,
                          mesh.positions[mesh.corners[begin + 3]] -
                              mesh.positions[mesh.corners[begin + 1]]);
    }
    glm::vec3 area(0.0F);
    for (std::uint32_t i = begin + 1; i + 1 < end; ++i) {
        area += glm::cross(mesh.positions[mesh.corners[i]] - first,
                           mesh.positions[mesh.corners[i + 1]] - first);
    }
    return area;
}

glm::vec3 unit_or(const glm::vec3& v, const glm::vec3& otherwise) {
    const float largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    return largest > 0.0F ? glm::normalize(v / largest) : otherwise;
}

/// Writes a vertex of the surface as vertex `to` of the block. Normal, tangent (along rising u) and
/// colour come from the faces around the vertex, or from the face `only`.
void write_vertex(const CatmullClark& surface,
                  std::uint32_t vertex,
                  std::optional<std::uint32_t> only,
                  std::uint64_t to,
                  const MeshBlock& block) {
    const PolygonMesh& mesh = surface.mesh();
    glm::vec3 area(0.0F);
    glm::vec3 tangent(0.0F);
    glm::vec3 edge(0.0F);
    std::uint32_t lowest = 0xFFFFFFFFu;
    VertexSegments segments{0xFFFFFFFFu, 0};
    float tangents = 0.0F; // sum of the sizes of the tangents of faces
    float mirrored = 0.0F;
    surface.visit_faces(vertex, [&](std::uint32_t face, std::uint32_t half) {
        if (!block.segments.empty()) {
            segments[0] = std::min(segments[0], mesh.segments[face]);
            segments[1] = std::max(segments[1], mesh.segments[face]);
        }
        if (only && *only != face) {
            return;
        }
        const std::uint32_t begin = face == 0 ? 0 : mesh.face_ends[face - 1];
        area += face_area(mesh, begin, mesh.face_ends[face]);
        lowest = std::min(lowest, face);
        if (block.tangents.empty()) {
            return;
        }
        const std::uint32_t b = mesh.corners[surface.next(half)];
        const std::uint32_t c = mesh.corners[surface.previous(half)];
        const glm::vec3 p = mesh.positions[b] - mesh.positions[vertex];
        const glm::vec3 q = mesh.positions[c] - mesh.positions[vertex];
        const glm::vec2 s = mesh.texture_coordinates[b] - mesh.texture_coordinates[vertex];
        const glm::vec2 t = mesh.texture_coordinates[c] - mesh.texture_coordinates[vertex];
        const float turn = s.x * t.y - s.y * t.x;
        const glm::vec3 along_u = (turn < 0.0F ? -1.0F : 1.0F) * (p * t.y - q * s.y);
        mirrored += turn;
        tangent += along_u;
        tangents += std::abs(along_u.x) + std::abs(along_u.y) + std::abs(along_u.z);
        edge = p;
    });
    const glm::vec3 normal = unit_or(area, glm::vec3(0.0F, 1.0F, 0.0F));
    const glm::vec3 across = edge - glm::dot(edge, normal) * normal;
    tangent -= glm::dot(tangent, normal) * normal;
    // There is no tangent where u changes direction.
    tangent *= glm::length(tangent) > 1e-3F * tangents ? 1.0F : 0.0F;
    const glm::vec3 any = std::abs(normal.x) < 0.6F ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, 1);
    const glm::vec3 fallback =
        unit_or(across, glm::normalize(any - glm::dot(any, normal) * normal));
    block.set(to, {.position = mesh.positions[vertex],
                   .normal = normal,
                   .texture_coordinate = mesh.texture_coordinates[vertex],
                   // v grows downwards, so `mirrored` is negative where a picture is not mirrored.
                   .tangent = glm::vec4(unit_or(tangent, fallback), mirrored > 0.0F ? -1.0F : 1.0F),
                   .palette = mesh.colours[lowest]});
    if (!block.segments.empty()) {
        block.segments[to] = segments;
    }
}

/// Whether the diagonal from corner `first` cuts the quad into triangles of which one faces away
/// from the quad.
bool folds(const PolygonMesh& mesh, std::uint32_t begin, std::uint32_t first) {
    const auto at = [&](std::uint32_t i) { return mesh.positions[mesh.corners[begin + i % 4]]; };
    const glm::vec3 area = face_area(mesh, begin, begin + 4);
    const glm::vec3 across = at(first + 2) - at(first);
    return glm::dot(glm::cross(at(first + 1) - at(first), across), area) < 0.0F ||
           glm::dot(glm::cross(across, at(first + 3) - at(first)), area) < 0.0F;
}

/// Writes the triangles of a face to the begin of `room`: a quad is cut along its shorter diagonal,
/// any other face becomes a fan from its first corner. `flat`: vertices are numbered like corners.
void write_face(const PolygonMesh& mesh,
                std::uint32_t begin,
                std::uint32_t end,
                bool flat,
                std::uint32_t first_vertex,
                std::span<std::uint32_t>& room) {
    const auto corner = [&](std::uint32_t i) { return mesh.corners[begin + i % (end - begin)]; };
    const auto apart = [&](std::uint32_t i, std::uint32_t j) {
        const glm::vec3 way = mesh.positions[corner(j)] - mesh.positions[corner(i)];
        return glm::dot(way, way);
    };
    std::uint32_t first = end - begin == 4 && apart(1, 3) < apart(0, 2) ? 1 : 0;
    if (end - begin == 4 && folds(mesh, begin, first) && !folds(mesh, begin, 1 - first)) {
        first = 1 - first;
    }
    for (std::uint32_t i = 1; i + 1 < end - begin; ++i) {
        for (const std::uint32_t at : {first, first + i, first + i + 1}) {
            room.front() = first_vertex + (flat ? begin + at % (end - begin) : corner(at));
            room = room.subspan(1);
        }
    }
}

void write(const CatmullClark& surface,
           Parts& parts,
           Workers& workers,
           bool flat,
           const MeshBlock& block) {
    const PolygonMesh& mesh = surface.mesh();
    const std::uint64_t count = flat ? mesh.face_ends.size() : mesh.positions.size();
    workers.for_each((count + kVerticesPerPiece - 1) / kVerticesPerPiece, [&](std::uint64_t i) {
        const std::uint64_t end = std::min(count, (i + 1) * kVerticesPerPiece);
        for (auto at = static_cast<std::uint32_t>(i * kVerticesPerPiece); at < end; ++at) {
            if (!flat) {
                write_vertex(surface, at, std::nullopt, at, block);
                continue;
            }
            for (std::uint32_t corner = at == 0 ? 0 : mesh.face_ends[at - 1];
                 corner < mesh.face_ends[at]; ++corner) {
                write_vertex(surface, mesh.corners[corner], at, corner, block);
            }
        }
    });
    std::uint32_t begin = 0;
    for (std::size_t face = 0; face < mesh.face_ends.size(); ++face) {
        const std::size_t part =
            parts.of_colour.size() == 1 ? 0 : parts.of_colour.find(mesh.colours[face])->second;
        write_face(mesh, begin, mesh.face_ends[face], flat, block.first_vertex, parts.room[part]);
        begin = mesh.face_ends[face];
    }
}

/// Carves grooves along the stems: moves vertices inwards by up to `depth` times the radius. Around
/// a stem u rises over one half and falls over the other, so the grooves of both halves mirror each
/// other; grooves are shifted less where u changes direction. `steps`: smoothing steps made so far.
/// `wanted`: total number of smoothing steps, which decides the number of grooves.
void carve_grooves(CatmullClark& surface,
                   float depth,
                   std::uint32_t steps,
                   std::uint32_t wanted,
                   Workers& workers) {
    constexpr std::uint32_t kMaxSteps = 4; // more steps add no grooves
    if (wanted < 2) {
        return;
    }
    const std::uint32_t grooves = 1U << (std::min(wanted, kMaxSteps) - 1); // per half of the stem
    const bool has_grooves = 1U << steps >= grooves; // at least two vertices per groove
    constexpr float kCircumference = 1.0F;
    const Grooves shape(grooves, kCircumference, 0);
    const PolygonMesh& mesh = surface.mesh();
    LargeVector<glm::vec3> positions;
    positions.resize(mesh.positions.size());
    const std::uint64_t count = positions.size();
    workers.for_each((count + kVerticesPerPiece - 1) / kVerticesPerPiece, [&](std::uint64_t piece) {
        const std::uint64_t end = std::min(count, (piece + 1) * kVerticesPerPiece);
        for (auto i = static_cast<std::uint32_t>(piece * kVerticesPerPiece); i < end; ++i) {
            glm::vec3 area(0.0F);
            surface.visit_faces(i, [&](std::uint32_t face, std::uint32_t /*half*/) {
                area +=
                    face_area(mesh, face == 0 ? 0 : mesh.face_ends[face - 1], mesh.face_ends[face]);
            });
            const glm::vec2& at = mesh.texture_coordinates[i];
            const float turn =
                static_cast<float>(grooves) * at.x +
                4.0F * at.x * (1.0F - at.x) * shape.ridge_shift(-static_cast<double>(at.y));
            const float value = has_grooves ? groove_depth(turn) : -0.5F;
            positions[i] = mesh.positions[i] +
                           (depth * value * mesh.radii[i]) * unit_or(area, glm::vec3(0.0F));
        }
    });
    surface.move_vertices(std::move(positions));
}

} // namespace

void append_boxes(const Skeleton& skeleton, const MeshOptions& options, MeshBuilder& builder) {
    const std::uint32_t wanted = options.subdivisions.value_or(kSubdivisions);
    const std::uint32_t steps = wanted > options.level ? wanted - options.level : 0;
    // Boxes that are not smoothed have flat faces: each face has vertices of its own.
    const bool flat = wanted == 0;
    PolygonMesh boxes;
    if (skeleton.segments.size() <= kMaxSegments) {
        const float unsmoothed = skeleton.box_segments ? 1.0F : kBoxWidth;
        boxes = make_boxes(
            skeleton, {.width = steps > 0 ? kSmoothedWidth : unsmoothed, .smoothed = steps > 0});
    }
    if (options.grooves <= 0.0F) {
        boxes.radii = {};
    }
    const MeshCounts counts = refined_counts(boxes, steps);
    const std::uint64_t vertices = flat ? counts.corners : counts.vertices;
    MeshBlock block;
    if (skeleton.segments.size() > kMaxSegments || counts.corners >= kMaxCorners) {
        // Fails on purpose: this number of vertices exceeds every limit.
        (void)builder.place_parts({}, ~std::uint64_t{0}, block);
        return;
    }
    if (counts.corners == 0) {
        return;
    }
    Parts parts = find_parts(boxes, steps);
    if (!builder.reserve_parts(parts.sizes, vertices, block, parts.room)) {
        return;
    }
    Workers workers(options.threads);
    CatmullClark surface(std::move(boxes), workers);
    LSYS_CHECK(surface.closed());
    for (std::uint32_t i = 0; i < steps; ++i) {
        surface.refine();
    }
    if (options.grooves > 0.0F) {
        carve_grooves(surface, std::min(options.grooves, 0.9F), steps, wanted, workers);
    }
    write(surface, parts, workers, flat, block);
}

} // namespace lsys
