// SPDX-License-Identifier: MIT
#include "runtime/export/impl/gltf_streams.h"

#include "runtime/base/workers.h"
#include "runtime/export/impl/formats.h"
#include "runtime/export/tile_document.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace lsys {

namespace {

/// The form of the texture coordinates of some vertices.
GltfTextureForm plan_texture_form(const Mesh& mesh,
                                  std::span<const std::uint32_t> vertices,
                                  ExportCompression compression) {
    glm::vec2 low = mesh.texture_coordinates[vertices.front()];
    glm::vec2 high = low;
    for (const std::uint32_t vertex : vertices) {
        low = glm::min(low, mesh.texture_coordinates[vertex]);
        high = glm::max(high, mesh.texture_coordinates[vertex]);
    }
    return texture_form_of(compression, low, high);
}

/// Colours of the materials of a primitive's parts.
void write_material_colours(const Mesh& mesh,
                            const GltfPrimitives& primitives,
                            const GltfPrimitive& primitive,
                            const GltfBytes& write) {
    for (const GltfPart& part : primitive.parts) {
        const auto vertices =
            std::span(primitives.vertices).subspan(part.first_vertex, part.vertex_count);
        const Material& material = mesh.materials[mesh.parts[part.part].material];
        const auto colour = colour_item(glm::vec3(material.colour) / primitive.colour);
        write_each(vertices, write, [&](std::uint32_t) { return colour; });
    }
}

template <typename Index>
void write_indices(const Mesh& mesh,
                   const GltfBufferPlan& buffer,
                   const GltfPrimitive& primitive,
                   const GltfBytes& write) {
    std::vector<Index> chunk;
    for_each_index(mesh, buffer.primitives, primitive, [&](std::span<const std::uint32_t> part) {
        chunk.resize(part.size());
        std::transform(part.begin(), part.end(), chunk.begin(),
                       [](std::uint32_t index) { return static_cast<Index>(index); });
        write(std::as_bytes(std::span<const Index>(chunk)));
    });
}

/// The displacement of a vertex from the last frame of its shape to an earlier one.
glm::vec3 position_change(const GltfPlant& plant,
                          const MeshFilm::Shape& shape,
                          std::uint32_t frame,
                          std::uint32_t vertex) {
    return shape.earlier[frame].positions[vertex - shape.first_vertex] -
           plant.mesh.positions[vertex];
}

/// Writes the items of a stream of a primitive, uncompressed and without padding at the end.
void write_primitive_stream(const GltfPlant& plant,
                            const GltfBufferPlan& buffer,
                            const GltfStream& stream,
                            const GltfBytes& write) {
    const Mesh& mesh = plant.mesh;
    const GltfPrimitive& primitive = buffer.primitives.list[stream.index];
    const GltfForm& form = buffer.forms[stream.index];
    const std::span<const std::uint32_t> vertices = buffer.primitives.vertices_of(primitive);
    switch (stream.array) {
    case GltfArray::Joints:
        write_vertex_joints(mesh, vertices, *plant.motion, write);
        break;
    case GltfArray::Weights:
        write_vertex_weights(mesh, vertices, *plant.motion, write);
        break;
    case GltfArray::WindPivots:
    case GltfArray::WindMotions:
        write_wind_items(mesh, vertices, stream.array, form, *plant.wind, write);
        break;
    case GltfArray::PositionChanges: {
        const MeshFilm::Shape& shape = plant.film->shapes[primitive.shape];
        write_each(vertices, write, [&](std::uint32_t vertex) {
            return position_change(plant, shape, stream.frame, vertex);
        });
        break;
    }
    case GltfArray::NormalChanges: {
        const MeshFilm::Shape& shape = plant.film->shapes[primitive.shape];
        const LargeVector<glm::vec3>& normals = shape.earlier[stream.frame].normals;
        write_each(vertices, write, [&](std::uint32_t vertex) {
            return valid_normal(normals[vertex - shape.first_vertex]) -
                   valid_normal(mesh.normals[vertex]);
        });
        break;
    }
    case GltfArray::Indices:
        if (stream.type.component == kGltfUnsignedShort) {
            write_indices<std::uint16_t>(mesh, buffer, primitive, write);
        } else {
            write_indices<std::uint32_t>(mesh, buffer, primitive, write);
        }
        break;
    case GltfArray::Colours:
        if (primitive.colours == GltfColours::Material) {
            write_material_colours(mesh, buffer.primitives, primitive, write);
            break;
        }
        [[fallthrough]];
    default:
        write_items(mesh, vertices, stream.array, form, write);
        break;
    }
}

/// Gives the streams their sizes and their offsets in the buffer.
class Planner {
public:
    Planner(GltfBufferPlan& buffer, const GltfPlant& plant) : buffer_(buffer), plant_(plant) {}

