// MeshBuilder: where all meshers write. Vertices go to common arrays in the order they come, and
// triangles to one part for each material. What does not fit is noticed before room is made for it,
// and from then on nothing more is taken.
#pragma once

#include "runtime/meshing/mesh.h"

#include <cstdint>
#include <memory>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace lsys {

/// What tells materials apart; their order is that of the parts of a mesh.
struct MaterialKey {
    MaterialKind kind = MaterialKind::Plain;
    std::uint16_t palette = 0;
    bool two_sided = false;
    bool cut_out = false;
    bool textured = false;
    std::uint16_t picture = 0; // number in set_pictures(), from 1; 0: that of its kind
    friend bool operator==(const MaterialKey&, const MaterialKey&) = default;
    friend bool operator<(const MaterialKey& a, const MaterialKey& b) {
        return std::tie(a.kind, a.palette, a.two_sided, a.cut_out, a.textured, a.picture) <
               std::tie(b.kind, b.palette, b.two_sided, b.cut_out, b.textured, b.picture);
    }
};
/// Textured bark for palette index 0, the plain colour for any other: what wood is made of.
[[nodiscard]] MaterialKey wood_material(std::uint16_t palette);
[[nodiscard]] Material make_material(const MaterialKey& key);

struct MeshVertex {
    glm::vec3 position{};
    glm::vec3 normal{};
    glm::vec2 texture_coordinate{};
    glm::vec4 tangent{};
    std::uint16_t palette = 0;
    std::uint32_t segment = kNoSegment; // that carries it
};

/// Room to be filled, every element of it. Arrays that the options leave out are empty. It is good
/// until the builder is asked for more.
struct MeshBlock {
    std::uint32_t first_vertex = 0; // what an index into the block has to be moved by
    std::span<glm::vec3> positions;
    std::span<glm::vec3> normals;
    std::span<glm::vec2> texture_coordinates;
    std::span<glm::vec4> tangents;
    std::span<std::uint16_t> colours;
    std::span<VertexSegments> segments;
    std::span<std::uint32_t> indices;

    void set(std::size_t vertex, const MeshVertex& value) const;
};

class MeshBuilder {
public:
    struct PartSize {
        MaterialKey material;
        std::uint64_t index_count = 0;
    };
    struct WholePart {
        MaterialKey material;
        TriangleList triangles;
    };

    /// Writes into `mesh`, whose vertices' memory is used again. Both outlive the builder.
    MeshBuilder(const MeshOptions& options, Mesh& mesh);
    MeshBuilder(const MeshBuilder&) = delete;
    MeshBuilder& operator=(const MeshBuilder&) = delete;

    [[nodiscard]] const MeshOptions& options() const { return options_; }
    /// Those of files, which MaterialKey::picture counts.
    void set_pictures(std::vector<std::shared_ptr<const Texture>> pictures) {
        pictures_ = std::move(pictures);
    }
    /// Ok until something did not fit.
    [[nodiscard]] MeshStatus status() const { return status_; }
    [[nodiscard]] std::uint64_t vertex_count() const { return vertices_; }
    /// Those of all vertices so far; empty if the options leave them out.
    [[nodiscard]] std::span<VertexSegments> segments() {
        return std::span(mesh_.segments).first(options_.segments ? vertices_ : 0);
    }

    /// Only as the first thing: parts by rising material, which come before all others, and room
    /// for their vertices; `triangles` count them from the first. False: does not fit, nothing was
    /// done.
    [[nodiscard]] bool
    place_parts(std::vector<WholePart> parts, std::uint64_t vertices, MeshBlock& block);
    /// The same with room for the indices of each part.
    [[nodiscard]] bool reserve_parts(std::span<const PartSize> parts,
                                     std::uint64_t vertices,
                                     MeshBlock& block,
                                     std::vector<std::span<std::uint32_t>>& indices);

    /// Number of the part of a material, for the calls below.
    [[nodiscard]] std::uint32_t part(const MaterialKey& material);
    /// Room for more of a part. False: does not fit, nothing was done.
    [[nodiscard]] bool
    reserve(std::uint32_t part, std::uint64_t vertices, std::uint64_t indices, MeshBlock& block);

    /// Puts the parts together; the mesh is empty unless Ok is returned.
    [[nodiscard]] MeshStatus finish();

private:
    struct Part {
        MaterialKey material;
        TriangleList triangles; // that came whole
        LargeVector<std::uint32_t> indices;
    };

    bool take(std::uint64_t vertices, std::uint64_t triangle_bytes);
    void grow_vertices(MeshBlock& block, std::uint64_t count);

    const MeshOptions& options_;
    Mesh& mesh_;
    MeshStatus status_ = MeshStatus::Ok;
    std::uint64_t vertices_ = 0;
    std::uint64_t triangle_bytes_ = 0;
    std::vector<std::shared_ptr<const Texture>> pictures_;
    std::vector<Part> parts_; // those of place_parts() and reserve_parts() first
    std::size_t first_parts_ = 0;
};

} // namespace lsys
