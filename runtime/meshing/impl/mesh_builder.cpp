// SPDX-License-Identifier: MIT
#include "runtime/meshing/impl/mesh_builder.h"

#include "grammar/base/contract.h"
#include "runtime/meshing/looks.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace lsys {

namespace {

constexpr std::uint64_t kMaxVertices = 0xFFFFFFFFu;

/// Makes room for `needed` elements in `data` and keeps the first `used` elements. Allocates
/// exactly `needed` elements if none is kept, else by doubling.
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

void add_word(std::vector<std::string>& words, const std::string& word) {
    if (!word.empty() && std::find(words.begin(), words.end(), word) == words.end()) {
        words.push_back(word);
    }
}

bool has_material(const std::vector<Material>& materials, const std::string& name) {
    return std::any_of(materials.begin(), materials.end(),
                       [&name](const Material& each) { return each.name == name; });
}

/// Name of a colour: "3" for a palette index, "6699CC" for an RGB colour. Without `#`, which some
/// readers of OBJ take for a comment.
std::string name_of_colour(ItemColour colour) {
    return is_own(colour) ? fmt::format("{:06X}", colour - kOwnColour) : fmt::format("{}", colour);
}

} // namespace

MaterialKey wood_material(ItemColour palette) {
    return palette == 0 ? MaterialKey{.kind = MaterialKind::Bark, .textured = true}
                        : MaterialKey{.kind = MaterialKind::Plain, .palette = palette};
}

Material make_material(const MaterialKey& key, std::span<const std::string> words) {
    Material material;
    switch (key.kind) {
    case MaterialKind::Bark:
        material.name =
            key.palette == 0 ? "bark" : fmt::format("bark {}", name_of_colour(key.palette));
        break;
    case MaterialKind::Leaf:
        material.name = key.textured ? "leaf" : "polygon";
        if (key.palette != 1) {
            material.name += fmt::format(" {}", name_of_colour(key.palette));
        }
        break;
    case MaterialKind::Flower:
        material.name = fmt::format("flower {}", name_of_colour(key.palette));
        break;
    case MaterialKind::Plain:
        material.name = words.empty() ? "colour" : fmt::format("{}", fmt::join(words, " and "));
        if (words.empty() || key.palette != kGreyPalette) {
            material.name += fmt::format(" {}", name_of_colour(key.palette));
        }
        break;
    }
    material.kind = key.kind;
    material.colour = glm::vec4(
        key.picture != 0 && key.textured ? glm::vec3(1.0F) : palette_colour(key.palette), 1.0F);
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
    mesh.looks = nullptr;
}

