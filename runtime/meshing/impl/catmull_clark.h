// SPDX-License-Identifier: MIT
// Catmull-Clark subdivision of closed meshes (Catmull & Clark 1978, "Recursively generated B-spline
// surfaces on arbitrary topological meshes"), on half-edges. The number of a half-edge determines
// the numbers of its children (Dupuy & Vanhoey 2021, "A Halfedge Refinement Rule for Parallel
// Catmull-Clark Subdivision"). Each element depends on its neighbours only, so the result does not
// depend on the number of threads.
#pragma once

#include "runtime/base/large_vector.h"
#include "runtime/base/workers.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <utility>
#include <vector>

namespace lsys {

/// Faces with any number of corners, counter-clockwise seen from outside. Each vertex has one
/// texture coordinate, which is smoothed like its position.
struct PolygonMesh {
    LargeVector<glm::vec3> positions;
    LargeVector<glm::vec2> texture_coordinates;
    LargeVector<float> radii; // of the stem, by vertex; smoothed like positions; may be empty
    LargeVector<std::uint32_t> corners;   // vertices of all faces, one face after the other
    LargeVector<std::uint32_t> face_ends; // end of each face in `corners`
    LargeVector<std::uint32_t> colours;   // colour of each face
    LargeVector<std::uint32_t> segments;  // segment of each face; may be empty
};

struct MeshCounts {
    std::uint64_t vertices = 0;
    std::uint64_t edges = 0;
    std::uint64_t faces = 0;
    std::uint64_t corners = 0;
};
/// Sizes of a closed mesh after `steps` steps; counting stops above 2^40 corners.
[[nodiscard]] MeshCounts refined_counts(const PolygonMesh& mesh, std::uint32_t steps);

/// A closed mesh and its steps of subdivision.
class CatmullClark {
public:
    /// Precondition: fewer than 2^31 corners.
    CatmullClark(PolygonMesh mesh, Workers& workers);

    /// Whether every edge has two faces, in opposite directions. A precondition of all functions
    /// below.
    [[nodiscard]] bool closed() const { return closed_; }
    /// Makes one step of subdivision. Precondition: fewer than 2^29 corners.
    void refine();
    [[nodiscard]] const PolygonMesh& mesh() const { return mesh_; }
    /// Replaces the positions of all vertices.
    void move_vertices(LargeVector<glm::vec3> positions) { mesh_.positions = std::move(positions); }

    /// Calls visit(face, half) for the faces around a vertex. `half`: the half-edge of the face
    /// that begins at the vertex.
    template <typename Visit>
    void visit_faces(std::uint32_t vertex, const Visit& visit) const {
        const std::uint32_t first = vertex_half_[vertex];
        std::uint32_t half = first;
        do {
            visit(face_of(half), half);
            half = twins_[previous(half)];
        } while (half != first);
    }
    /// The half-edges after and before a half-edge of the same face.
    [[nodiscard]] std::uint32_t next(std::uint32_t half) const;
    [[nodiscard]] std::uint32_t previous(std::uint32_t half) const;

private:
    [[nodiscard]] std::uint32_t face_of(std::uint32_t half) const {
        return quads_ ? half / 4 : faces_[half];
    }
    [[nodiscard]] std::uint32_t face_begin(std::uint32_t face) const {
        return face == 0 ? 0 : mesh_.face_ends[face - 1];
    }
    void find_twins();
    void place_vertices(PolygonMesh& to);
    /// One step, for one attribute of the vertices.
    template <typename T>
    void smooth(const LargeVector<T>& from, LargeVector<T>& to);
    /// Calls piece(0) to piece(count - 1), by all threads.
    template <typename Piece>
    void for_each(std::uint64_t count, const Piece& piece);

    // A half-edge goes from a corner of a face to the next corner, and has the number of the first
    // corner.
    PolygonMesh mesh_;
    Workers& workers_;
    bool closed_ = false;
    bool quads_ = false;                     // all faces have four corners and are stored in order
    LargeVector<std::uint32_t> faces_;       // by half-edge; empty if all faces are quads
    LargeVector<std::uint32_t> twins_;       // by half-edge: the opposite half-edge of its edge
    LargeVector<std::uint32_t> edges_;       // by half-edge: its edge
    LargeVector<std::uint32_t> edge_half_;   // a half-edge of each edge
    LargeVector<std::uint32_t> vertex_half_; // a half-edge that begins at each vertex
};

} // namespace lsys
