#include "runtime/meshing/mesh_builder.h"

#include "grammar/contract.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace lsys {

namespace {

constexpr std::uint64_t kMaxVertices = 0xFFFFFFFFu;

/// `data` with room for `needed` elements of which the first `used` keep their values. What is new
/// is exact if nothing is kept, else room grows by doubling.
template <typename Vector>
std::span<typename Vector::value_type>
grow(Vector& data, std::uint64_t used, std::uint64_t needed) {
    if (data.capacity() < needed) {
        if (used == 0) {
            data = {};
            data.reserve(needed);
        } else {
            data.resize(used);
            data.reserve(std::max(needed, 2 * used));
        }
    }
    if (data.size() < needed) {
        data.resize(needed);
    }
    return std::span(data).subspan(used, needed - used);
}

template <typename Vector>
void use_or_clear(Vector& data, bool used) {
    if (!used) {
        data = {};
    }
}

} // namespace

MaterialKey wood_material(std::uint16_t palette) {
    return palette == 0 ? MaterialKey{.kind = MaterialKind::Bark, .textured = true}
                        : MaterialKey{.kind = MaterialKind::Plain, .palette = palette};
}

Material make_material(const MaterialKey& key) {
    Material material;
    switch (key.kind) {
    case MaterialKind::Bark:
        material.name = key.palette == 0 ? "bark" : fmt::format("bark {}", key.palette);
        break;
    case MaterialKind::Leaf:
        material.name = key.textured ? "leaf" : "polygon";
        if (key.palette != 1) {
            material.name += fmt::format(" {}", key.palette);
        }
        break;
    case MaterialKind::Flower:
        material.name = fmt::format("flower {}", key.palette);
        break;
    case MaterialKind::Plain:
        material.name = fmt::format("colour {}", key.palette);
        if (key.two_sided) {
            material.name += ", two-sided";
        }
        break;
    }
    material.kind = key.kind;
    material.colour = glm::vec4(palette_colour(key.palette), 1.0F);
    material.two_sided = key.two_sided;
    material.cut_out = key.cut_out;
    material.textured = key.textured;
    return material;
}

void MeshBlock::set(std::size_t vertex, const MeshVertex& value) const {
    positions[vertex] = value.position;
    normals[vertex] = value.normal;
    if (!texture_coordinates.empty()) {
        texture_coordinates[vertex] = value.texture_coordinate;
    }
    if (!tangents.empty()) {
        tangents[vertex] = value.tangent;
    }
    if (!colours.empty()) {
        colours[vertex] = value.palette;
    }
    if (!segments.empty()) {
        segments[vertex] = {value.segment, value.segment};
    }
}

MeshBuilder::MeshBuilder(const MeshOptions& options, Mesh& mesh) : options_(options), mesh_(mesh) {
    use_or_clear(mesh.texture_coordinates, options.texture_coordinates);
    use_or_clear(mesh.tangents, options.tangents);
    use_or_clear(mesh.colours, options.colours);
    use_or_clear(mesh.segments, options.segments);
    mesh.parts.clear();
    mesh.materials.clear();
}

/// Counts what is to come, if it fits.
bool MeshBuilder::take(std::uint64_t vertices, std::uint64_t indices) {
    if (status_ != MeshStatus::Ok) {
        return false;
    }
    if (vertices > kMaxVertices - vertices_) {
        status_ = MeshStatus::TooManyVertices;
        return false;
    }
    const std::uint64_t bytes_of_vertex = 2 * sizeof(glm::vec3) +
                                          (options_.texture_coordinates ? sizeof(glm::vec2) : 0) +
                                          (options_.tangents ? sizeof(glm::vec4) : 0) +
                                          (options_.colours ? sizeof(std::uint16_t) : 0) +
                                          (options_.segments ? sizeof(VertexSegments) : 0);
    const std::uint64_t limit = options_.max_bytes;
    const std::uint64_t vertex_bytes = (vertices_ + vertices) * bytes_of_vertex;
    if (vertex_bytes > limit ||
        indices_ + indices > (limit - vertex_bytes) / sizeof(std::uint32_t)) {
        status_ = MeshStatus::Limit;
        return false;
    }
    indices_ += indices;
    return true;
}

void MeshBuilder::grow_vertices(MeshBlock& block, std::uint64_t count) {
    const std::uint64_t needed = vertices_ + count;
    block.first_vertex = static_cast<std::uint32_t>(vertices_);
    block.positions = grow(mesh_.positions, vertices_, needed);
    block.normals = grow(mesh_.normals, vertices_, needed);
    if (options_.texture_coordinates) {
        block.texture_coordinates = grow(mesh_.texture_coordinates, vertices_, needed);
    }
    if (options_.tangents) {
        block.tangents = grow(mesh_.tangents, vertices_, needed);
    }
    if (options_.colours) {
        block.colours = grow(mesh_.colours, vertices_, needed);
    }
    if (options_.segments) {
        block.segments = grow(mesh_.segments, vertices_, needed);
    }
    vertices_ = needed;
}