    void add_primitive(std::size_t number, bool normal_map, bool textured) {
        const Mesh& mesh = plant_.mesh;
        const GltfPrimitive& primitive = buffer_.primitives.list[number];
        GltfForm& form = buffer_.forms[number];
        const auto add = [&](GltfArray array) {
            buffer_.streams.push_back({.array = array,
                                       .index = number,
                                       .type = item_of(array, form),
                                       .count = primitive.vertex_count});
        };
        add(GltfArray::Positions);
        add(GltfArray::Normals);
        // Quantised files are for display: coordinates without a texture are left out or, if wind
        // data follow, written as 0, because sets of coordinates are numbered from 0 on.
        const bool shown = textured || normal_map;
        if (is_complete(mesh, mesh.texture_coordinates) &&
            (shown || plant_.wind != nullptr || !form.quantized())) {
            if (form.quantized() && shown) {
                form.texture = plan_texture_form(mesh, buffer_.primitives.vertices_of(primitive),
                                                 form.compression);
            } else if (form.quantized()) {
                form.texture.quantized = true;
            }
            add(GltfArray::TextureCoordinates);
        }
        if (normal_map && is_complete(mesh, mesh.tangents)) {
            add(GltfArray::Tangents);
        }
        if (primitive.colours != GltfColours::None) {
            add(GltfArray::Colours);
        }
        if (plant_.motion != nullptr) {
            add(GltfArray::Joints);
            if (plant_.motion->joint_bytes() == 2) {
                GltfItem& joints = buffer_.streams.back().type;
                joints.component = kGltfUnsignedShort;
                joints.stride = 8;
            }
            add(GltfArray::Weights);
        }
        if (plant_.wind != nullptr) {
            add(GltfArray::WindPivots);
            add(GltfArray::WindMotions);
        }
        if (plant_.has_item_numbers) {
            add(GltfArray::Items);
        }
        if (plant_.film != nullptr) {
            add_morph_targets(number);
        }
        add(GltfArray::Indices);
        GltfStream& indices = buffer_.streams.back();
        indices.type = primitive.vertex_count <= kMaxNarrowVertices
                           ? GltfItem{kGltfUnsignedShort, "SCALAR", false, 2}
                           : GltfItem{kGltfUnsignedInt, "SCALAR", false, 4};
        indices.count = primitive.index_count;
    }

    void add_motion() {
        const GltfMotion& motion = *plant_.motion;
        add_animation(GltfArray::InverseBinds, sizeof(glm::mat4), motion.joint_count());
        add_animation(GltfArray::Times, sizeof(float), motion.time_count());
        add_animation(GltfArray::Translations, sizeof(glm::vec3), motion.translation_count());
        add_animation(GltfArray::Rotations, sizeof(glm::quat), motion.rotation_count());
    }

    void add_film() {
        const GltfFilmCounts counts = count_film_items(*plant_.film);
        add_animation(GltfArray::Times, sizeof(float), counts.times);
        add_animation(GltfArray::Scales, sizeof(glm::vec3), counts.scales);
        add_animation(GltfArray::MorphWeights, sizeof(float), counts.weights);
    }

    void compress(std::uint32_t threads) {
        Workers workers(threads);
        workers.for_each(buffer_.first_motion,
                         [this](std::uint64_t i) { compress(buffer_.streams[i]); });
    }

