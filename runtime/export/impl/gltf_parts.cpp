// SPDX-License-Identifier: MIT
#include "runtime/export/impl/gltf_parts.h"

#include "runtime/export/impl/base64.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>

namespace lsys {

namespace {

void put_sampler(JsonWriter& json, int wrap) {
    constexpr int kLinear = 9729;
    constexpr int kLinearMipmapLinear = 9987;
    json.object().member("magFilter", kLinear).member("minFilter", kLinearMipmapLinear);
    json.member("wrapS", wrap).member("wrapT", wrap).end();
}

} // namespace

JsonWriter& begin_accessor(JsonWriter& json, const GltfAccessor& accessor) {
    json.object().member("bufferView", accessor.view);
    if (accessor.offset) {
        json.member("byteOffset", *accessor.offset);
    }
    return json.member("componentType", accessor.component)
        .member("count", accessor.count)
        .member("type", accessor.type);
}

void put_position_bounds(JsonWriter& json, const GltfForm& form, const Bounds& bounds) {
    if (form.step > 0.0F) {
        const auto low = position_item(form, bounds.low);
        const auto high = position_item(form, bounds.high);
        json.member("min", {low[0], low[1], low[2]}).member("max", {high[0], high[1], high[2]});
        return;
    }
    // Written as doubles: the shortest text of a float reads back as a different double.
    const glm::dvec3 low(bounds.low);
    const glm::dvec3 high(bounds.high);
    json.member("min", {low.x, low.y, low.z}).member("max", {high.x, high.y, high.z});
}

void put_packed_view(JsonWriter& json, const GltfPackedView& view) {
    json.object("extensions").object("EXT_meshopt_compression").member("buffer", 0);
    json.member("byteOffset", view.offset).member("byteLength", view.bytes);
    json.member("byteStride", view.stride).member("count", view.count);
    json.member("mode", view.is_index_list ? "TRIANGLES" : "ATTRIBUTES");
    if (!view.filter.empty()) {
        json.member("filter", view.filter);
    }
    json.end().end();
}

void put_material(JsonWriter& json,
                  const Material& material,
                  const MaterialPictures& shown,
                  const GltfMaterial& look) {
    const auto put_texture = [&](const char* name, std::size_t texture) {
        json.object(name).member("index", texture);
        if (look.transform) {
            const glm::vec2& offset = look.transform->offset;
            const glm::vec2& scale = look.transform->scale;
            json.object("extensions").object("KHR_texture_transform");
            json.member("offset", {offset.x, offset.y}).member("scale", {scale.x, scale.y});
            json.end().end();
        }
        json.end();
    };
    const glm::vec4 colour = glm::clamp(glm::vec4(look.colour, material.colour.a), 0.0F, 1.0F);
    json.object().member("name", look.name).object("pbrMetallicRoughness");
    json.member("baseColorFactor", {colour.r, colour.g, colour.b, colour.a});
    if (shown.colour) {
        put_texture("baseColorTexture", *shown.colour);
    }
    json.member("metallicFactor", 0);
    json.member("roughnessFactor", roughness(material)).end();
    if (shown.normal_map) {
        put_texture("normalTexture", *shown.normal_map);
    }
    if (material.cut_out) {
        json.member("alphaMode", "MASK").member("alphaCutoff", 0.5);
    } else if (colour.a < 1.0F) {
        json.member("alphaMode", "BLEND");
    }
    if (material.two_sided) {
        json.member("doubleSided", true);
    }
    if (material.translucency) {
        json.object("extras");
        json.member("translucency", six_decimals(*material.translucency)).end();
    }
    json.end();
}

void put_images(JsonWriter& json,
                const std::vector<Picture>& list,
                std::optional<std::size_t> first_view) {
    constexpr int kRepeat = 10497;
    constexpr int kClampToEdge = 33071;
    const auto is_leaf = [](const Picture& picture) {
        return picture.material == MaterialKind::Leaf;
    };
    const bool has_bark = !std::all_of(list.begin(), list.end(), is_leaf);
    json.array("samplers");
    if (has_bark) {
        put_sampler(json, kRepeat);
    }
    if (std::any_of(list.begin(), list.end(), is_leaf)) {
        put_sampler(json, kClampToEdge);
    }
    json.end().array("textures");
    for (std::size_t i = 0; i < list.size(); ++i) {
        json.object().member("sampler", is_leaf(list[i]) && has_bark ? 1 : 0);
        json.member("source", i).end();
    }
    json.end().array("images");
    for (std::size_t i = 0; i < list.size(); ++i) {
        json.object().member("name", list[i].name);
        if (first_view) {
            json.member("mimeType", "image/png").member("bufferView", *first_view + i).end();
        } else {
            json.member("uri", uri_text(list[i].name)).end();
        }
    }
    json.end();
}

std::optional<GlbHeaders> glb_headers(std::uint64_t json_bytes, std::uint64_t data_bytes) {
    const std::uint64_t total = sizeof(GlbHeader) + sizeof(GlbDataHeader) + json_bytes + data_bytes;
    if (total > kMaxGltfBytes) {
        return std::nullopt;
    }
    constexpr std::uint32_t kMagic = 0x46546C67;     // "glTF"
    constexpr std::uint32_t kJsonChunk = 0x4E4F534A; // "JSON"
    constexpr std::uint32_t kDataChunk = 0x004E4942; // "BIN"
    return GlbHeaders{{kMagic, 2, static_cast<std::uint32_t>(total),
                       static_cast<std::uint32_t>(json_bytes), kJsonChunk},
                      {static_cast<std::uint32_t>(data_bytes), kDataChunk}};
}

bool put_gltf_file(const GltfFile& file, PieceWriter& out) {
    const auto put_document = [&file](PieceWriter& to) {
        JsonWriter json(to);
        json.object();
        file.put_members(json);
        json.array("buffers").object().member("byteLength", file.data_bytes);
        if (!file.data_name.empty()) {
            json.member("uri", uri_text(file.data_name));
        } else if (!file.binary) {
            json.name("uri").text([&] {
                to.put("data:application/octet-stream;base64,");
                Base64Writer base64(to);
                file.put_data([&](std::span<const std::byte> bytes) {
                    base64.put(bytes);
                    return !to.stopped();
                });
                base64.finish();
            });
        }
        json.end();
        for (const GltfOtherBuffer& other : file.others) {
            json.object().member("byteLength", other.bytes).member("uri", other.uri).end();
        }
        const auto put_fallback = [&json](std::uint64_t decoded_bytes) {
            if (decoded_bytes > 0) {
                json.object().member("byteLength", decoded_bytes).object("extensions");
                json.object("EXT_meshopt_compression").member("fallback", true).end().end().end();
            }
        };
        put_fallback(file.decoded_bytes);
        for (const GltfOtherBuffer& other : file.others) {
            put_fallback(other.decoded_bytes);
        }
        json.end().end();
    };
    if (!file.binary) {
        put_document(out);
        out.put("\n");
        return true;
    }
    std::uint64_t json_bytes = 0;
    const ByteSink count = [&json_bytes](std::string_view bytes) {
        json_bytes += bytes.size();
        return true;
    };
    PieceWriter counter(count);
    put_document(counter);
    static_cast<void>(counter.finish());
    const std::uint64_t padding = (4 - json_bytes % 4) % 4;
    json_bytes += padding;
    const std::optional<GlbHeaders> headers = glb_headers(json_bytes, file.data_bytes);
    if (!headers) {
        return false;
    }
    out.put_array(std::span<const std::uint32_t>(headers->file));
    put_document(out);
    out.put(std::string_view("   ").substr(0, padding));
    out.put_array(std::span<const std::uint32_t>(headers->data));
    file.put_data([&out](std::span<const std::byte> bytes) {
        out.put_bytes(bytes);
        return !out.stopped();
    });
    return true;
}

} // namespace lsys
