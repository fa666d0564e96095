// SPDX-License-Identifier: MIT
#include "grammar/dialects/cpfg/materials.h"

#include "grammar/dialects/impl/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace lsys {

namespace {

/// A colour of a material, each part 0 to 255.
using Rgb = std::array<unsigned, 3>;

Rgb rgb_at(std::string_view bytes, std::size_t at) {
    const auto byte = [&](std::size_t i) {
        return static_cast<unsigned>(static_cast<unsigned char>(bytes[at + i]));
    };
    return {byte(0), byte(1), byte(2)};
}

std::string colour_text(const Rgb& colour) {
    std::string text = " colour";
    for (const unsigned part : colour) {
        text += " " + fixed_text(static_cast<float>(
                          std::round(static_cast<double>(part) / 255.0 * 1e4) / 1e4));
    }
    return text;
}

/// The appearance of a record of materials: index, transparency, then ambient, diffuse, emitted and
/// specular colour, then shininess.
std::string material_text(std::string_view record) {
    constexpr std::size_t kAmbient = 2;
    constexpr std::size_t kDiffuse = 5;
    constexpr std::size_t kEmission = 8;
    constexpr std::size_t kSpecular = 11;
    constexpr std::size_t kShininess = 14;
    Rgb colour = rgb_at(record, kDiffuse);
    const Rgb ambient = rgb_at(record, kAmbient);
    const Rgb emission = rgb_at(record, kEmission);
    if (colour == Rgb{}) { // black: only ambient and emitted light show the surface
        for (std::size_t i = 0; i < colour.size(); ++i) {
            colour[i] = std::max(ambient[i], emission[i]);
        }
    }
    std::string text = colour_text(colour);
    if (rgb_at(record, kSpecular) != Rgb{}) {
        // Exponent n of Phong as roughness: sqrt(2 / (n + 2)) (Walter et al. 2007, section 5.1).
        const auto exponent = static_cast<double>(static_cast<unsigned char>(record[kShininess]));
        const double roughness = std::sqrt(2.0 / (exponent + 2.0));
        text += " roughness " + fixed_text(static_cast<float>(std::round(roughness * 1e3) / 1e3));
    }
    return text;
}

constexpr std::size_t kColours = 256;
constexpr std::size_t kMapRecord = 3;
constexpr std::size_t kMaterialRecord = 15;
constexpr std::size_t kMaxTextures = 255; // 256 * texture + colour is at most 65,535

bool is_used(unsigned index, const CpfgUses& uses, unsigned first_colour) {
    return uses.has_any_colour || uses.steps_colours || index == first_colour ||
           uses.colours.count(index) != 0;
}

/// The appearances of the colours that the model uses, by index; empty if the file is neither a
/// colour map nor materials.
std::map<unsigned, std::string>
appearances(std::string_view colours, const CpfgUses& uses, unsigned first_colour) {
    const bool is_map = colours.size() == kColours * kMapRecord;
    std::map<unsigned, std::string> result;
    if (!is_map && (colours.empty() || colours.size() % kMaterialRecord != 0 ||
                    colours.size() > kColours * kMaterialRecord)) {
        return result;
    }
    const std::size_t size = is_map ? kMapRecord : kMaterialRecord;
    for (std::size_t i = 0; (i + 1) * size <= colours.size(); ++i) {
        const std::string_view record = colours.substr(i * size, size);
        const unsigned index = is_map
                                   ? static_cast<unsigned>(i)
                                   : static_cast<unsigned>(static_cast<unsigned char>(record[0]));
        if (is_used(index, uses, first_colour)) {
            result.emplace(index, is_map ? colour_text(rgb_at(record, 0)) : material_text(record));
        }
    }
    return result;
}

} // namespace

std::string
material_statements(std::string_view colours, const CpfgUses& uses, unsigned first_colour) {
    std::string text;
    for (const auto& [index, appearance] : appearances(colours, uses, first_colour)) {
        text += "#material " + std::to_string(index) + appearance + ";\n";
    }
    return text;
}

std::string texture_statements(std::string_view colours,
                               const CpfgUses& uses,
                               const std::vector<CpfgTexture>& textures,
                               unsigned first_colour) {
    const std::map<unsigned, std::string> known = appearances(colours, uses, first_colour);
    std::string text;
    for (unsigned n = 1; n <= std::min<std::size_t>(textures.size(), kMaxTextures); ++n) {
        const CpfgTexture& texture = textures[n - 1];
        if (texture.file.empty() || !(uses.has_any_texture || uses.textures.count(n) != 0)) {
            continue;
        }
        // Branches need the proportions of a picture; a surface has coordinates of its own.
        const std::string how =
            uses.sets_textures ? "#ratio " + fixed_text(static_cast<float>(texture.ratio)) : "";
        for (unsigned index = 0; index < kColours; ++index) {
            if (!is_used(index, uses, first_colour)) {
                continue;
            }
            const auto found = known.find(index);
            text += "#material " + std::to_string(kColours * n + index) +
                    (found == known.end() || texture.replaces_colour ? "" : found->second) +
                    " picture \"" + texture.file + how + "\";\n";
        }
    }
    return text;
}

} // namespace lsys
