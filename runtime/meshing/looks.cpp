// SPDX-License-Identifier: MIT
#include "runtime/meshing/looks.h"

#include "grammar/base/exponentials.h"
#include "grammar/base/number_chars.h"
#include "runtime/meshing/impl/linear_textures.h"
#include "runtime/meshing/mesh.h"
#include "runtime/meshing/texture.h"

#include <cmath>
#include <limits>
#include <system_error>
#include <utility>

namespace lsys {

namespace {

std::shared_ptr<const Texture> built_in_picture(MaterialKind kind) {
    static const auto bark = std::make_shared<const Texture>(material_texture(MaterialKind::Bark));
    static const auto leaf = std::make_shared<const Texture>(material_texture(MaterialKind::Leaf));
    return kind == MaterialKind::Bark ? bark : kind == MaterialKind::Leaf ? leaf : nullptr;
}

} // namespace

float linear_of_srgb(float part) {
    const auto c = static_cast<double>(part);
    return static_cast<float>(c <= 0.04045 ? c / 12.92 : power((c + 0.055) / 1.055, 2.4));
}

void add_look(ItemColour index, Look look, Looks& looks) {
    if (look.colour || look.picture != nullptr) {
        const glm::vec3 texels =
            look.picture != nullptr ? mean_colour(*look.picture) : glm::vec3(1.0F);
        looks.plain_colours[index] = look.colour.value_or(glm::vec3(1.0F)) * texels;
    }
    looks.of_index[index] = std::move(look);
}

glm::vec3 plain_colour(const Looks* looks, ItemColour colour) {
    if (looks != nullptr) {
        if (const auto found = looks->plain_colours.find(colour);
            found != looks->plain_colours.end()) {
            return found->second;
        }
    }
    return palette_colour(colour);
}

ItemColour without_look(const Looks* looks, ItemColour colour) {
    if (looks == nullptr || !looks->plain_colours.contains(colour)) {
        return colour;
    }
    const glm::vec3 linear = plain_colour(looks, colour);
    ItemColour bytes = 0;
    for (int i = 0; i < 3; ++i) {
        bytes = bytes << 8 | nearest_srgb_byte(linear[i]);
    }
    return kOwnColour + bytes;
}

PictureName picture_name(std::string_view name) {
    constexpr std::string_view kMark = "#ratio ";
    const std::size_t at = name.rfind(kMark);
    if (at == std::string_view::npos) {
        return {name, std::nullopt};
    }
    const std::string_view text = name.substr(at + kMark.size());
    float ratio = 0.0F;
    const auto [end, error] = number_from_chars(text.data(), text.data() + text.size(), ratio);
    const bool is_valid = error == std::errc() && end == text.data() + text.size() &&
                          ratio > 0.0F && ratio <= std::numeric_limits<float>::max();
    return is_valid ? PictureName{name.substr(0, at), ratio} : PictureName{name, std::nullopt};
}

float picture_length(const Looks* looks, ItemColour colour) {
    const Look* const look = looks == nullptr ? nullptr : looks->find(colour);
    return look == nullptr ? 1.0F : look->picture_length;
}

void apply_look(const Looks* looks, ItemColour colour, Material& material) {
    const Look* const look = looks == nullptr ? nullptr : looks->find(colour);
    if (look == nullptr) {
        return;
    }
    if (look->colour || look->picture != nullptr) {
        material.colour = glm::vec4(look->colour.value_or(glm::vec3(1.0F)), material.colour.a);
    }
    material.roughness = look->roughness;
    if (look->picture != nullptr) {
        if (material.kind == MaterialKind::Bark) { // bark normals fit only the picture of bark
            material.kind = MaterialKind::Plain;
            material.roughness = look->roughness.value_or(kBarkRoughness);
        }
        material.picture = look->picture;
        material.normal_map = nullptr;
        material.textured = true;
        material.cut_out = has_holes(*look->picture);
    }
    if (look->normal_map != nullptr) {
        material.normal_map = look->normal_map;
        if (material.textured && material.picture == nullptr) {
            // A material with a normal map needs its colours as a picture too.
            material.picture = built_in_picture(material.kind);
        }
    }
    material.translucency = look->translucency;
    material.two_sided = look->two_sided.value_or(material.two_sided);
}

} // namespace lsys
