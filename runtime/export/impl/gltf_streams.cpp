#include "runtime/export/impl/gltf_streams.h"

#include "runtime/base/workers.h"
#include "runtime/export/impl/formats.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <meshoptimizer.h>
#include <new>
#include <utility>

namespace lsys {

static_assert(std::endian::native == std::endian::little,
              "arrays are written as they lie in memory");

namespace {

constexpr std::size_t kChunk = 16384; // vertices

// Bits of a position. Readers decode 16 bits into as many bytes as 14, but compressed they take
// more.
constexpr unsigned kPositionBits = 16;
constexpr unsigned kCompressedPositionBits = 14;
// Bits of a texture coordinate: the fewest that keep a step within half a texel of our pictures,
// which are 256 texels wide. Floats where 16 bits leave steps of more than 4 texels.
constexpr unsigned kMinTextureBits = 12;
constexpr unsigned kMaxTextureBits = 16;
constexpr float kMaxTextureStep = 1.0F / 512.0F;
constexpr float kMaxCoarseTextureStep = 4.0F / 256.0F;

template <typename T, std::size_t count>
using Item = std::array<T, count>;

float max_value(unsigned bits) {
    return static_cast<float>((1U << bits) - 1U);
}

/// Rounds half up, the same on any machine.
std::uint16_t rounded(float value, float most) {
    return static_cast<std::uint16_t>(std::clamp(std::floor(value + 0.5F), 0.0F, most));
}

std::uint8_t linear_byte(float value) {
    return static_cast<std::uint8_t>(rounded(255.0F * value, 255.0F));
}

/// A component of a direction as a signed normalised byte.
std::int8_t signed_byte(float value) {
    const float scaled = std::floor(127.0F * std::clamp(value, -1.0F, 1.0F) + 0.5F);
    return static_cast<std::int8_t>(scaled);
}

std::uint16_t quantized_position(float value, float low, float step, float most) {
    // In double, because floats round both the difference and the quotient.
    const double item =
        (static_cast<double>(value) - static_cast<double>(low)) / static_cast<double>(step);
    return static_cast<std::uint16_t>(
        std::clamp(std::floor(item + 0.5), 0.0, static_cast<double>(most)));
}

unsigned position_bits(ExportCompression compression) {
    return compression == ExportCompression::Meshopt ? kCompressedPositionBits : kPositionBits;
}

Item<std::uint16_t, 4> position_item(const GltfStreams& streams, const glm::vec3& position) {
    const float most = max_value(position_bits(streams.compression));
    const auto item = [&](int axis) {
        return quantized_position(position[axis], streams.low[axis], streams.step, most);
    };
    return {item(0), item(1), item(2), 0};
}

Item<std::uint16_t, 2> texture_item(const GltfTextureForm& form, const glm::vec2& coordinates) {
    const float most = max_value(form.bits);
    const auto item = [&](int axis) {
        const float part = (coordinates[axis] - form.low[axis]) / form.extent[axis];
        const std::uint16_t steps = rounded(most * part, most);
        if (form.transform) {
            return steps;
        }
        // All 16 bits, so that the highest step is 1.
        return rounded(static_cast<float>(steps) * 65535.0F / most, 65535.0F);
    };
    return {item(0), item(1)};
}

GltfTextureForm plan_texture_form(const Mesh& mesh, std::span<const std::uint32_t> vertices) {
    glm::vec2 low = mesh.texture_coordinates[vertices.front()];
    glm::vec2 high = low;
    for (const std::uint32_t vertex : vertices) {
        low = glm::min(low, mesh.texture_coordinates[vertex]);
        high = glm::max(high, mesh.texture_coordinates[vertex]);
    }
    GltfTextureForm form;
    form.bits = kMinTextureBits;
    if (low.x >= 0.0F && low.y >= 0.0F && high.x <= 1.0F && high.y <= 1.0F) {
        form.quantized = true;
        return form;
    }
    const glm::vec2 extent = high - low;
    const float most = std::max(extent.x, extent.y);
    while (form.bits < kMaxTextureBits && most > kMaxTextureStep * max_value(form.bits)) {
        ++form.bits;
    }
    form.quantized = most <= kMaxCoarseTextureStep * max_value(form.bits);
    if (!form.quantized) {
        return form;
    }
    form.low = low;
    form.extent = {extent.x > 0.0F ? extent.x : 1.0F, extent.y > 0.0F ? extent.y : 1.0F};
    form.transform = {low, form.extent * (65535.0F / max_value(form.bits))};
    return form;
}

/// Writes an item of `item_of` for each vertex.
template <typename ItemOf>
void write_items(std::span<const std::uint32_t> vertices,
                 const GltfBytes& write,
                 const ItemOf& item_of) {
    using T = decltype(item_of(std::uint32_t{0}));
    std::vector<T> chunk;
    for (std::size_t first = 0; first < vertices.size(); first += kChunk) {
        const auto part = vertices.subspan(first, std::min(kChunk, vertices.size() - first));
        chunk.clear();
        for (const std::uint32_t vertex : part) {
            chunk.push_back(item_of(vertex));
        }
        write(std::as_bytes(std::span<const T>(chunk)));
    }
}

void write_colours(const Mesh& mesh,
                   const GltfStreams& streams,
                   const GltfPrimitive& primitive,
                   const GltfBytes& write) {
    const auto item = [](const glm::vec3& c) {
        return Item<std::uint8_t, 4>{linear_byte(c.r), linear_byte(c.g), linear_byte(c.b), 255};
    };
    for (const GltfPart& part : primitive.parts) {
        const auto vertices =
            std::span(streams.primitives.vertices).subspan(part.first_vertex, part.vertex_count);
        if (primitive.colours == GltfColours::Material) {
            const Material& material = mesh.materials[mesh.parts[part.part].material];
            const auto colour = item(glm::vec3(material.colour) / primitive.colour);
            write_items(vertices, write, [&](std::uint32_t) { return colour; });
            continue;
        }
        std::vector<Item<std::uint8_t, 4>> palette;
        write_items(vertices, write, [&](std::uint32_t vertex) {
            const std::uint32_t index = mesh.colours[vertex];
            while (palette.size() <= index) {
                palette.push_back(item(palette_colour(static_cast<std::uint32_t>(palette.size()))));
            }
            return palette[index];
        });
    }
}

template <typename Index>
void write_indices(const Mesh& mesh,
                   const GltfStreams& streams,
                   const GltfPrimitive& primitive,
                   const GltfBytes& write) {
    std::vector<Index> chunk;
    for_each_index(mesh, streams.primitives, primitive, [&](std::span<const std::uint32_t> part) {
        chunk.resize(part.size());
        std::transform(part.begin(), part.end(), chunk.begin(),
                       [](std::uint32_t index) { return static_cast<Index>(index); });
        write(std::as_bytes(std::span<const Index>(chunk)));
    });
}

/// Writes the items of a stream of a primitive, uncompressed and without padding behind them.
void write_primitive_stream(const Mesh& mesh,
                            const GltfMotion* motion,
                            const GltfStreams& streams,
                            const GltfStream& stream,
                            const GltfBytes& write) {
    const GltfPrimitive& primitive = streams.primitives.list[stream.item];
    const std::span<const std::uint32_t> vertices = streams.primitives.vertices_of(primitive);
    const bool quantized = streams.quantized();
    switch (stream.array) {
    case GltfArray::Positions:
        if (quantized) {
            write_items(vertices, write, [&](std::uint32_t vertex) {
                return position_item(streams, mesh.positions[vertex]);
            });
        } else {
            write_items(vertices, write,
                        [&](std::uint32_t vertex) { return mesh.positions[vertex]; });
        }
        break;
    case GltfArray::Normals:
        if (quantized) {
            write_items(vertices, write, [&](std::uint32_t vertex) {
                const glm::vec3 n = valid_normal(mesh.normals[vertex]);
                return Item<std::int8_t, 4>{signed_byte(n.x), signed_byte(n.y), signed_byte(n.z)};
            });
        } else {
            write_items(vertices, write,
                        [&](std::uint32_t vertex) { return valid_normal(mesh.normals[vertex]); });
        }
        break;
    case GltfArray::TextureCoordinates:
        if (const GltfTextureForm& form = streams.texture_forms[stream.item]; form.quantized) {
            write_items(vertices, write, [&](std::uint32_t vertex) {
                return texture_item(form, mesh.texture_coordinates[vertex]);
            });
        } else {
            write_items(vertices, write,
                        [&](std::uint32_t vertex) { return mesh.texture_coordinates[vertex]; });
        }
        break;
    case GltfArray::Tangents:
        if (quantized) {
            write_items(vertices, write, [&](std::uint32_t vertex) {
                const glm::vec4 t = valid_tangent(mesh.tangents[vertex]);
                return Item<std::int8_t, 4>{signed_byte(t.x), signed_byte(t.y), signed_byte(t.z),
                                            signed_byte(t.w)};
            });
        } else {
            write_items(vertices, write,
                        [&](std::uint32_t vertex) { return valid_tangent(mesh.tangents[vertex]); });
        }
        break;
    case GltfArray::Colours:
        write_colours(mesh, streams, primitive, write);
        break;
    case GltfArray::Joints:
        write_vertex_joints(mesh, vertices, *motion, write);
        break;
    case GltfArray::Weights:
        write_vertex_weights(mesh, vertices, *motion, write);
        break;
    default:
        if (stream.component == kGltfShort) {
            write_indices<std::uint16_t>(mesh, streams, primitive, write);
        } else {
            write_indices<std::uint32_t>(mesh, streams, primitive, write);
        }
        break;
    }
}

/// Turns the items of positions into positions.
glm::mat4 decoding_of(const GltfStreams& streams) {
    glm::mat4 matrix(1.0F);
    if (streams.step > 0.0F) {
        matrix[0][0] = matrix[1][1] = matrix[2][2] = streams.step;
        matrix[3] = glm::vec4(streams.low, 1.0F);
    }
    return matrix;
}

/// Gives the stream its size, and a place in the buffer unless that needs its compressed bytes.
class Planner {
public:
    Planner(GltfStreams& streams, const Mesh& mesh, const GltfMotion* motion)
        : streams_(streams), mesh_(mesh), motion_(motion) {}

