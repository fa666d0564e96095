#include "runtime/export/impl/gltf_parts.h"

#include "runtime/export/impl/base64.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>

namespace lsys {

namespace {

struct Attribute {
    const char* name;
    int component;
    const char* type;
    bool normalized = false;
};
/// Indexed by GltfArray.
constexpr std::array<Attribute, 9> kAttributes{{
    {"POSITION", kGltfFloat, "VEC3"},
    {"NORMAL", kGltfFloat, "VEC3"},
    {"TEXCOORD_0", kGltfFloat, "VEC2"},
    {"TANGENT", kGltfFloat, "VEC4"},
    {"COLOR_0", kGltfByte, "VEC4", true},
    {"JOINTS_0", kGltfByte, "VEC4"},
    {"WEIGHTS_0", kGltfByte, "VEC4", true},
    {"TEXCOORD_1", kGltfFloat, "VEC2"},
    {"TEXCOORD_2", kGltfFloat, "VEC2"},
}};
static_assert(kAttributes.size() == static_cast<std::size_t>(GltfArray::Indices));

const Attribute& attribute_of(const GltfView& view) {
    return kAttributes[static_cast<std::size_t>(view.array)];
}

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

void put_attributes(JsonWriter& json,
                    const GltfData& data,
                    std::size_t first_accessor,
                    bool coloured) {
    json.object("attributes");
    for (std::size_t i = 0; data.views[i].array != GltfArray::Indices; ++i) {
        if (data.views[i].array != GltfArray::Colours || coloured) {
            json.member(attribute_of(data.views[i]).name, first_accessor + i);
        }
    }
    json.end();
}

void put_attribute_accessors(JsonWriter& json,
                             const GltfData& data,
                             std::size_t first_view,
                             std::uint64_t vertices,
                             const Bounds& bounds) {
    for (std::size_t i = 0; data.views[i].array != GltfArray::Indices; ++i) {
        const GltfView& view = data.views[i];
        const Attribute& attribute = attribute_of(view);
        const bool wide = view.array == GltfArray::Joints && view.bytes > 4 * vertices;
        begin_accessor(json, {first_view + i,
                              {},
                              wide ? kGltfShort : attribute.component,
                              vertices,
                              attribute.type});
        if (view.array == GltfArray::Positions) {
            // Digits of doubles: readers parse the shortest text of a float as another double.
            const glm::dvec3 low(bounds.low);
            const glm::dvec3 high(bounds.high);
            json.member("min", {low.x, low.y, low.z}).member("max", {high.x, high.y, high.z});
        }
        if (attribute.normalized) {
            json.member("normalized", true);
        }
        json.end();
    }
}

void put_view(JsonWriter& json, const GltfView& view, std::uint64_t offset) {
    constexpr int kVertices = 34962;
    constexpr int kIndices = 34963;
    json.object().member("buffer", 0);
    json.member("byteOffset", offset + view.offset).member("byteLength", view.bytes);
    if (view.array <= GltfArray::Indices) {
        json.member("target", view.array == GltfArray::Indices ? kIndices : kVertices);
    }
    json.end();
}

void put_material(JsonWriter& json,
                  const Material& material,
                  const MaterialPictures& shown,
                  bool coloured) {
    const glm::vec4 colour = glm::clamp(
        coloured ? glm::vec4(1.0F, 1.0F, 1.0F, material.colour.a) : material.colour, 0.0F, 1.0F);
    json.object().member("name", material.name).object("pbrMetallicRoughness");
    json.member("baseColorFactor", {colour.r, colour.g, colour.b, colour.a});
    if (shown.colour) {
        json.object("baseColorTexture").member("index", *shown.colour).end();
    }
    json.member("metallicFactor", 0);
    json.member("roughnessFactor", material.kind == MaterialKind::Bark ? 0.95 : 0.7).end();
    if (shown.relief) {
        json.object("normalTexture").member("index", *shown.relief).end();
    }
    if (material.cut_out) {
        json.member("alphaMode", "MASK").member("alphaCutoff", 0.5);
    } else if (colour.a < 1.0F) {
        json.member("alphaMode", "BLEND");
    }
    if (material.two_sided) {
        json.member("doubleSided", true);
    }
    json.end();
}

void put_images(JsonWriter& json, const std::vector<Picture>& list, std::size_t first_view) {
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
        json.object().member("name", list[i].name).member("mimeType", "image/png");
        json.member("bufferView", first_view + i).end();
    }
    json.end();
}

bool put_gltf_file(const GltfFile& file, PieceWriter& out) {
    const auto put_document = [&file](PieceWriter& to) {
        JsonWriter json(to);
        json.object();
        file.put_members(json);
        json.array("buffers").object().member("byteLength", file.data_bytes);
        if (!file.binary) {
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
        json.end().end().end();
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
    constexpr std::uint64_t kHeaders = 12 + 8 + 8;
    const std::uint64_t total = kHeaders + json_bytes + file.data_bytes;
    if (total > kMaxGltfBytes) {
        return false;
    }
    constexpr std::uint32_t kMagic = 0x46546C67;     // "glTF"
    constexpr std::uint32_t kJsonChunk = 0x4E4F534A; // "JSON"
    constexpr std::uint32_t kDataChunk = 0x004E4942; // "BIN"
    const std::array<std::uint32_t, 5> header{kMagic, 2, static_cast<std::uint32_t>(total),
                                              static_cast<std::uint32_t>(json_bytes), kJsonChunk};
    out.put_array(std::span<const std::uint32_t>(header));
    put_document(out);
    out.put(std::string_view("   ").substr(0, padding));
    const std::array<std::uint32_t, 2> data_header{static_cast<std::uint32_t>(file.data_bytes),
                                                   kDataChunk};
    out.put_array(std::span<const std::uint32_t>(data_header));
    file.put_data([&out](std::span<const std::byte> bytes) {
        out.put_bytes(bytes);
        return !out.stopped();
    });
    return true;
}

} // namespace lsys
