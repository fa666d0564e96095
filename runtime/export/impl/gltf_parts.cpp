#include "runtime/export/impl/gltf_parts.h"

#include "runtime/export/impl/text.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <iterator>

namespace lsys {

namespace {

template <typename... Arguments>
void add(std::string& text, fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(text), format, std::forward<Arguments>(arguments)...);
}

const char* comma(std::size_t index) {
    return index == 0 ? "" : ",";
}

} // namespace

std::string material_json(const Material& material, const MaterialPictures& shown, bool coloured) {
    std::string text;
    const glm::vec4 colour = glm::clamp(
        coloured ? glm::vec4(1.0F, 1.0F, 1.0F, material.colour.a) : material.colour, 0.0F, 1.0F);
    add(text, R"({{"name":"{}","pbrMetallicRoughness":{{"baseColorFactor":[{},{},{},{}],)",
        json_text(material.name), colour.r, colour.g, colour.b, colour.a);
    if (shown.colour) {
        add(text, R"("baseColorTexture":{{"index":{}}},)", *shown.colour);
    }
    add(text, R"("metallicFactor":0,"roughnessFactor":{}}})",
        material.kind == MaterialKind::Bark ? 0.95 : 0.7);
    if (shown.relief) {
        add(text, R"(,"normalTexture":{{"index":{}}})", *shown.relief);
    }
    if (material.cut_out) {
        add(text, R"(,"alphaMode":"MASK","alphaCutoff":0.5)");
    } else if (colour.a < 1.0F) {
        add(text, R"(,"alphaMode":"BLEND")");
    }
    add(text, "{}}}", material.two_sided ? R"(,"doubleSided":true)" : "");
    return text;
}

std::string images_json(const std::vector<Picture>& list, std::size_t first_view) {
    std::string text;
    // Sampler 0 repeats, 1 ends at the border; both with mipmaps.
    const auto is_leaf = [](const Picture& picture) {
        return picture.material == MaterialKind::Leaf;
    };
    const bool leaf = std::any_of(list.begin(), list.end(), is_leaf);
    const bool bark = !std::all_of(list.begin(), list.end(), is_leaf);
    add(text, R"("samplers":[)");
    if (bark) {
        add(text, R"({{"magFilter":9729,"minFilter":9987,"wrapS":10497,"wrapT":10497}})");
    }
    if (leaf) {
        add(text, R"({}{{"magFilter":9729,"minFilter":9987,"wrapS":33071,"wrapT":33071}})",
            comma(bark ? 1 : 0));
    }
    add(text, R"(],"textures":[)");
    for (std::size_t i = 0; i < list.size(); ++i) {
        add(text, R"({}{{"sampler":{},"source":{}}})", comma(i), is_leaf(list[i]) && bark ? 1 : 0,
            i);
    }
    add(text, R"(],"images":[)");
    for (std::size_t i = 0; i < list.size(); ++i) {
        add(text, R"({}{{"name":"{}","mimeType":"image/png","bufferView":{}}})", comma(i),
            list[i].name, first_view + i);
    }
    add(text, "],");
    return text;
}

bool put_glb_header(std::uint64_t json_bytes, std::uint64_t data_bytes, PieceWriter& out) {
    constexpr std::uint64_t kHeaders = 12 + 8 + 8;
    constexpr std::uint32_t kMagic = 0x46546C67;     // "glTF"
    constexpr std::uint32_t kJsonChunk = 0x4E4F534A; // "JSON"
    const std::uint64_t total = kHeaders + json_bytes + data_bytes;
    if (json_bytes > kMostGltfBytes || data_bytes > kMostGltfBytes || total > kMostGltfBytes) {
        return false;
    }
    const std::array<std::uint32_t, 5> words{kMagic, 2, static_cast<std::uint32_t>(total),
                                             static_cast<std::uint32_t>(json_bytes), kJsonChunk};
    out.put_array(std::span<const std::uint32_t>(words));
    return true;
}

void put_glb_data_header(std::uint64_t data_bytes, PieceWriter& out) {
    constexpr std::uint32_t kDataChunk = 0x004E4942; // "BIN"
    const std::array<std::uint32_t, 2> words{static_cast<std::uint32_t>(data_bytes), kDataChunk};
    out.put_array(std::span<const std::uint32_t>(words));
}

} // namespace lsys
