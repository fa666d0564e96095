// SPDX-License-Identifier: MIT
#include "runtime/export/impl/gltf_items.h"

#include "runtime/meshing/looks.h"

#include <glm/common.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <meshoptimizer.h>

namespace lsys {

static_assert(std::endian::native == std::endian::little,
              "arrays are written as they lie in memory");

namespace {

// Bits of a coordinate of a position. 14 bits compress to fewer bytes than 16; decoded, a
// coordinate takes 2 bytes.
constexpr unsigned kPositionBits = 16;
constexpr unsigned kCompressedPositionBits = 14;
// Bits of a texture coordinate: the fewest that keep a step within half a texel of the built-in
// textures, which are 256 texels wide. Floats are used if 16 bits leave steps of over 4 texels.
constexpr unsigned kMinTextureBits = 12;
constexpr unsigned kMaxTextureBits = 16;
constexpr float kMaxTextureStep = 1.0F / 512.0F;
constexpr float kMaxCoarseTextureStep = 4.0F / 256.0F;

template <typename T, std::size_t count>
using Item = std::array<T, count>;

float max_value(unsigned bits) {
    return static_cast<float>((1U << bits) - 1U);
}

/// Rounds half up, with the same result on every machine. The clamped value is not negative, so a
/// cast rounds down; std::floor() is a function call on processors without SSE 4.1.
std::uint16_t rounded(float value, float highest) {
    return static_cast<std::uint16_t>(std::clamp(value + 0.5F, 0.0F, highest));
}

std::uint8_t linear_byte(float value) {
    return static_cast<std::uint8_t>(rounded(255.0F * value, 255.0F));
}

/// A component of a direction as a signed normalised byte.
std::int8_t signed_byte(float value) {
    const float scaled = 127.0F * std::clamp(value, -1.0F, 1.0F) + 0.5F;
    const int whole = static_cast<int>(scaled);
    return static_cast<std::int8_t>(scaled < static_cast<float>(whole) ? whole - 1 : whole);
}

unsigned position_bits(ExportCompression compression) {
    return compression == ExportCompression::Meshopt ? kCompressedPositionBits : kPositionBits;
}

/// Quantises positions. Computes in double, because floats round both the difference and the
/// quotient.
class PositionSteps {
public:
    explicit PositionSteps(const GltfForm& form)
        : low_(form.low), steps_(1.0 / static_cast<double>(form.step)),
          max_step_(static_cast<double>(max_value(position_bits(form.compression)))) {}

    [[nodiscard]] Item<std::uint16_t, 4> operator()(const glm::vec3& position) const {
        const glm::dvec3 item =
            glm::clamp((glm::dvec3(position) - low_) * steps_ + 0.5, glm::dvec3(0.0), max_step_);
        return {static_cast<std::uint16_t>(item.x), static_cast<std::uint16_t>(item.y),
                static_cast<std::uint16_t>(item.z), 0};
    }

private:
    glm::dvec3 low_;
    double steps_; // per unit of length
    glm::dvec3 max_step_;
};

/// Quantises texture coordinates.
class TextureSteps {
public:
    explicit TextureSteps(const GltfTextureForm& form)
        : low_(form.low), max_step_(form.bits == 0 ? 0.0F : max_value(form.bits)),
          steps_(max_step_ / form.extent), unit_(form.transform ? 1.0F : 65535.0F / max_step_),
          is_scaled_(!form.transform) {}

    [[nodiscard]] Item<std::uint16_t, 2> operator()(const glm::vec2& coordinates) const {
        if (max_step_ == 0.0F) {
            return {0, 0};
        }
        const glm::vec2 steps = (coordinates - low_) * steps_;
        return {item(steps.x), item(steps.y)};
    }

private:
    [[nodiscard]] std::uint16_t item(float steps) const {
        const std::uint16_t whole = rounded(steps, max_step_);
        // Without a transform the steps are scaled to 16 bits, so that the highest one reads as 1.
        return is_scaled_ ? rounded(static_cast<float>(whole) * unit_, 65535.0F) : whole;
    }

