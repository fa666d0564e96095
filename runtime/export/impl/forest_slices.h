// SPDX-License-Identifier: MIT
// Slices: vertices of a surface in an order in which every part of every instance is a run of
// consecutive vertices, so that each primitive of a file has accessors, bounds and small indices of
// its own. Made from the lists of triangles of InstanceMeshes; read by the writer of glTF.
#pragma once

#include "runtime/base/large_vector.h"
#include "runtime/export/impl/forest_plan.h"
#include "runtime/export/impl/formats.h"
#include "runtime/meshing/mesh.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace lsys {

/// Slices with fewer vertices than this have indices of 16 bits. glTF reserves the index 65,535.
inline constexpr std::uint64_t kMinWideVertices = 65536;

/// The parts of a mesh that an instance draws.
struct PartList {
    std::size_t first_part = 0;
    std::size_t part_count = 0;
    /// Number of the first list nested in this one; its own number if there is none.
    std::size_t first_nested = 0;
};

/// The lists of the used instances of a stage, each after the lists nested in it. The triangles of
/// a nested list are among the triangles of the enclosing list; lists that are not nested share no
/// triangles.
[[nodiscard]] std::vector<PartList> nested_lists(const ExportedStage& stage,
                                                 const ForestPlan& plan);

/// The vertices and indices of one part.
struct Slice {
    std::uint64_t first_vertex = 0; // in the block of its material
    std::uint64_t vertex_count = 0; // 0: the part is in no list
    std::uint64_t first_index = 0;  // among the narrow or wide indices of the block
    Bounds bounds;                  // of the positions

    [[nodiscard]] bool is_wide() const { return vertex_count >= kMinWideVertices; }
};

/// The vertices of one material.
struct SliceBlock {
    std::uint64_t first_vertex = 0; // index in SlicedMesh::vertices
    std::uint64_t vertex_count = 0;
    std::uint64_t narrow_indices = 0; // count of indices of 16 bits
    std::uint64_t wide_indices = 0;   // count of indices of 32 bits
};

struct SlicedMesh {
    LargeVector<std::uint32_t> vertices; // of the mesh, by block
    LargeVector<std::uint32_t> indices;  // parallel to the indices of the mesh, numbered per slice
    std::vector<Slice> slices;           // by part of the mesh
    std::vector<SliceBlock> blocks;      // by material of the mesh
    std::vector<std::size_t> order;      // the parts of all lists, list by list
};

/// Orders the vertices of `mesh` list by list. A vertex is repeated only if lists that are not
/// nested share it. Vertices of no list are left out. Time is linear in the number of indices.
[[nodiscard]] SlicedMesh slice_mesh(const Mesh& mesh, std::span<const PartList> lists);

} // namespace lsys