bool MeshBuilder::reserve_parts(std::span<const PartSize> parts,
                                std::uint64_t vertices,
                                MeshBlock& block) {
    LSYS_CHECK(parts_.empty() && vertices_ == 0, parts_.size(), vertices_);
    std::uint64_t indices = 0;
    for (const PartSize& size : parts) {
        indices += size.index_count;
    }
    if (!take(vertices, indices)) {
        return false;
    }
    for (const PartSize& size : parts) {
        LSYS_CHECK(parts_.empty() || parts_.back().material < size.material);
        parts_.push_back({.material = size.material, .in_place = size.index_count, .indices = {}});
    }
    parts_in_place_ = parts_.size();
    block = {};
    grow_vertices(block, vertices);
    block.indices = grow(mesh_.indices, 0, indices);
    return true;
}

std::uint32_t MeshBuilder::part(const MaterialKey& material) {
    const auto found = std::find_if(parts_.begin(), parts_.end(), [&](const Part& candidate) {
        return candidate.material == material;
    });
    if (found != parts_.end()) {
        return static_cast<std::uint32_t>(found - parts_.begin());
    }
    parts_.push_back({.material = material, .in_place = 0, .indices = {}});
    return static_cast<std::uint32_t>(parts_.size() - 1);
}

bool MeshBuilder::reserve(std::uint32_t part,
                          std::uint64_t vertices,
                          std::uint64_t indices,
                          MeshBlock& block) {
    LSYS_CHECK(part < parts_.size(), part, parts_.size());
    if (!take(vertices, indices)) {
        return false;
    }
    block = {};
    grow_vertices(block, vertices);
    LargeVector<std::uint32_t>& data = parts_[part].indices;
    block.indices = grow(data, data.size(), data.size() + indices);
    return true;
}

/// Moves the indices of all parts to where they stay; `order` gets the parts in their order there.
void MeshBuilder::place_parts(std::vector<std::uint32_t>& order) {
    order.resize(parts_.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(
        order.begin() + static_cast<std::ptrdiff_t>(parts_in_place_), order.end(),
        [&](std::uint32_t a, std::uint32_t b) { return parts_[a].material < parts_[b].material; });
    std::uint64_t in_place = 0;
    for (const Part& part : parts_) {
        in_place += part.in_place;
    }
    grow(mesh_.indices, in_place, indices_);
    std::uint64_t end = indices_;
    for (auto at = order.rbegin(); at != order.rend(); ++at) {
        Part& part = parts_[*at];
        const std::uint64_t begin = end - part.in_place - part.indices.size();
        in_place -= part.in_place;
        const auto data = mesh_.indices.begin();
        const auto from = data + static_cast<std::ptrdiff_t>(in_place);
        if (begin != in_place) {
            std::copy_backward(from, from + static_cast<std::ptrdiff_t>(part.in_place),
                               data + static_cast<std::ptrdiff_t>(begin + part.in_place));
        }
        std::copy(part.indices.begin(), part.indices.end(),
                  data + static_cast<std::ptrdiff_t>(begin + part.in_place));
        end = begin;
    }
}

MeshStatus MeshBuilder::finish() {
    if (status_ != MeshStatus::Ok) {
        mesh_ = {};
        return status_;
    }
    std::vector<std::uint32_t> order;
    place_parts(order);
    mesh_.positions.resize(vertices_);
    mesh_.normals.resize(vertices_);
    mesh_.texture_coordinates.resize(options_.texture_coordinates ? vertices_ : 0);
    mesh_.tangents.resize(options_.tangents ? vertices_ : 0);
    mesh_.colours.resize(options_.colours ? vertices_ : 0);
    mesh_.segments.resize(options_.segments ? vertices_ : 0);
    mesh_.indices.resize(indices_);
    std::uint64_t first = 0;
    for (const std::uint32_t index : order) {
        const Part& part = parts_[index];
        const std::uint64_t count = part.in_place + part.indices.size();
        if (count == 0) {
            continue;
        }
        mesh_.parts.push_back({.material = static_cast<std::uint32_t>(mesh_.materials.size()),
                               .first_index = first,
                               .index_count = count});
        mesh_.materials.push_back(make_material(part.material));
        first += count;
    }
    parts_.clear();
    return MeshStatus::Ok;
}

} // namespace lsys