    glm::vec2 low_;
    float max_step_; // the highest step; 0: no texture is read
    glm::vec2 steps_;
    float unit_; // 16-bit value of a step
    bool is_scaled_;
};

void write_colours(const Mesh& mesh,
                   std::span<const std::uint32_t> vertices,
                   const GltfBytes& write) {
    std::map<ItemColour, Item<std::uint8_t, 4>> items;
    write_each(vertices, write, [&](std::uint32_t vertex) {
        const ItemColour colour = mesh.colours[vertex];
        auto known = items.find(colour);
        if (known == items.end()) {
            known =
                items.emplace(colour, colour_item(plain_colour(mesh.looks.get(), colour))).first;
        }
        return known->second;
    });
}

/// Selects the codec versions of EXT_meshopt_compression; only once, because meshoptimizer stores
/// them in global variables.
void set_codec_versions() {
    static const bool set = [] {
        meshopt_encodeVertexVersion(0);
        meshopt_encodeIndexVersion(1);
        return true;
    }();
    static_cast<void>(set);
}

void write_quantized(const Mesh& mesh,
                     std::span<const std::uint32_t> vertices,
                     GltfArray array,
                     const GltfForm& form,
                     const GltfBytes& write) {
    if (array == GltfArray::Positions) {
        write_each(vertices, write, [&mesh, steps = PositionSteps(form)](std::uint32_t vertex) {
            return steps(mesh.positions[vertex]);
        });
    } else if (array == GltfArray::Normals) {
        write_each(vertices, write, [&](std::uint32_t vertex) {
            const glm::vec3 n = valid_normal(mesh.normals[vertex]);
            return Item<std::int8_t, 4>{signed_byte(n.x), signed_byte(n.y), signed_byte(n.z), 0};
        });
    } else if (array == GltfArray::TextureCoordinates) {
        write_each(vertices, write,
                   [&mesh, steps = TextureSteps(form.texture)](std::uint32_t vertex) {
                       return steps(mesh.texture_coordinates[vertex]);
                   });
    } else {
        write_each(vertices, write, [&](std::uint32_t vertex) {
            const glm::vec4 t = valid_tangent(mesh.tangents[vertex]);
            return Item<std::int8_t, 4>{signed_byte(t.x), signed_byte(t.y), signed_byte(t.z),
                                        signed_byte(t.w)};
        });
    }
}

/// The float of a number of Mesh::segments: exact up to 2^24; -1 for kNoSegment.
float item_number(std::uint32_t number) {
    return number == kNoSegment ? -1.0F : static_cast<float>(number);
}

} // namespace

GltfTextureForm
texture_form_of(ExportCompression compression, const glm::vec2& low, const glm::vec2& high) {
    GltfTextureForm form;
    form.bits = kMinTextureBits;
    if (low.x >= 0.0F && low.y >= 0.0F && high.x <= 1.0F && high.y <= 1.0F) {
        form.quantized = true;
        if (compression == ExportCompression::Meshopt) {
            form.transform = {glm::vec2(0.0F), glm::vec2(65535.0F / max_value(form.bits))};
        }
        return form;
    }
    const glm::vec2 extent = high - low;
    const float max_extent = std::max(extent.x, extent.y);
    while (form.bits < kMaxTextureBits && max_extent > kMaxTextureStep * max_value(form.bits)) {
        ++form.bits;
    }
    form.quantized = max_extent <= kMaxCoarseTextureStep * max_value(form.bits);
    if (!form.quantized) {
        return form;
    }
    form.low = low;
    form.extent = {extent.x > 0.0F ? extent.x : 1.0F, extent.y > 0.0F ? extent.y : 1.0F};
    form.transform = {low, form.extent * (65535.0F / max_value(form.bits))};
    return form;
}

glm::mat4 GltfForm::decoding() const {
    glm::mat4 matrix(1.0F);
    if (step > 0.0F) {
        matrix[0][0] = matrix[1][1] = matrix[2][2] = step;
        matrix[3] = glm::vec4(low, 1.0F);
    }
    return matrix;
}

GltfForm form_of(ExportCompression compression, const Bounds& bounds) {
    GltfForm form;
    form.compression = compression;
    if (!form.quantized()) {
        return form;
    }
    const glm::vec3 extent = bounds.high - bounds.low;
    const float max_extent = std::max({extent.x, extent.y, extent.z});
    form.low = bounds.low;
    form.step = max_extent > 0.0F ? max_extent / max_value(position_bits(compression)) : 1.0F;
    if (compression == ExportCompression::Meshopt) {
        // The power of two at or below the step of positions: its multiples are floats with few
        // bits, which compress well.
        int exponent = 0;
        static_cast<void>(std::frexp(form.step, &exponent));
        form.wind_step = std::ldexp(1.0F, exponent - 1);
    }
    return form;
}

GltfItem item_of(GltfArray array, const GltfForm& form) {
    const bool quantized = form.quantized();
    switch (array) {
    case GltfArray::Positions:
        return form.step > 0.0F ? GltfItem{kGltfUnsignedShort, "VEC3", false, 8, true}
                                : GltfItem{kGltfFloat, "VEC3", false, 12};
    case GltfArray::Normals:
        return quantized ? GltfItem{kGltfByte, "VEC3", true, 4, true}
                         : GltfItem{kGltfFloat, "VEC3", false, 12};
    case GltfArray::TextureCoordinates:
        return form.texture.quantized ? GltfItem{kGltfUnsignedShort, "VEC2", true, 4}
                                      : GltfItem{kGltfFloat, "VEC2", false, 8};
    case GltfArray::Tangents:
        return quantized ? GltfItem{kGltfByte, "VEC4", true, 4}
                         : GltfItem{kGltfFloat, "VEC4", false, 16};
    case GltfArray::WindPivots:
        return {kGltfFloat, "VEC2", false, 8};
    case GltfArray::WindMotions:
        return quantized ? GltfItem{kGltfUnsignedShort, "VEC2", true, 4}
                         : GltfItem{kGltfFloat, "VEC2", false, 8};
    case GltfArray::Items:
        return {kGltfFloat, "VEC2", false, 8};
    case GltfArray::Joints:
        return {kGltfUnsignedByte, "VEC4", false, 4};
    default: // colours, weights
        return {kGltfUnsignedByte, "VEC4", true, 4};
    }
}

std::string_view attribute_name(GltfArray array) {
    constexpr std::array<std::string_view, 12> kNames{
        "POSITION",  "NORMAL",     "TEXCOORD_0", "TANGENT", "COLOR_0",  "JOINTS_0",
        "WEIGHTS_0", "TEXCOORD_1", "TEXCOORD_2", "_ITEMS",  "POSITION", "NORMAL",
    };
    static_assert(kNames.size() == static_cast<std::size_t>(GltfArray::Indices));
    return kNames[static_cast<std::size_t>(array)];
}

std::array<std::uint16_t, 4> position_item(const GltfForm& form, const glm::vec3& position) {
    return PositionSteps(form)(position);
}

std::array<std::uint8_t, 4> colour_item(const glm::vec3& colour) {
    return {linear_byte(colour.r), linear_byte(colour.g), linear_byte(colour.b), 255};
}

void write_items(const Mesh& mesh,
                 std::span<const std::uint32_t> vertices,
                 GltfArray array,
                 const GltfForm& form,
                 const GltfBytes& write) {
    const bool quantized = array == GltfArray::Items                ? false
                           : array == GltfArray::Positions          ? form.step > 0.0F
                           : array == GltfArray::TextureCoordinates ? form.texture.quantized
                                                                    : form.quantized();
    if (array == GltfArray::Colours) {
        write_colours(mesh, vertices, write);
    } else if (quantized) {
        write_quantized(mesh, vertices, array, form, write);
    } else if (array == GltfArray::Positions) {
        write_each(vertices, write, [&](std::uint32_t vertex) { return mesh.positions[vertex]; });
    } else if (array == GltfArray::Normals) {
        write_each(vertices, write,
                   [&](std::uint32_t vertex) { return valid_normal(mesh.normals[vertex]); });
    } else if (array == GltfArray::TextureCoordinates) {
        write_each(vertices, write,
                   [&](std::uint32_t vertex) { return mesh.texture_coordinates[vertex]; });
    } else if (array == GltfArray::Items) {
        write_each(vertices, write, [&](std::uint32_t vertex) {
            const VertexSegments& items = mesh.segments[vertex];
            return glm::vec2(item_number(items[0]), item_number(items[1]));
        });
    } else {
        write_each(vertices, write,
                   [&](std::uint32_t vertex) { return valid_tangent(mesh.tangents[vertex]); });
    }
}

void write_wind_items(const Mesh& mesh,
                      std::span<const std::uint32_t> vertices,
                      GltfArray array,
                      const GltfForm& form,
                      const WindData& wind,
                      const GltfBytes& write) {
    const auto at = [&](std::uint32_t vertex) {
        return wind.at(mesh.segments[vertex], mesh.positions[vertex]);
    };
    if (array == GltfArray::WindPivots) {
        write_each(vertices, write, [&](std::uint32_t vertex) {
            const glm::vec2 pivot = at(vertex).pivot;
            return form.wind_step > 0.0F
                       ? glm::floor(pivot / form.wind_step + 0.5F) * form.wind_step
                       : pivot;
        });
    } else if (form.quantized()) {
        write_each(vertices, write, [&](std::uint32_t vertex) {
            const glm::vec2 motion = 65535.0F * at(vertex).motion;
            return Item<std::uint16_t, 2>{rounded(motion.x, 65535.0F), rounded(motion.y, 65535.0F)};
        });
    } else {
        write_each(vertices, write, [&](std::uint32_t vertex) { return at(vertex).motion; });
    }
}

GltfBuffer compress_items(std::span<const std::byte> items, std::uint32_t stride) {
    const std::size_t count = items.size() / stride;
    set_codec_versions();
    GltfBuffer bytes(meshopt_encodeVertexBufferBound(count, stride));
    bytes.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(bytes.data()),
                                            bytes.size(), items.data(), count, stride));
    return bytes;
}

GltfBuffer compress_indices(std::span<const std::uint32_t> indices, std::uint64_t vertices) {
    set_codec_versions();
    GltfBuffer bytes(meshopt_encodeIndexBufferBound(indices.size(), vertices));
    bytes.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(bytes.data()),
                                           bytes.size(), indices.data(), indices.size()));
    return bytes;
}

} // namespace lsys