    void add_primitive(std::size_t number, bool relief, bool textured) {
        const GltfPrimitive& primitive = streams_.primitives.list[number];
        const std::uint64_t count = primitive.vertex_count;
        const bool quantized = streams_.quantized();
        const auto add = [&](GltfArray array, int component, const char* type,
                             std::uint32_t stride) -> GltfStream& {
            GltfStream& stream = streams_.list.emplace_back();
            stream.array = array;
            stream.item = number;
            stream.component = component;
            stream.type = type;
            stream.stride = stride;
            stream.count = count;
            return stream;
        };
        if (quantized) {
            add(GltfArray::Positions, kGltfShort, "VEC3", 8).padded = true;
            GltfStream& normals = add(GltfArray::Normals, kGltfSignedByte, "VEC3", 4);
            normals.padded = true;
            normals.normalized = true;
        } else {
            add(GltfArray::Positions, kGltfFloat, "VEC3", 12);
            add(GltfArray::Normals, kGltfFloat, "VEC3", 12);
        }
        GltfTextureForm& form = streams_.texture_forms.emplace_back();
        // Quantised files are for display: coordinates without a texture are left out.
        if (is_complete(mesh_, mesh_.texture_coordinates) && (textured || relief || !quantized)) {
            if (quantized) {
                form = plan_texture_form(mesh_, streams_.primitives.vertices_of(primitive));
            }
            add(GltfArray::TextureCoordinates, form.quantized ? kGltfShort : kGltfFloat, "VEC2",
                form.quantized ? 4 : 8)
                .normalized = form.quantized;
        }
        if (relief && is_complete(mesh_, mesh_.tangents)) {
            add(GltfArray::Tangents, quantized ? kGltfSignedByte : kGltfFloat, "VEC4",
                quantized ? 4 : 16)
                .normalized = quantized;
        }
        if (primitive.colours != GltfColours::None) {
            add(GltfArray::Colours, kGltfByte, "VEC4", 4).normalized = true;
        }
        if (motion_ != nullptr) {
            const bool wide = motion_->joint_bytes() == 2;
            add(GltfArray::Joints, wide ? kGltfShort : kGltfByte, "VEC4", wide ? 8 : 4);
            add(GltfArray::Weights, kGltfByte, "VEC4", 4).normalized = true;
        }
        // The highest 16-bit index restarts strips.
        const bool narrow = count <= 65535;
        GltfStream& indices =
            add(GltfArray::Indices, narrow ? kGltfShort : kGltfInteger, "SCALAR", narrow ? 2 : 4);
        indices.count = primitive.index_count;
    }

