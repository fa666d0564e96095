// SPDX-License-Identifier: MIT
// Mesh: triangles made from a skeleton. Arrays of vertices are parallel. Triangles are
// counter-clockwise seen from outside. Metres, right-handed, +Y up; v of texture coordinates goes
// down, as in glTF.
#pragma once

#include "grammar/base/outcome.h"
#include "runtime/meshing/triangle_list.h"
#include "runtime/turtle/skeleton.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lsys {

struct Texture; // runtime/meshing/texture.h

enum class MaterialKind : std::uint8_t { Bark, Leaf, Flower, Plain };
inline constexpr float kBarkRoughness = 0.95F; // roughness of MaterialKind::Bark
inline constexpr float kRoughness = 0.7F;      // roughness of the other kinds

/// Appearance of a part of a mesh. Colours are linear RGBA, 0 to 1.
struct Material {
    std::string name;
    MaterialKind kind = MaterialKind::Plain;
    glm::vec4 colour{1.0F};
    bool two_sided = false;
    bool cut_out = false;  // texels below half opacity are discarded
    bool textured = false; // by `picture` or, if that is null, material_texture(kind)
    std::shared_ptr<const Texture> picture = nullptr; // picture of a file; multiplied by the colour
    std::shared_ptr<const Texture> normal_map = nullptr; // normals of a file, as bark_normals()
    std::optional<float> roughness = std::nullopt;       // unset: the roughness of the kind
    std::optional<float> translucency = std::nullopt; // 0 to 1; unset: the viewer chooses by kind
};

/// The roughness of a material, or of its kind if unset.
[[nodiscard]] inline float roughness_of(const Material& material) {
    return material.roughness.value_or(material.kind == MaterialKind::Bark ? kBarkRoughness
                                                                           : kRoughness);
}

/// Triangles of one material: indices[first_index, first_index + index_count).
struct MeshPart {
    std::uint32_t material = 0; // index in Mesh::materials
    std::uint64_t first_index = 0;
    std::uint64_t index_count = 0;
};

/// The two segments that a vertex is bound to, half each; equal: one segment; kNoSegment: none.
using VertexSegments = std::array<std::uint32_t, 2>;

struct Mesh {
    LargeVector<glm::vec3> positions;
    LargeVector<glm::vec3> normals;             // unit length
    LargeVector<glm::vec2> texture_coordinates; // empty unless requested
    LargeVector<glm::vec4> tangents;            // empty unless requested; w: sign of the bitangent
    LargeVector<ItemColour> colours;            // colour of each vertex; empty unless requested
    LargeVector<VertexSegments> segments;       // of each vertex; empty unless requested
    TriangleList indices;
    std::vector<MeshPart> parts; // one for each material in use, in order of indices
    std::vector<Material> materials;
    std::shared_ptr<const Looks> looks; // Skeleton::looks: looks of the indexes in `colours`
    std::uint64_t shells = 0;           // separate closed pieces; of MeshMethod::Solid only

    [[nodiscard]] std::uint64_t byte_count() const {
        return positions.size() * sizeof(glm::vec3) + normals.size() * sizeof(glm::vec3) +
               texture_coordinates.size() * sizeof(glm::vec2) +
               tangents.size() * sizeof(glm::vec4) + colours.size() * sizeof(ItemColour) +
               segments.size() * sizeof(VertexSegments) + indices.byte_count();
    }
};

enum class MeshMethod : std::uint8_t {
    Default,   // Boxes for Skeleton::box_segments, else Tubes
    Tubes,     // tubes along axes with shared rings at joints
    Cylinders, // one closed cylinder per segment (Crankshaw 2019)
    Boxes,     // boxes joined and smoothed by Catmull-Clark subdivision (docs/documents.md, S)
    Solid,     // one closed surface around the union of all parts, for printing
};

// Defaults of MeshOptions::sides and MeshOptions::subdivisions.
inline constexpr std::uint32_t kSubdivisions = 2;       // subdivisions without grooves
inline constexpr std::uint32_t kGrooveSides = 32;       // sides with grooves
inline constexpr std::uint32_t kGrooveSubdivisions = 3; // subdivisions with grooves
// Largest values of MeshOptions::deviation and MeshOptions::min_width that users can ask for, in m.
inline constexpr float kMaxDeviation = 1000.0F;
inline constexpr float kMaxMinWidth = 1000.0F;

