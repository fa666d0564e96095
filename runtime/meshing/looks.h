// SPDX-License-Identifier: MIT
// Looks: the appearance of colour indexes that have a `#material` (docs/language.md section 7.7),
// with its pictures read. Made by the pipeline; meshers apply it to materials.
#pragma once

#include "runtime/turtle/skeleton.h"

#include <glm/vec3.hpp>

#include <map>
#include <memory>
#include <optional>
#include <string_view>

namespace lsys {

struct Texture; // runtime/meshing/texture.h
struct Material;

/// The look of a colour index. Unset members keep the built-in look.
struct Look {
    std::optional<glm::vec3> colour;                     // linear
    std::shared_ptr<const Texture> picture = nullptr;    // multiplied by the colour
    std::shared_ptr<const Texture> normal_map = nullptr; // normals, as bark_normals()
    std::optional<float> roughness;                      // 0 to 1
    std::optional<float> translucency;                   // 0 to 1
    std::optional<bool> two_sided;
    float picture_length = 1.0F; // of a picture along a branch, in lengths around the branch
};

/// The name of a picture: `"bark.png"`, or `"bark.png#ratio 2"`, where 1 keeps the proportions of
/// the picture along a branch and 2 makes it twice as long.
struct PictureName {
    std::string_view path;
    std::optional<float> ratio;
};
/// A `#` without a ratio above 0 behind it belongs to the path.
[[nodiscard]] PictureName picture_name(std::string_view name);

struct Looks {
    std::map<ItemColour, Look> of_index;
    std::map<ItemColour, glm::vec3>
        plain_colours; // colour times mean texel, for output without pictures

    [[nodiscard]] const Look* find(ItemColour colour) const {
        const auto found = of_index.find(colour);
        return found == of_index.end() ? nullptr : &found->second;
    }
};

/// Adds the look of a colour index.
void add_look(ItemColour index, Look look, Looks& looks);
/// Linear value of one component of an sRGB colour, 0 to 1 (IEC 61966-2-1).
[[nodiscard]] float linear_of_srgb(float part);
/// The linear colour of an item in formats without pictures, and of vertices. `looks` may be null.
[[nodiscard]] glm::vec3 plain_colour(const Looks* looks, ItemColour colour);
/// A colour that looks the same without `looks`, to 1/255 per component. An index without a look is
/// returned unchanged.
[[nodiscard]] ItemColour without_look(const Looks* looks, ItemColour colour);
/// Look::picture_length of a colour; 1 without a look. `looks` may be null.
[[nodiscard]] float picture_length(const Looks* looks, ItemColour colour);
/// Gives a material the look of its colour; `looks` may be null.
void apply_look(const Looks* looks, ItemColour colour, Material& material);

} // namespace lsys
