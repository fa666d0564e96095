// SPDX-License-Identifier: MIT
#include "runtime/export/impl/gltf_primitives.h"

#include "runtime/export/impl/formats.h"
#include "runtime/export/impl/gltf_data.h"
#include "runtime/export/tile_document.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

namespace lsys {

namespace {

constexpr std::uint32_t kUnused = ~std::uint32_t{0};

/// Whether two materials differ at most in name, red, green and blue.
bool differ_in_colour_only(const Material& a, const Material& b) {
    return a.kind == b.kind && a.colour.a == b.colour.a && a.two_sided == b.two_sided &&
           a.cut_out == b.cut_out && a.textured == b.textured && a.picture == b.picture &&
           a.normal_map == b.normal_map && a.roughness == b.roughness &&
           a.translucency == b.translucency;
}

bool is_in_range(const glm::vec4& colour) {
    return colour == glm::clamp(colour, 0.0F, 1.0F);
}

/// Gives the primitive the max of the colours of its materials in each channel, so that the colours
/// of the materials are fractions, 0 to 1, of the colour of the primitive.
void merge_colours(const Mesh& mesh, GltfPrimitive& primitive) {
    glm::vec3 max_colour(0.0F);
    for (const GltfPart& part : primitive.parts) {
        max_colour =
            glm::max(max_colour, glm::vec3(mesh.materials[mesh.parts[part.part].material].colour));
    }
    primitive.colours = GltfColours::Material;
    for (int channel = 0; channel < 3; ++channel) {
        primitive.colour[channel] = max_colour[channel] > 0.0F ? max_colour[channel] : 1.0F;
    }
}

/// Primitives of some parts with their colours, without vertices.
std::vector<GltfPrimitive>
group_parts(const Mesh& mesh, std::uint32_t first_part, std::uint32_t part_count) {
    std::vector<std::vector<GltfPart>> groups;
    std::vector<bool> coloured;
    for (std::uint32_t i = first_part; i < first_part + part_count; ++i) {
        if (mesh.parts[i].index_count < 3) {
            continue;
        }
        const Material& material = mesh.materials[mesh.parts[i].material];
        const bool has_own_colours = has_vertex_colours(mesh, mesh.parts[i]);
        std::size_t group = groups.size();
        if (!has_own_colours && is_in_range(material.colour)) {
            for (group = 0; group < groups.size(); ++group) {
                const MeshPart& first = mesh.parts[groups[group].front().part];
                const Material& other = mesh.materials[first.material];
                if (!coloured[group] && is_in_range(other.colour) &&
                    differ_in_colour_only(material, other)) {
                    break;
                }
            }
        }
        if (group == groups.size()) {
            groups.emplace_back();
            coloured.push_back(has_own_colours);
        }
        groups[group].push_back({i});
    }
    std::vector<GltfPrimitive> list;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        if (groups[g].size() >= kMinMergedMaterials) {
            list.emplace_back().parts = groups[g];
            merge_colours(mesh, list.back());
            continue;
        }
        for (const GltfPart& part : groups[g]) {
            GltfPrimitive& primitive = list.emplace_back();
            primitive.parts = {part};
            if (coloured[g]) {
                primitive.colours = GltfColours::Palette;
            } else {
                primitive.colour = mesh.materials[mesh.parts[part.part].material].colour;
            }
        }
    }
    const auto begins_before = [](const GltfPrimitive& a, const GltfPrimitive& b) {
        return a.parts.front().part < b.parts.front().part;
    };
    std::sort(list.begin(), list.end(), begins_before);
    return list;
}

/// Whether the triangles share an edge, which they list in opposite directions.
bool share_edge(const std::uint32_t* a, const std::uint32_t* b) {
    const auto has = [b](std::uint32_t from, std::uint32_t to) {
        return (b[0] == from && b[1] == to) || (b[1] == from && b[2] == to) ||
               (b[2] == from && b[0] == to);
    };
    return has(a[1], a[0]) || has(a[2], a[1]) || has(a[0], a[2]);
}

/// Orders the triangles of parts for compression and numbers their vertices.
class PartOrderer {
public:
    /// `users`: for each vertex of the mesh the part that used it last. `vertices`: the vertices of
    /// the file so far.
    PartOrderer(const Mesh& mesh,
                const GltfCompressionInput& input,
                LargeVector<std::uint32_t>& users,
                LargeVector<std::uint32_t>& vertices)
        : mesh_(mesh), input_(input), users_(users), vertices_(vertices),
          numbers_(mesh.positions.size()) {}