struct MeshOptions {
    MeshMethod method = MeshMethod::Default;
    /// 0 is the finest; each level has about half the sides of the one before, and fewer rings.
    std::uint32_t level = 0;
    /// Sides of every cross-section; 0: the sides that each segment states.
    std::uint32_t sides = 0;
    /// Tubes: max distance in metres of a ring from its circle. Rings get the fewest sides within
    /// this distance, at most the sides of their level. 0: rings have the sides of their level.
    float deviation = 0.0F;
    /// Tubes: max distance in metres of joints from the edge that replaces them, for any radius.
    /// 0: joints are left out by `level` only.
    float axis_error = 0.0F;
    // Optional arrays of Mesh to fill.
    bool texture_coordinates = true;
    bool tangents = true;
    bool colours = true;
    bool segments = false; // for a skin or wind data
    /// Fraction of the radius by which smooth noise moves the bark (Baele and Warzee 2005); 0:
    /// none.
    float bark_noise = 0.0F;
    /// Depth of grooves along the stem, as a fraction of the radius; 0: none. With grooves, tubes
    /// without `sides` have kGrooveSides sides, boxes without `subdivisions` kGrooveSubdivisions. A
    /// tube has one groove per four sides, 3 to 16; a box 2^subdivisions, 4 to 16. A ring or box
    /// with fewer than two vertices per groove gets the mean thickness of a grooved one.
    float grooves = 0.0F;
    /// Tubes: axes bend along smooth curves through their joints.
    bool smooth_joints = false;
    /// Bending of leaves by gravity, 0 (none) to 1 (hanging); unset: Skeleton::leaf_droop.
    std::optional<float> droop = std::nullopt;
    /// Boxes: steps of smoothing. Unset: kGrooveSubdivisions with grooves, else 0 for
    /// Skeleton::box_segments, else kSubdivisions.
    std::optional<std::uint32_t> subdivisions = std::nullopt;
    /// Solid: width in metres of the thinnest branch, and of leaves and polygons. 0: 1/150 of the
    /// largest extent of the plant.
    float min_width = 0.0F;
    std::uint64_t max_bytes = ~std::uint64_t{0};
    std::uint32_t threads = 0; // 0: as many as the machine has

    friend bool operator==(const MeshOptions&, const MeshOptions&) = default;
};

/// A name in an OBJ or MTL file.
struct ObjName {
    std::string name;
    std::uint64_t offset = 0; // of the name in the file, in bytes
};

/// A mesh read from a file for `#object X "leaf.obj"`; length() is the step of the turtle.
/// A picture for polygons, `#object { "leaf.png"`, sets `picture` only.
struct UserMesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec2> texture_coordinates;
    std::vector<std::uint32_t> indices;
    std::vector<ObjName> libraries; // its material files (mtllib)
    std::vector<ObjName> materials; // of its faces, in order of first use; empty name: no material
    std::shared_ptr<const Texture> picture;         // picture of the whole mesh; may be null
    std::shared_ptr<const Texture> normal_map;      // normals of the whole mesh; may be null
    std::vector<std::string> files;                 // files tried to find the picture
    [[nodiscard]] float length() const;             // max y - min y
    [[nodiscard]] std::uint64_t byte_count() const; // in memory, without the picture
};

/// Replaces MeshMethod::Default and unset subdivisions and sides by their values for `skeleton`.
[[nodiscard]] MeshOptions resolved(const MeshOptions& options, const Skeleton& skeleton);

/// Makes `mesh` from `skeleton`. `user_meshes`: meshes of Skeleton::mesh_files, in order. The
/// result does not depend on the number of threads. On failure returns the reason, and the mesh is
/// empty. Limit: more than `max_bytes`; Failed: more than 2^32 - 1 vertices.
[[nodiscard]] std::optional<Stop> make_mesh(const Skeleton& skeleton,
                                            const std::vector<UserMesh>& user_meshes,
                                            const MeshOptions& options,
                                            Mesh& mesh);

/// The mesh of make_mesh() as text: a line of counts, then one for each part, vertex and triangle.
[[nodiscard]] std::uint64_t line_count(const Mesh& mesh);
/// Appends a line of the text. Precondition: line < line_count().
void append_line(const Mesh& mesh, std::uint64_t line, std::string& text);

/// Linear RGB colour of an item without a `#material`. Indexes: 0 bark, 1 leaf green, 2 to 15 ever
/// lighter greens, 16 to 24 light brown, red, amber, cream, pink, violet, blue, teal, grey; from 25
/// on the colours repeat from 2.
[[nodiscard]] glm::vec3 palette_colour(std::uint32_t index);

} // namespace lsys