/// Checks the limits and adds the bytes of triangles to the total. If the limits are exceeded, sets
/// stop_ and returns false.
bool MeshBuilder::claim(std::uint64_t vertices, std::uint64_t triangle_bytes) {
    if (stop_) {
        return false;
    }
    if (vertices > kMaxVertices - vertices_) {
        stop_ = Stop::Failed;
        return false;
    }
    const std::uint64_t bytes_of_vertex =
        2 * sizeof(glm::vec3) + (options_.texture_coordinates ? sizeof(glm::vec2) : 0) +
        (options_.tangents ? sizeof(glm::vec4) : 0) + (options_.colours ? sizeof(ItemColour) : 0) +
        (options_.segments ? sizeof(VertexSegments) : 0);
    const std::uint64_t limit = options_.max_bytes;
    const std::uint64_t vertex_bytes = (vertices_ + vertices) * bytes_of_vertex;
    if (vertex_bytes > limit || triangle_bytes_ + triangle_bytes > limit - vertex_bytes) {
        stop_ = Stop::Limit;
        return false;
    }
    triangle_bytes_ += triangle_bytes;
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

bool MeshBuilder::place_parts(std::vector<WholePart> parts,
                              std::uint64_t vertices,
                              MeshBlock& block) {
    LSYS_CHECK(parts_.empty() && vertices_ == 0, parts_.size(), vertices_);
    std::uint64_t bytes = 0;
    for (const WholePart& part : parts) {
        bytes += part.triangles.byte_count();
    }
    if (!claim(vertices, bytes)) {
        return false;
    }
    for (WholePart& part : parts) {
        LSYS_CHECK(parts_.empty() || parts_.back().material < part.material);
        parts_.push_back(
            {.material = part.material, .triangles = std::move(part.triangles), .indices = {}});
        add_word(parts_.back().words, part.word);
    }
    first_parts_ = parts_.size();
    block = {};
    grow_vertices(block, vertices);
    return true;
}

bool MeshBuilder::reserve_parts(std::span<const PartSize> parts,
                                std::uint64_t vertices,
                                MeshBlock& block,
                                std::vector<std::span<std::uint32_t>>& indices) {
    LSYS_CHECK(parts_.empty() && vertices_ == 0, parts_.size(), vertices_);
    std::uint64_t count = 0;
    for (const PartSize& size : parts) {
        count += size.index_count;
    }
    if (!claim(vertices, count * sizeof(std::uint32_t))) {
        return false;
    }
    for (const PartSize& size : parts) {
        LSYS_CHECK(parts_.empty() || parts_.back().material < size.material);
        Part& part =
            parts_.emplace_back(Part{.material = size.material, .triangles = {}, .indices = {}});
        indices.push_back(grow(part.indices, 0, size.index_count));
        add_word(part.words, size.word);
    }
    first_parts_ = parts_.size();
    block = {};
    grow_vertices(block, vertices);
    return true;
}

std::uint32_t MeshBuilder::part(const MaterialKey& material, const std::string& word) {
    const auto found = std::find_if(parts_.begin(), parts_.end(), [&](const Part& candidate) {
        return candidate.material == material;
    });
    if (found != parts_.end()) {
        add_word(found->words, word);
        return static_cast<std::uint32_t>(found - parts_.begin());
    }
    parts_.push_back({.material = material, .triangles = {}, .indices = {}});
    add_word(parts_.back().words, word);
    return static_cast<std::uint32_t>(parts_.size() - 1);
}

bool MeshBuilder::reserve(std::uint32_t part,
                          std::uint64_t vertices,
                          std::uint64_t indices,
                          MeshBlock& block) {
    LSYS_CHECK(part < parts_.size(), part, parts_.size());
    if (!claim(vertices, indices * sizeof(std::uint32_t))) {
        return false;
    }
    block = {};
    grow_vertices(block, vertices);
    LargeVector<std::uint32_t>& data = parts_[part].indices;
    block.indices = grow(data, data.size(), data.size() + indices);
    return true;
}

std::optional<Stop> MeshBuilder::finish() {
    if (stop_) {
        mesh_ = {};
        return stop_;
    }
    std::vector<std::uint32_t> order(parts_.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(
        order.begin() + static_cast<std::ptrdiff_t>(first_parts_), order.end(),
        [&](std::uint32_t a, std::uint32_t b) { return parts_[a].material < parts_[b].material; });
    mesh_.positions.resize(vertices_);
    mesh_.normals.resize(vertices_);
    mesh_.texture_coordinates.resize(options_.texture_coordinates ? vertices_ : 0);
    mesh_.tangents.resize(options_.tangents ? vertices_ : 0);
    mesh_.colours.resize(options_.colours ? vertices_ : 0);
    mesh_.segments.resize(options_.segments ? vertices_ : 0);
    mesh_.indices = {};
    for (const std::uint32_t index : order) {
        Part& part = parts_[index];
        const std::uint64_t first = mesh_.indices.size();
        mesh_.indices.append(std::move(part.triangles), 0);
        mesh_.indices.append(std::move(part.indices));
        const std::uint64_t count = mesh_.indices.size() - first;
        if (count == 0) {
            continue;
        }
        mesh_.parts.push_back({.material = static_cast<std::uint32_t>(mesh_.materials.size()),
                               .first_index = first,
                               .index_count = count});
        Material material = make_material(part.material, part.words);
        if (part.material.picture != 0) {
            const FilePictures& pictures = pictures_[part.material.picture - 1U];
            material.picture = pictures.colour;
            material.normal_map = pictures.normal_map;
            material.name = pictures.name;
        }
        apply_look(mesh_.looks.get(), part.material.palette, material);
        const std::string name = material.name;
        for (int number = 2; has_material(mesh_.materials, material.name); ++number) {
            material.name = fmt::format("{}, {}", name, number);
        }
        mesh_.materials.push_back(std::move(material));
    }
    parts_.clear();
    return std::nullopt;
}

} // namespace lsys