    void add(GltfPrimitive& primitive, GltfPart& part) {
        const MeshPart& drawn = mesh_.parts[part.part];
        part.indices.resize(drawn.index_count / 3 * 3);
        mesh_.indices.read(drawn.first_index, part.indices);
        order_triangles(part.indices);
        const MaterialPictures& shown = input_.pictures.of_materials[drawn.material];
        textured_ = (shown.colour || shown.normal_map || input_.compares_segments) &&
                    is_complete(mesh_, mesh_.texture_coordinates);
        tangents_ = shown.normal_map && is_complete(mesh_, mesh_.tangents);
        coloured_ = primitive.colours == GltfColours::Palette;
        std::array<std::uint32_t, kSlots> near; // by hash of the position: number of a vertex
        near.fill(kUnused);
        for (std::uint32_t& index : part.indices) {
            const std::uint32_t vertex = index;
            if (users_[vertex] != part.part) {
                users_[vertex] = part.part;
                std::uint32_t& known = near[slot_of(mesh_.positions[vertex])];
                if (known == kUnused || !are_equal(vertices_[part.first_vertex + known], vertex)) {
                    known = static_cast<std::uint32_t>(vertices_.size() - part.first_vertex);
                    vertices_.push_back(vertex);
                    primitive.bounds.add(mesh_.positions[vertex]);
                }
                numbers_[vertex] = known;
            }
            index = numbers_[vertex];
        }
    }

private:
    static constexpr std::size_t kSlots = 1024;

    static std::size_t slot_of(const glm::vec3& position) {
        std::uint32_t hash = 0;
        for (int axis = 0; axis < 3; ++axis) {
            hash = (hash ^ std::bit_cast<std::uint32_t>(position[axis])) * 0x9E3779B1U;
            hash ^= hash >> 15;
        }
        return hash % kSlots;
    }

    [[nodiscard]] bool are_equal(std::uint32_t a, std::uint32_t b) const {
        return mesh_.positions[a] == mesh_.positions[b] && mesh_.normals[a] == mesh_.normals[b] &&
               (!textured_ || mesh_.texture_coordinates[a] == mesh_.texture_coordinates[b]) &&
               (!tangents_ || mesh_.tangents[a] == mesh_.tangents[b]) &&
               (!coloured_ || mesh_.colours[a] == mesh_.colours[b]) &&
               (!input_.compares_segments || mesh_.segments[a] == mesh_.segments[b]);
    }

    const Mesh& mesh_;
    const GltfCompressionInput& input_;
    LargeVector<std::uint32_t>& users_;
    LargeVector<std::uint32_t>& vertices_;
    LargeVector<std::uint32_t> numbers_; // of each vertex, in the part that used it last
    // Whether vertices are equal only with equal texture coordinates, tangents and colours.
    bool textured_ = false;
    bool tangents_ = false;
    bool coloured_ = false;
};

/// Sets the vertices of the only primitive, whose order is known.
void take_order(const Mesh& mesh, const MeshOrder& order, GltfPrimitives& primitives) {
    primitives.vertices = order.vertices;
    GltfPrimitive& primitive = primitives.list.front();
    GltfPart& part = primitive.parts.front();
    part.vertex_count = order.vertices.size();
    primitive.vertex_count = order.vertices.size();
    primitive.index_count = mesh.parts[part.part].index_count;
    for (const std::uint32_t vertex : order.vertices) {
        primitive.bounds.add(mesh.positions[vertex]);
    }
}

} // namespace

Bounds GltfPrimitives::bounds() const {
    Bounds all;
    for (const GltfPrimitive& primitive : list) {
        all.add(primitive.bounds.low);
        all.add(primitive.bounds.high);
    }
    return all;
}

const Material& material_of(const Mesh& mesh, const GltfPrimitive& primitive) {
    return mesh.materials[mesh.parts[primitive.parts.front().part].material];
}