    void place() {
        for (std::size_t i = 0; i < buffer_.streams.size(); ++i) {
            GltfStream& stream = buffer_.streams[i];
            stream.offset = buffer_.bytes;
            stream.bytes = stream.decoded_bytes();
            if (stream.array == GltfArray::Image) {
                stream.bytes = buffer_.images[stream.index].size();
            } else if (!stream.compressed.empty()) {
                stream.bytes = stream.compressed.size();
                stream.decoded_offset = buffer_.decoded_bytes;
                buffer_.decoded_bytes += (stream.decoded_bytes() + 3) / 4 * 4;
            }
            buffer_.bytes += (stream.bytes + 3) / 4 * 4;
        }
    }

private:
    void add_animation(GltfArray array, std::uint32_t item_bytes, std::uint64_t count) {
        if (count > 0) {
            GltfStream& stream = buffer_.streams.emplace_back();
            stream.array = array;
            stream.type.stride = item_bytes;
            stream.count = count;
        }
    }

    void add_morph_targets(std::size_t number) {
        const GltfPrimitive& primitive = buffer_.primitives.list[number];
        const MeshFilm::Shape& shape = plant_.film->shapes[primitive.shape];
        const GltfItem vector{kGltfFloat, "VEC3", false, sizeof(glm::vec3)};
        for (std::uint32_t frame = 0; frame < shape.earlier.size(); ++frame) {
            GltfStream stream;
            stream.array = GltfArray::PositionChanges;
            stream.index = number;
            stream.frame = frame;
            stream.type = vector;
            stream.count = primitive.vertex_count;
            for (const std::uint32_t vertex : buffer_.primitives.vertices_of(primitive)) {
                stream.bounds.add(position_change(plant_, shape, frame, vertex));
            }
            buffer_.streams.push_back(stream);
            stream.array = GltfArray::NormalChanges;
            buffer_.streams.push_back(std::move(stream));
        }
    }

    void compress(GltfStream& stream) {
        const GltfPrimitive& primitive = buffer_.primitives.list[stream.index];
        if (stream.array != GltfArray::Indices) {
            const GltfBuffer items =
                written_items(stream.decoded_bytes(), [&](const GltfBytes& write) {
                    write_primitive_stream(plant_, buffer_, stream, write);
                });
            stream.compressed = compress_items(items, stream.type.stride);
        } else if (plant_.order != nullptr) {
            stream.compressed = plant_.order->indices;
        } else if (primitive.parts.size() == 1) {
            stream.compressed =
                compress_indices(primitive.parts.front().indices, primitive.vertex_count);
        } else {
            LargeVector<std::uint32_t> indices;
            indices.reserve(primitive.index_count);
            for_each_index(plant_.mesh, buffer_.primitives, primitive,
                           [&indices](std::span<const std::uint32_t> some) {
                               indices.insert(indices.end(), some.begin(), some.end());
                           });
            stream.compressed = compress_indices(indices, primitive.vertex_count);
        }
    }

    GltfBufferPlan& buffer_;
    const GltfPlant& plant_;
};

} // namespace

GltfBufferPlan plan_gltf_buffer(const GltfPlant& plant,
                                const Pictures& pictures,
                                std::vector<std::string> images,
                                const ExportInfo& info) {
    const Mesh& mesh = plant.mesh;
    GltfBufferPlan buffer;
    std::optional<GltfCompressionInput> compressed;
    if (info.compression == ExportCompression::Meshopt) {
        compressed.emplace(GltfCompressionInput{
            pictures, plant.motion != nullptr || plant.wind != nullptr || plant.has_item_numbers,
            plant.order});
    }
    buffer.primitives = plan_gltf_primitives(mesh, compressed, plant.film);
    buffer.images = std::move(images);
    buffer.forms.assign(buffer.primitives.list.size(),
                        form_of(info.compression, buffer.primitives.bounds()));
    Planner planner(buffer, plant);
    for (std::size_t i = 0; i < buffer.primitives.list.size(); ++i) {
        const GltfPart& part = buffer.primitives.list[i].parts.front();
        const MaterialPictures& shown = pictures.of_materials[mesh.parts[part.part].material];
        planner.add_primitive(i, shown.normal_map.has_value(), shown.colour.has_value());
    }
    buffer.first_motion = buffer.streams.size();
    if (plant.motion != nullptr) {
        planner.add_motion();
    }
    if (plant.film != nullptr) {
        planner.add_film();
    }
    buffer.first_image = buffer.streams.size();
    for (std::size_t i = 0; i < buffer.images.size(); ++i) {
        GltfStream& stream = buffer.streams.emplace_back();
        stream.array = GltfArray::Image;
        stream.index = i;
    }
    if (info.compression == ExportCompression::Meshopt) {
        planner.compress(info.threads);
    }
    planner.place();
    return buffer;
}

