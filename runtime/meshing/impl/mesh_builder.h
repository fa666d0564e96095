// SPDX-License-Identifier: MIT
// MeshBuilder: the output of all meshers. Vertices go to common arrays in the order of calls,
// triangles to one part for each material. Limits are checked before memory is taken; after the
// first failure all calls are refused.
#pragma once

#include "runtime/meshing/mesh.h"

#include <cstdint>
#include <memory>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace lsys {

/// Palette index of objects without a colour of their own.
inline constexpr std::uint16_t kGreyPalette = 24;

/// Identity of a material. Parts of a mesh are sorted by this key.
struct MaterialKey {
    MaterialKind kind = MaterialKind::Plain;
    ItemColour palette = 0;
    bool two_sided = false;
    bool cut_out = false;
    bool textured = false;
    std::uint16_t picture = 0; // number in set_pictures(), from 1; 0: no picture of a file
    friend bool operator==(const MaterialKey&, const MaterialKey&) = default;
    friend bool operator<(const MaterialKey& a, const MaterialKey& b) {
        return std::tie(a.kind, a.palette, a.two_sided, a.cut_out, a.textured, a.picture) <
               std::tie(b.kind, b.palette, b.two_sided, b.cut_out, b.textured, b.picture);
    }
};
/// Pictures of a mesh file; each may be null.
struct FilePictures {
    std::shared_ptr<const Texture> colour;
    std::shared_ptr<const Texture> normal_map;
    std::string name; // name of the material
};

/// The material of wood: textured bark for palette index 0, the plain colour for any other index.
[[nodiscard]] MaterialKey wood_material(ItemColour palette);
/// `words`: names of the items drawn with the material, for example "sphere"; the name of a plain
/// material consists of them.
[[nodiscard]] Material make_material(const MaterialKey& key,
                                     std::span<const std::string> words = {});

struct MeshVertex {
    glm::vec3 position{};
    glm::vec3 normal{};
    glm::vec2 texture_coordinate{};
    glm::vec4 tangent{};
    ItemColour palette = 0;
    std::uint32_t segment = kNoSegment; // segment that moves the vertex
};

/// Room for new vertices and indices, which the caller fills completely. Arrays that the options
/// leave out are empty. Valid until the next call of the builder.
struct MeshBlock {
    std::uint32_t first_vertex = 0; // number in the mesh of the block's first vertex
    std::span<glm::vec3> positions;
    std::span<glm::vec3> normals;
    std::span<glm::vec2> texture_coordinates;
    std::span<glm::vec4> tangents;
    std::span<ItemColour> colours;
    std::span<VertexSegments> segments;
    std::span<std::uint32_t> indices;

    /// Writes a vertex into all arrays that the mesh has.
    void set(std::size_t vertex, const MeshVertex& value) const;
};

class MeshBuilder {
public:
    struct PartSize {
        MaterialKey material;
        std::uint64_t index_count = 0;
        std::string word = {}; // name of the items drawn; empty: the part gets no name
    };
    struct WholePart {
        MaterialKey material;
        TriangleList triangles;
        std::string word = {}; // as PartSize::word
    };

    /// Writes into `mesh` and reuses the memory of its vertices. Both arguments must outlive the
    /// builder.
    MeshBuilder(const MeshOptions& options, Mesh& mesh);
    MeshBuilder(const MeshBuilder&) = delete;
    MeshBuilder& operator=(const MeshBuilder&) = delete;

    [[nodiscard]] const MeshOptions& options() const { return options_; }
    /// Sets the pictures of files, by MaterialKey::picture - 1.
    void set_pictures(std::vector<FilePictures> pictures) { pictures_ = std::move(pictures); }
    /// Sets the looks of colour indices; null: none.
    void set_looks(std::shared_ptr<const Looks> looks) { mesh_.looks = std::move(looks); }
    /// The Stop that make_mesh() returns; nullopt until a limit is exceeded.
    [[nodiscard]] std::optional<Stop> stop() const { return stop_; }
    [[nodiscard]] std::uint64_t vertex_count() const { return vertices_; }
    /// Segments of all vertices so far; empty unless MeshOptions::segments is set.
    [[nodiscard]] std::span<VertexSegments> segments() {
        return std::span(mesh_.segments).first(options_.segments ? vertices_ : 0);
    }

    /// Adds complete parts, by ascending material, and makes room for their vertices. Must be the
    /// first call. Indices in WholePart::triangles count from 0. If the parts do not fit, adds
    /// nothing, sets stop() and returns false.
    [[nodiscard]] bool
    place_parts(std::vector<WholePart> parts, std::uint64_t vertices, MeshBlock& block);
    /// Like place_parts(), but makes room for the indices of each part instead of taking triangles.
    [[nodiscard]] bool reserve_parts(std::span<const PartSize> parts,
                                     std::uint64_t vertices,
                                     MeshBlock& block,
                                     std::vector<std::span<std::uint32_t>>& indices);

    /// The number of the part of a material, to be passed to reserve(). `word`: name of the items
    /// drawn.
    [[nodiscard]] std::uint32_t part(const MaterialKey& material, const std::string& word = {});
    /// Makes room for more vertices and indices of a part. If they do not fit, sets stop() and
    /// returns false.
    [[nodiscard]] bool
    reserve(std::uint32_t part, std::uint64_t vertices, std::uint64_t indices, MeshBlock& block);

    /// Joins the parts; the mesh is empty if a Stop is returned.
    [[nodiscard]] std::optional<Stop> finish();

private:
    struct Part {
        MaterialKey material;
        TriangleList triangles; // set by place_parts()
        LargeVector<std::uint32_t> indices;
        std::vector<std::string> words = {}; // each once, in the order of drawing
    };

    /// Adds `triangle_bytes` to the total. Sets stop_ and returns false if the new total, or
    /// `vertices` more vertices, would exceed a limit.
    bool claim(std::uint64_t vertices, std::uint64_t triangle_bytes);
    void grow_vertices(MeshBlock& block, std::uint64_t count); // makes room for `count` more

    const MeshOptions& options_;
    Mesh& mesh_;
    std::optional<Stop> stop_;
    std::uint64_t vertices_ = 0;       // number of vertices so far
    std::uint64_t triangle_bytes_ = 0; // bytes of the triangles of all parts
    std::vector<FilePictures> pictures_;
    std::vector<Part> parts_;     // first the parts of place_parts() or reserve_parts()
    std::size_t first_parts_ = 0; // number of the parts of place_parts() or reserve_parts()
};

} // namespace lsys