void order_triangles(std::span<std::uint32_t> triangles) {
    std::uint32_t* const corners = triangles.data();
    const std::size_t count = triangles.size() / 3;
    std::size_t ordered = 0; // count of triangles at their final places
    // The next triangles, in an order in which each shares an edge with the previous one.
    std::vector<std::uint32_t> run;
    std::vector<std::uint32_t> run_corners; // corners of the run
    const auto meet = [corners](std::size_t a, std::size_t b) {
        return share_edge(corners + 3 * a, corners + 3 * b);
    };
    const auto end_run = [&] {
        // The last two triangles may be a quad, so the triangle before the last one counts too.
        const auto meets_last = [&](std::uint32_t triangle) {
            const std::size_t back = std::min<std::size_t>(ordered, 2);
            for (std::size_t i = 1; i <= back; ++i) {
                if (meet(ordered - i, triangle)) {
                    return true;
                }
            }
            return false;
        };
        if (!meets_last(run.front()) && meets_last(run.back())) {
            std::reverse(run.begin(), run.end());
        }
        run_corners.clear();
        for (const std::uint32_t triangle : run) {
            const std::uint32_t* const from = corners + 3 * std::size_t{triangle};
            run_corners.insert(run_corners.end(), from, from + 3);
        }
        std::copy(run_corners.begin(), run_corners.end(), corners + 3 * ordered);
        ordered += run.size();
        run.clear();
    };
    const auto add = [&run](std::size_t triangle) {
        run.push_back(static_cast<std::uint32_t>(triangle));
    };
    for (std::size_t i = 0; i < count;) {
        const bool pair = i + 1 < count && meet(i, i + 1);
        const bool begins = run.empty() || !meet(run.back(), i);
        bool swapped = false;
        if (pair && begins && !run.empty()) {
            swapped = meet(run.back(), i + 1);
        }
        if (begins && !swapped) {
            if (!run.empty()) {
                end_run();
            }
            // Swaps the two triangles of the first quad of a run if its first triangle, and not its
            // second, shares an edge with the next quad.
            swapped = pair && i + 2 < count && !meet(i + 1, i + 2) &&
                      (meet(i, i + 2) || (i + 3 < count && meet(i, i + 3)));
        }
        if (swapped) {
            add(i + 1);
            add(i);
            i += 2;
        } else {
            add(i++);
        }
    }
    if (!run.empty()) {
        end_run();
    }
}

GltfPrimitives plan_gltf_primitives(const Mesh& mesh,
                                    const std::optional<GltfCompressionInput>& compressed,
                                    const MeshFilm* film) {
    GltfPrimitives primitives;
    if (film == nullptr) {
        primitives.list = group_parts(mesh, 0, static_cast<std::uint32_t>(mesh.parts.size()));
    } else {
        for (std::uint32_t shape = 0; shape < film->shapes.size(); ++shape) {
            const MeshFilm::Shape& from = film->shapes[shape];
            for (GltfPrimitive& each : group_parts(mesh, from.first_part, from.part_count)) {
                each.shape = shape;
                primitives.list.push_back(std::move(each));
            }
        }
    }
    if (compressed && compressed->order != nullptr) {
        take_order(mesh, *compressed->order, primitives);
        return primitives;
    }
    primitives.vertices.reserve(mesh.positions.size());
    // Number of the part that used a vertex last.
    LargeVector<std::uint32_t> users(mesh.positions.size());
    std::fill(users.begin(), users.end(), kUnused);
    TriangleReader indices(mesh.indices);
    std::optional<PartOrderer> orderer;
    if (compressed) {
        orderer.emplace(mesh, *compressed, users, primitives.vertices);
    }
    for (GltfPrimitive& primitive : primitives.list) {
        primitive.first_vertex = primitives.vertices.size();
        for (GltfPart& part : primitive.parts) {
            part.first_vertex = primitives.vertices.size();
            const MeshPart& triangles = mesh.parts[part.part];
            const std::uint64_t count = triangles.index_count / 3 * 3;
            if (orderer) {
                orderer->add(primitive, part);
            }
            for (std::uint64_t i = 0; !orderer && i < count; ++i) {
                const std::uint32_t vertex = indices[triangles.first_index + i];
                if (users[vertex] != part.part) {
                    users[vertex] = part.part;
                    primitives.vertices.push_back(vertex);
                    primitive.bounds.add(mesh.positions[vertex]);
                }
            }
            part.vertex_count = primitives.vertices.size() - part.first_vertex;
            primitive.index_count += count;
        }
        primitive.vertex_count = primitives.vertices.size() - primitive.first_vertex;
    }
    return primitives;
}

} // namespace lsys