    void add_motion() {
        const auto add = [this](GltfArray array, std::uint32_t stride, std::uint64_t count) {
            GltfStream& stream = streams_.list.emplace_back();
            stream.array = array;
            stream.stride = stride;
            stream.count = count;
        };
        const std::uint64_t frames = motion_->poses.frame_count;
        const std::uint64_t keys = frames * motion_->moving_joints();
        add(GltfArray::InverseBinds, sizeof(glm::mat4), motion_->skin.joint_count());
        add(GltfArray::Times, sizeof(float), frames);
        if (keys > 0) {
            add(GltfArray::Translations, sizeof(glm::vec3), keys);
            add(GltfArray::Rotations, sizeof(glm::quat), keys);
        }
    }

    void compress(std::uint32_t threads) {
        meshopt_encodeIndexVersion(1); // the one that the extension has
        meshopt_encodeVertexVersion(0);
        Workers workers(threads);
        workers.for_each(streams_.first_motion,
                         [this](std::uint64_t i) { compress(streams_.list[i]); });
    }

    void place() {
        for (std::size_t i = 0; i < streams_.list.size(); ++i) {
            GltfStream& stream = streams_.list[i];
            stream.offset = streams_.bytes;
            stream.bytes = stream.decoded_bytes();
            if (stream.array == GltfArray::Image) {
                stream.bytes = streams_.images[stream.item].size();
            } else if (!stream.compressed.empty()) {
                stream.bytes = stream.compressed.size();
                stream.decoded_offset = streams_.decoded_bytes;
                streams_.decoded_bytes += (stream.decoded_bytes() + 3) / 4 * 4;
            }
            streams_.bytes += (stream.bytes + 3) / 4 * 4;
        }
    }

private:
    void compress(GltfStream& stream) {
        std::string items;
        items.reserve(stream.decoded_bytes());
        write_primitive_stream(
            mesh_, motion_, streams_, stream, [&items](std::span<const std::byte> bytes) {
                items.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
            });
        std::string& to = stream.compressed;
        const auto bytes = [&to] { return reinterpret_cast<unsigned char*>(to.data()); };
        if (stream.array != GltfArray::Indices) {
            to.resize(meshopt_encodeVertexBufferBound(stream.count, stream.stride));
            to.resize(meshopt_encodeVertexBuffer(bytes(), to.size(), items.data(), stream.count,
                                                 stream.stride));
            return;
        }
        LargeVector<unsigned> indices(stream.count);
        if (stream.stride == 2) {
            for (std::size_t i = 0; i < stream.count; ++i) {
                std::uint16_t index = 0;
                std::memcpy(&index, items.data() + 2 * i, sizeof index);
                indices[i] = index;
            }
        } else {
            std::memcpy(indices.data(), items.data(), items.size());
        }
        const std::uint64_t vertices = streams_.primitives.list[stream.item].vertex_count;
        to.resize(meshopt_encodeIndexBufferBound(stream.count, vertices));
        to.resize(meshopt_encodeIndexBuffer(bytes(), to.size(), indices.data(), stream.count));
    }