void write_gltf_streams(const GltfPlant& plant,
                        const GltfBufferPlan& buffer,
                        const GltfSink& write) {
    std::uint64_t written = 0;
    bool stopped = false;
    const GltfBytes put = [&](std::span<const std::byte> bytes) {
        written += bytes.size();
        stopped = stopped || !write(bytes);
    };
    for (const GltfStream& stream : buffer.streams) {
        switch (stream.array) {
        case GltfArray::InverseBinds:
            write_inverse_binds(*plant.motion, buffer.forms.front().decoding(), put);
            break;
        case GltfArray::Times:
            if (plant.film != nullptr) {
                write_film_times(*plant.film, put);
            } else {
                write_times(*plant.motion, put);
            }
            break;
        case GltfArray::Scales:
            write_film_scales(*plant.film, put);
            break;
        case GltfArray::MorphWeights:
            write_film_weights(*plant.film, put);
            break;
        case GltfArray::Translations:
            write_translations(*plant.motion, put);
            break;
        case GltfArray::Rotations:
            write_rotations(*plant.motion, put);
            break;
        case GltfArray::Image:
            put(std::as_bytes(std::span(buffer.images[stream.index])));
            break;
        default:
            if (!stream.compressed.empty()) {
                put(std::as_bytes(std::span(stream.compressed)));
            } else {
                write_primitive_stream(plant, buffer, stream, put);
            }
            break;
        }
        constexpr std::array<std::byte, 3> kPadding{};
        put(std::span(kPadding).first((4 - written % 4) % 4));
        if (stopped) {
            return;
        }
    }
}

void put_stream_view(JsonWriter& json, const GltfStream& stream) {
    constexpr int kArrayBuffer = 34962;
    constexpr int kElementArrayBuffer = 34963;
    const bool compressed = !stream.compressed.empty();
    const bool indices = stream.array == GltfArray::Indices;
    json.object().member("buffer", compressed ? 1 : 0);
    json.member("byteOffset", compressed ? stream.decoded_offset : stream.offset);
    json.member("byteLength", compressed ? stream.decoded_bytes() : stream.bytes);
    if (stream.type.padded) {
        json.member("byteStride", stream.type.stride);
    }
    if (stream.array <= GltfArray::Indices) {
        json.member("target", indices ? kElementArrayBuffer : kArrayBuffer);
    }
    if (compressed) {
        put_packed_view(json,
                        {stream.offset, stream.bytes, stream.type.stride, stream.count, indices});
    }
    json.end();
}

void put_stream_accessor(JsonWriter& json,
                         const GltfBufferPlan& buffer,
                         const GltfStream& stream,
                         std::size_t view) {
    begin_accessor(json, {view, {}, stream.type.component, stream.count, stream.type.type});
    if (stream.array == GltfArray::Positions || stream.array == GltfArray::PositionChanges) {
        const bool changes = stream.array == GltfArray::PositionChanges;
        put_position_bounds(json, buffer.forms[stream.index],
                            changes ? stream.bounds : buffer.primitives.list[stream.index].bounds);
    }
    if (stream.type.normalized) {
        json.member("normalized", true);
    }
    json.end();
}

} // namespace lsys
