#include "runtime/export/impl/gltf_data.h"

#include "runtime/export/impl/formats.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace lsys {

static_assert(std::endian::native == std::endian::little,
              "arrays are written as they lie in memory");
static_assert(sizeof(glm::vec2) == 8 && sizeof(glm::vec3) == 12 && sizeof(glm::vec4) == 16);

namespace {

using ColourBytes = std::array<std::uint8_t, 4>; // linear, opaque

constexpr std::size_t kChunk = 16384; // vertices

bool is_coloured(const Mesh& mesh, const MeshPart& part) {
    if (!is_complete(mesh, mesh.colours) || mesh.materials[part.material].picture != nullptr) {
        return false;
    }
    const glm::vec3 own(mesh.materials[part.material].colour);
    std::uint32_t last_colour = ~std::uint32_t{0}; // a palette index with the material's colour
    TriangleReader indices(mesh.indices);
    for (std::uint64_t i = 0; i < part.index_count; ++i) {
        const std::uint16_t colour = mesh.colours[indices[part.first_index + i]];
        if (colour != last_colour) {
            if (palette_colour(colour) != own) {
                return true;
            }
            last_colour = colour;
        }
    }
    return false;
}

/// Tolerance of the length: 0.0005, a tenth of that of the glTF validator.
bool is_unit(const glm::vec3& v) {
    return std::abs(glm::dot(v, v) - 1.0F) < 1e-3F;
}
bool is_valid(const glm::vec3& normal) {
    return is_unit(normal);
}
bool is_valid(const glm::vec4& tangent) {
    return is_unit(glm::vec3(tangent)) && (tangent.w == 1.0F || tangent.w == -1.0F);
}
glm::vec3 unit(const glm::vec3& v, const glm::vec3& otherwise) {
    const glm::vec3 u = v / glm::length(v);
    return is_unit(u) ? u : otherwise;
}
glm::vec3 corrected(const glm::vec3& normal) {
    return unit(normal, glm::vec3(0.0F, 1.0F, 0.0F));
}
glm::vec4 corrected(const glm::vec4& tangent) {
    const glm::vec3 along = unit(glm::vec3(tangent), glm::vec3(1.0F, 0.0F, 0.0F));
    return glm::vec4(along, tangent.w < 0.0F ? -1.0F : 1.0F);
}

template <typename Vector>
void write_directions(std::span<const Vector> items, const GltfBytes& write) {
    const auto valid = [](const Vector& v) { return is_valid(v); };
    std::vector<Vector> corrected_chunk;
    // Correct items go out uncopied.
    while (!items.empty()) {
        const auto first_invalid = std::find_if_not(items.begin(), items.end(), valid);
        const auto valid_count = static_cast<std::size_t>(first_invalid - items.begin());
        write(std::as_bytes(items.first(valid_count)));
        items = items.subspan(valid_count);
        if (!items.empty()) {
            const std::span<const Vector> chunk = items.first(std::min(kChunk, items.size()));
            corrected_chunk.assign(chunk.begin(), chunk.end());
            for (Vector& v : corrected_chunk) {
                v = is_valid(v) ? v : corrected(v);
            }
            write(std::as_bytes(std::span<const Vector>(corrected_chunk)));
            items = items.subspan(chunk.size());
        }
    }
}

std::uint8_t linear_byte(float value) {
    return static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(value, 0.0F, 1.0F)));
}

void write_colours(const Mesh& mesh, const GltfBytes& write) {
    std::vector<ColourBytes> palette;
    std::vector<ColourBytes> chunk;
    for (std::size_t first = 0; first < mesh.colours.size(); first += kChunk) {
        const std::size_t end = std::min(first + kChunk, mesh.colours.size());
        chunk.clear();
        for (std::size_t i = first; i < end; ++i) {
            const std::uint32_t index = mesh.colours[i];
            while (palette.size() <= index) {
                const glm::vec3 c = palette_colour(static_cast<std::uint32_t>(palette.size()));
                palette.push_back({linear_byte(c.r), linear_byte(c.g), linear_byte(c.b), 255});
            }
            chunk.push_back(palette[index]);
        }
        write(std::as_bytes(std::span<const ColourBytes>(chunk)));
    }
}

void write_wind(const Mesh& mesh,
                const WindData& wind,
                glm::vec2 WindVertex::*member,
                const GltfBytes& write) {
    std::vector<glm::vec2> chunk;
    for (std::size_t first = 0; first < mesh.positions.size(); first += kChunk) {
        chunk.clear();
        const std::size_t end = std::min(first + kChunk, mesh.positions.size());
        for (std::size_t i = first; i < end; ++i) {
            chunk.push_back(wind.at(mesh.segments[i], mesh.positions[i]).*member);
        }
        write(std::as_bytes(std::span<const glm::vec2>(chunk)));
    }
}

} // namespace