    GltfStreams& streams_;
    const Mesh& mesh_;
    const GltfMotion* motion_;
};

struct Attribute {
    GltfArray array;
    std::string_view name;
};
constexpr std::array<Attribute, 7> kAttributes{{
    {GltfArray::Positions, "POSITION"},
    {GltfArray::Normals, "NORMAL"},
    {GltfArray::TextureCoordinates, "TEXCOORD_0"},
    {GltfArray::Tangents, "TANGENT"},
    {GltfArray::Colours, "COLOR_0"},
    {GltfArray::Joints, "JOINTS_0"},
    {GltfArray::Weights, "WEIGHTS_0"},
}};

} // namespace

GltfStreams plan_gltf_streams(const Mesh& mesh,
                              const GltfMotion* motion,
                              const Pictures& pictures,
                              std::vector<std::string> images,
                              const ExportInfo& info) {
    GltfStreams streams;
    streams.primitives = plan_gltf_primitives(mesh);
    streams.compression = info.compression;
    streams.images = std::move(images);
    if (streams.quantized()) {
        const Bounds bounds = streams.primitives.bounds();
        const glm::vec3 extent = bounds.high - bounds.low;
        const float most = std::max({extent.x, extent.y, extent.z});
        streams.low = bounds.low;
        streams.step = most > 0.0F ? most / max_value(position_bits(info.compression)) : 1.0F;
    }
    Planner planner(streams, mesh, motion);
    for (std::size_t i = 0; i < streams.primitives.list.size(); ++i) {
        const GltfPart& part = streams.primitives.list[i].parts.front();
        const MaterialPictures& shown = pictures.of_materials[mesh.parts[part.part].material];
        planner.add_primitive(i, shown.relief.has_value(), shown.colour.has_value());
    }
    streams.first_motion = streams.list.size();
    if (motion != nullptr) {
        planner.add_motion();
    }
    streams.first_image = streams.list.size();
    for (std::size_t i = 0; i < streams.images.size(); ++i) {
        GltfStream& stream = streams.list.emplace_back();
        stream.array = GltfArray::Image;
        stream.item = i;
    }
    if (info.compression == ExportCompression::Meshopt) {
        planner.compress(info.threads);
    }
    planner.place();
    return streams;
}

void write_gltf_streams(const Mesh& mesh,
                        const GltfMotion* motion,
                        const GltfStreams& streams,
                        const GltfSink& write) {
    std::uint64_t written = 0;
    bool stopped = false;
    const GltfBytes put = [&](std::span<const std::byte> bytes) {
        written += bytes.size();
        stopped = stopped || !write(bytes);
    };
    for (const GltfStream& stream : streams.list) {
        switch (stream.array) {
        case GltfArray::InverseBinds:
            write_inverse_binds(*motion, decoding_of(streams), put);
            break;
        case GltfArray::Times:
            write_times(*motion, put);
            break;
        case GltfArray::Translations:
            write_translations(*motion, put);
            break;
        case GltfArray::Rotations:
            write_rotations(*motion, put);
            break;
        case GltfArray::Image:
            put(std::as_bytes(std::span(streams.images[stream.item])));
            break;
        default:
            if (!stream.compressed.empty()) {
                put(std::as_bytes(std::span(stream.compressed)));
            } else {
                write_primitive_stream(mesh, motion, streams, stream, put);
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

std::string_view attribute_name(GltfArray array) {
    return kAttributes[static_cast<std::size_t>(array)].name;
}

void put_stream_view(JsonWriter& json, const GltfStream& stream) {
    constexpr int kVertices = 34962;
    constexpr int kIndices = 34963;
    const bool compressed = !stream.compressed.empty();
    const bool indices = stream.array == GltfArray::Indices;
    json.object().member("buffer", compressed ? 1 : 0);
    json.member("byteOffset", compressed ? stream.decoded_offset : stream.offset);
    json.member("byteLength", compressed ? stream.decoded_bytes() : stream.bytes);
    if (stream.padded) {
        json.member("byteStride", stream.stride);
    }
    if (stream.array <= GltfArray::Indices) {
        json.member("target", indices ? kIndices : kVertices);
    }
    if (compressed) {
        json.object("extensions").object("EXT_meshopt_compression").member("buffer", 0);
        json.member("byteOffset", stream.offset).member("byteLength", stream.bytes);
        json.member("byteStride", stream.stride).member("count", stream.count);
        json.member("mode", indices ? "TRIANGLES" : "ATTRIBUTES").end().end();
    }
    json.end();
}

void put_stream_accessor(JsonWriter& json,
                         const GltfStreams& streams,
                         const GltfStream& stream,
                         std::size_t view) {
    begin_accessor(json, {view, {}, stream.component, stream.count, stream.type});
    if (stream.array == GltfArray::Positions) {
        const Bounds& bounds = streams.primitives.list[stream.item].bounds;
        if (streams.quantized()) {
            const auto low = position_item(streams, bounds.low);
            const auto high = position_item(streams, bounds.high);
            json.member("min", {low[0], low[1], low[2]});
            json.member("max", {high[0], high[1], high[2]});
        } else {
            // Digits of doubles: readers parse the shortest text of a float as another double.
            const glm::dvec3 low(bounds.low);
            const glm::dvec3 high(bounds.high);
            json.member("min", {low.x, low.y, low.z}).member("max", {high.x, high.y, high.z});
        }
    }
    if (stream.normalized) {
        json.member("normalized", true);
    }
    json.end();
}

} // namespace lsys
