// SPDX-License-Identifier: MIT
#include "compiler/bytecode/environment_keys.h"

#include "grammar/base/number_chars.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>

namespace lsys {

namespace {

constexpr std::uint32_t bit(EnvironmentKind kind) {
    return 1U << static_cast<std::uint32_t>(kind);
}

constexpr std::uint32_t kShadow = bit(EnvironmentKind::Shadow);
constexpr std::uint32_t kSky = bit(EnvironmentKind::Sky);
constexpr std::uint32_t kSpace = bit(EnvironmentKind::Space);
constexpr std::uint32_t kCrowd = bit(EnvironmentKind::Crowd);
constexpr std::uint32_t kSolid = bit(EnvironmentKind::Solid);
constexpr std::uint32_t kMap = bit(EnvironmentKind::Map);
constexpr float kLargest = std::numeric_limits<float>::max();

using Form = EnvironmentKeyForm;
using Fields = BytecodeEnvironment;

constexpr EnvironmentKey number_key(std::string_view word,
                                    std::uint32_t kinds,
                                    float Fields::*field,
                                    std::string_view wanted,
                                    std::string_view meaning) {
    EnvironmentKey key{word, kinds, 0, Form::Number, -kLargest, kLargest, false, wanted, meaning};
    key.number = field;
    return key;
}
constexpr EnvironmentKey whole_number_key(std::string_view word,
                                          std::uint32_t kinds,
                                          std::uint32_t Fields::*field,
                                          std::string_view wanted,
                                          std::string_view meaning) {
    EnvironmentKey key{word, kinds, 0, Form::WholeNumber, 0, 0, false, wanted, meaning};
    key.whole = field;
    return key;
}
constexpr EnvironmentKey vector_key(std::string_view word,
                                    std::uint32_t kinds,
                                    std::array<float, 3> Fields::*field,
                                    std::string_view meaning) {
    EnvironmentKey key{word, kinds, 0, Form::Vector, -kLargest, kLargest, false, "", meaning};
    key.vector = field;
    return key;
}
constexpr EnvironmentKey other_key(std::string_view word,
                                   std::uint32_t kinds,
                                   Form form,
                                   std::string_view wanted,
                                   std::string_view meaning) {
    return {word, kinds, 0, form, -kLargest, kLargest, false, wanted, meaning};
}
// Copies of `key`: with numbers above 0, with numbers from `min` to `max`, and required by all kinds
// of environments that have it.
constexpr EnvironmentKey above_0(EnvironmentKey key, float max = kLargest) {
    key.min = 0.0F;
    key.max = max;
    key.above_min = true;
    return key;
}
constexpr EnvironmentKey from(EnvironmentKey key, float min, float max = kLargest) {
    key.min = min;
    key.max = max;
    return key;
}
constexpr EnvironmentKey required(EnvironmentKey key) {
    key.required_kinds = key.kinds;
    return key;
}

constexpr std::array<EnvironmentKey, 18> kEnvironmentKeys{
    above_0(number_key("cell",
                       kShadow | kSky,
                       &Fields::cell,
                       "a length in metres above 0",
                       "edge of a voxel, in metres")),
    from(whole_number_key("levels",
                          kShadow,
                          &Fields::levels,
                          "a whole number from 0 to 255",
                          "layers of voxels that a place shades below its own"),
         0.0F,
         kMaxShadowLevels),
    from(number_key("strength",
                    kShadow,
                    &Fields::strength,
                    "a number from 0 on",
                    "shadow of a place in its own voxel"),
         0.0F),
    above_0(number_key("ratio",
                       kShadow,
                       &Fields::ratio,
                       "a number above 0",
                       "shadow of a layer, divided by that of the layer below")),
    from(number_key("extinction",
                    kSky,
                    &Fields::extinction,
                    "a number from 0 on",
                    "extinction of light by leaf area"),
         0.0F),
    from(whole_number_key("directions",
                          kSky,
                          &Fields::directions,
                          "a whole number from 1 to 4,096",
                          "directions of the sky"),
         1.0F,
         kMaxSkyDirections),
    required(other_key("shape",
                       kSpace,
                       Form::Shape,
                       "`box`, `ball`, `dome`, `cone` or the name of a mesh file in quotes",
                       "what holds the markers")),
    required(above_0(vector_key("size", kSpace | kMap, &Fields::size, "extent along the axes"))),
    vector_key("at",
               kSpace | kMap,
               &Fields::at,
               "where it stands: the middle of the base, or of the picture"),
    required(from(whole_number_key("count",
                                   kSpace,
                                   &Fields::count,
                                   "a whole number from 1 to 67,108,864",
                                   "number of markers"),
                  1.0F,
                  static_cast<float>(kMaxMarkers))),
    required(above_0(number_key("radius",
                                kSpace | kCrowd,
                                &Fields::radius,
                                "a length in metres above 0",
                                "how far a place sees, in metres"))),
    above_0(number_key("angle",
                       kSpace,
                       &Fields::angle,
                       "an angle in degrees above 0, up to 360",
                       "full opening of the cone in which a place sees"),
            360.0F),
    required(from(number_key("kill",
                             kSpace,
                             &Fields::kill,
                             "a length in metres from 0 on",
                             "markers nearer than this to a place vanish"),
                  0.0F)),
    other_key("mesh", kSolid, Form::Meshes, "the name of a mesh file in quotes", "a surface"),
    other_key("plane",
              kSolid,
              Form::Plane,
              "four numbers: a, b, c and d of a x + b y + c z + d = 0",
              "a plane, solid where a x + b y + c z + d is negative"),
    required(
        other_key("file", kMap, Form::Picture, "the name of a PNG file in quotes", "the picture")),
    number_key("low", kMap, &Fields::low, "a number", "value of black"),
    number_key("high", kMap, &Fields::high, "a number", "value of white"),
};

constexpr std::array<std::string_view, kCountOf<SpaceShape>> kShapeNames{"box", "ball", "dome",
                                                                         "cone", ""};

struct KindText {
    std::string_view answer;
    std::string_view meaning;
};
constexpr std::array<KindText, kCountOf<EnvironmentKind>> kKindTexts{{
    {"(q, x, y, z)", "exposure to light, and the direction of more light"},
    {"(q)", "part of the light of the sky that arrives, 0 to 1"},
    {"(n, x, y, z)", "number of markers of a bud, and their mean direction"},
    {"(n, x, y, z)", "number of other places near by, and the direction away from them"},
    {"(d, x, y, z)", "distance to the nearest surface, negative inside, and the direction to it"},
    {"(v)", "value of a picture"},
    {"(...)", "what an external program answers: `--environment NAME=COMMAND`"},
}};

void append(std::string& out, float value) {
    std::array<char, 32> buffer{};
    out += ' ';
    out.append(buffer.data(),
               number_to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr);
}

/// The name of the picture or of the mesh that is the shape; empty if the statement has an error.
std::string_view file_of(const BytecodeEnvironment& environment) {
    return environment.surfaces.empty() ? std::string_view{} : environment.surfaces.front().path;
}

void append_value(std::string& out, const EnvironmentKey& key, const BytecodeEnvironment& each) {
    switch (key.form) {
    case Form::Number:
        append(out, each.*key.number);
        break;
    case Form::WholeNumber:
        out += fmt::format(" {}", each.*key.whole);
        break;
    case Form::Vector:
        for (std::uint32_t i = 0; i < axes_of(each.kind); ++i) {
            append(out, (each.*key.vector)[i]);
        }
        break;
    case Form::Shape:
        out += each.shape == SpaceShape::Mesh ? fmt::format(" \"{}\"", file_of(each))
                                              : fmt::format(" {}", name_of(each.shape));
        break;
    case Form::Picture:
        out += fmt::format(" \"{}\"", file_of(each));
        break;
    case Form::Plane:
    case Form::Meshes:
        break; // append_surfaces() writes these keys
    }
}

void append_surfaces(std::string& out, const BytecodeEnvironment& environment) {
    for (const EnvironmentSurface& surface : environment.surfaces) {
        if (!surface.path.empty()) {
            out += fmt::format(" mesh \"{}\"", surface.path);
            continue;
        }
        out += " plane";
        for (const float part : surface.plane) {
            append(out, part);
        }
    }
}

} // namespace

bool EnvironmentKey::admits(float value) const {
    return std::isfinite(value) && value >= min && value <= max && !(above_min && value == min) &&
           (form != EnvironmentKeyForm::WholeNumber || value == std::floor(value));
}

std::span<const EnvironmentKey> environment_keys() {
    return kEnvironmentKeys;
}

const EnvironmentKey* find_environment_key(std::string_view word) {
    for (const EnvironmentKey& key : kEnvironmentKeys) {
        if (key.word == word) {
            return &key;
        }
    }
    return nullptr;
}

std::vector<std::string_view> environment_keys_of(EnvironmentKind kind) {
    std::vector<std::string_view> words;
    for (const EnvironmentKey& key : kEnvironmentKeys) {
        if (key.belongs_to(kind)) {
            words.push_back(key.word);
        }
    }
    return words;
}

std::string_view meaning_of(EnvironmentKind kind) {
    return kKindTexts[static_cast<std::size_t>(kind)].meaning;
}

std::string_view answer_text(EnvironmentKind kind) {
    return kKindTexts[static_cast<std::size_t>(kind)].answer;
}

std::optional<EnvironmentKind> find_environment_kind(std::string_view word) {
    for (const EnvironmentKind kind : enumerators_of<EnvironmentKind>()) {
        if (name_of(kind) == word) {
            return kind;
        }
    }
    return std::nullopt;
}

std::vector<std::string_view> environment_kind_names() {
    std::vector<std::string_view> names;
    for (const EnvironmentKind kind : enumerators_of<EnvironmentKind>()) {
        names.push_back(name_of(kind));
    }
    return names;
}

std::string wanted_text(const EnvironmentKey& key, EnvironmentKind kind) {
    if (key.form != EnvironmentKeyForm::Vector) {
        return std::string(key.wanted);
    }
    return fmt::format("{} numbers{}: {}", axes_of(kind) == 2 ? "two" : "three",
                       key.above_min ? " above 0" : "",
                       axes_of(kind) == 2 ? "x and z" : "x, y and z");
}

std::vector<std::string_view> space_shape_names() {
    return {kShapeNames.begin(), kShapeNames.end() - 1};
}

std::string_view name_of(SpaceShape shape) {
    return kShapeNames[static_cast<std::size_t>(shape)];
}

std::optional<SpaceShape> find_space_shape(std::string_view word) {
    for (const SpaceShape shape : enumerators_of<SpaceShape>()) {
        if (!word.empty() && name_of(shape) == word) {
            return shape;
        }
    }
    return std::nullopt;
}

std::string environment_text(const BytecodeEnvironment& environment) {
    std::string text(name_of(environment.kind));
    for (const EnvironmentKey& key : kEnvironmentKeys) {
        const bool has_no_size = key.word == "size" && environment.shape == SpaceShape::Mesh;
        if (key.belongs_to(environment.kind) && !key.may_repeat() && !has_no_size) {
            text += fmt::format(" {}", key.word);
            append_value(text, key, environment);
        }
    }
    if (environment.kind == EnvironmentKind::Solid) {
        append_surfaces(text, environment);
    }
    return text;
}

std::string default_text(const EnvironmentKey& key) {
    if (key.required_kinds != 0 || key.may_repeat()) {
        return {};
    }
    std::string text;
    append_value(text, key, BytecodeEnvironment{});
    return text.substr(1);
}

} // namespace lsys