std::size_t GltfData::first_view(GltfArray array) const {
    const auto found = std::find_if(views.begin(), views.end(),
                                    [array](const GltfView& view) { return view.array == array; });
    return static_cast<std::size_t>(found - views.begin());
}

GltfData plan_gltf_data(const Mesh& mesh,
                        const GltfMotion* motion,
                        const WindData* wind,
                        std::vector<std::string> images) {
    GltfData data;
    data.images = std::move(images);
    bool any_coloured = false;
    for (const MeshPart& part : mesh.parts) {
        data.coloured.push_back(is_coloured(mesh, part));
        any_coloured = any_coloured || data.coloured.back();
    }
    const auto add = [&data](GltfArray array, std::uint64_t bytes, std::size_t image) {
        data.views.push_back({array, data.bytes, bytes, image});
        data.bytes += (bytes + 3) / 4 * 4;
    };
    const std::uint64_t vertices = mesh.positions.size();
    add(GltfArray::Positions, vertices * sizeof(glm::vec3), 0);
    add(GltfArray::Normals, vertices * sizeof(glm::vec3), 0);
    if (is_complete(mesh, mesh.texture_coordinates)) {
        add(GltfArray::TextureCoordinates, vertices * sizeof(glm::vec2), 0);
    }
    if (is_complete(mesh, mesh.tangents)) {
        add(GltfArray::Tangents, vertices * sizeof(glm::vec4), 0);
    }
    if (any_coloured) {
        add(GltfArray::Colours, vertices * sizeof(ColourBytes), 0);
    }
    if (motion != nullptr) {
        add(GltfArray::Joints, vertices * 4 * motion->joint_bytes(), 0);
        add(GltfArray::Weights, vertices * 4, 0);
    }
    if (wind != nullptr) {
        add(GltfArray::WindPivots, vertices * sizeof(glm::vec2), 0);
        add(GltfArray::WindMotions, vertices * sizeof(glm::vec2), 0);
    }
    add(GltfArray::Indices, mesh.indices.size() * sizeof(std::uint32_t), 0);
    if (motion != nullptr) {
        add(GltfArray::InverseBinds, motion->joint_count() * sizeof(glm::mat4), 0);
        if (motion->time_count() > 0) {
            add(GltfArray::Times, motion->time_count() * sizeof(float), 0);
        }
        if (motion->translation_count() > 0) {
            add(GltfArray::Translations, motion->translation_count() * sizeof(glm::vec3), 0);
        }
        if (motion->rotation_count() > 0) {
            add(GltfArray::Rotations, motion->rotation_count() * sizeof(glm::quat), 0);
        }
    }
    for (std::size_t i = 0; i < data.images.size(); ++i) {
        add(GltfArray::Image, data.images[i].size(), i);
    }
    return data;
}

void write_gltf_data(const Mesh& mesh,
                     const GltfMotion* motion,
                     const WindData* wind,
                     const GltfData& data,
                     const GltfBytes& write) {
    for (const GltfView& view : data.views) {
        switch (view.array) {
        case GltfArray::Positions:
            write(std::as_bytes(std::span(mesh.positions)));
            break;
        case GltfArray::Normals:
            write_directions(std::span<const glm::vec3>(mesh.normals), write);
            break;
        case GltfArray::TextureCoordinates:
            write(std::as_bytes(std::span(mesh.texture_coordinates)));
            break;
        case GltfArray::Tangents:
            write_directions(std::span<const glm::vec4>(mesh.tangents), write);
            break;
        case GltfArray::Colours:
            write_colours(mesh, write);
            break;
        case GltfArray::Joints:
            write_vertex_joints(mesh, *motion, write);
            break;
        case GltfArray::Weights:
            write_vertex_weights(mesh, *motion, write);
            break;
        case GltfArray::WindPivots:
            write_wind(mesh, *wind, &WindVertex::pivot, write);
            break;
        case GltfArray::WindMotions:
            write_wind(mesh, *wind, &WindVertex::motion, write);
            break;
        case GltfArray::InverseBinds:
            write_inverse_binds(*motion, write);
            break;
        case GltfArray::Times:
            write_times(*motion, write);
            break;
        case GltfArray::Translations:
            write_translations(*motion, write);
            break;
        case GltfArray::Rotations:
            write_rotations(*motion, write);
            break;
        case GltfArray::Indices:
            for_each_chunk(mesh.indices,
                           [&](std::uint64_t, auto part) { write(std::as_bytes(part)); });
            break;
        case GltfArray::Image: {
            std::string padded = data.images[view.image];
            padded.resize((padded.size() + 3) / 4 * 4, '\0');
            write(std::as_bytes(std::span(padded)));
            break;
        }
        }
    }
}

} // namespace lsys
