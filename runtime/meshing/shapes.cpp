// SPDX-License-Identifier: MIT
#include "runtime/meshing/shapes.h"

#include "grammar/base/trigonometry.h"
#include "runtime/meshing/impl/surfaces.h"
#include "runtime/meshing/texture.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace lsys {

namespace {

// Palette indices of the colours of the library.
constexpr std::uint16_t kLeafGreen = 1;
constexpr std::uint16_t kYellow = 18;
constexpr std::uint16_t kPink = 20;
constexpr std::uint16_t kPaleGreen = 14;
constexpr std::uint16_t kGrey = kGreyPalette;

std::uint32_t halved(std::uint32_t finest, std::uint32_t level, std::uint32_t min_count) {
    return std::max(level < 32 ? finest >> level : 0, min_count);
}

ShapePart plain(std::uint16_t palette) {
    ShapePart part;
    part.material = {.kind = MaterialKind::Plain, .palette = palette};
    return part;
}

// --- LEAF
// An ovate leaf with a stem and a long tip. Its outline is straight between these points: distance
// from the base, half the width.
constexpr float kStemLength = 0.12F;
constexpr float kStemHalfWidth = 0.014F;
constexpr float kLeafHalfWidth = 0.25F;
constexpr std::array<std::array<float, 2>, 6> kLeafOutline{{
    {kStemLength, 0.0F},
    {0.19F, 0.140F},
    {0.38F, kLeafHalfWidth},
    {0.62F, 0.200F},
    {0.84F, 0.065F},
    {1.0F, 0.0F},
}};

/// A point of the leaf, whose halves form a V and which bends down towards its tip.
glm::vec3 leaf_point(float x, float y) {
    return {x, y, 0.35F * std::abs(x) - 0.12F * y * y};
}

std::uint32_t append_leaf_point(ShapePart& part, float x, float y) {
    part.positions.push_back(leaf_point(x, y));
    part.texture_coordinates.emplace_back(0.5F + 0.5F * x / kLeafHalfWidth, 1.0F - y);
    return static_cast<std::uint32_t>(part.positions.size() - 1);
}

/// One half of the blade, with the midrib as an edge of its own: side is -1 or 1.
void append_half(ShapePart& part,
                 std::span<const std::array<float, 2>> rows,
                 float start,
                 float side) {
    auto& out = part.indices;
    const auto append = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        out.insert(out.end(), {a, side > 0.0F ? b : c, side > 0.0F ? c : b});
    };
    std::uint32_t middle = append_leaf_point(part, 0.0F, start);
    std::uint32_t edge = middle;
    for (const auto& [y, half_width] : rows) {
        const std::uint32_t m = append_leaf_point(part, 0.0F, y);
        const std::uint32_t e = append_leaf_point(part, side * half_width, y);
        append(middle, e, m);
        if (edge != middle) {
            append(middle, edge, e);
        }
        middle = m;
        edge = e;
    }
    const std::uint32_t tip = append_leaf_point(part, 0.0F, 1.0F);
    append(middle, edge, tip);
}

void append_blade(ShapePart& part, std::span<const std::array<float, 2>> rows, float start) {
    append_half(part, rows, start, -1.0F);
    append_half(part, rows, start, 1.0F);
}

Shape make_leaf(std::uint32_t level) {
    ShapePart part;
    part.material = {.kind = MaterialKind::Leaf,
                     .palette = kLeafGreen,
                     .two_sided = true,
                     .cut_out = true,
                     .textured = true};
    constexpr std::array<std::array<float, 2>, 2> kFewRows{{kLeafOutline[2], {0.75F, 0.15F}}};
    if (level < 2) {
        const std::uint32_t a = append_leaf_point(part, -kStemHalfWidth, 0.0F);
        const std::uint32_t b = append_leaf_point(part, kStemHalfWidth, 0.0F);
        const std::uint32_t c = append_leaf_point(part, 0.0F, 1.5F * kStemLength);
        part.indices = {a, b, c};
        append_blade(part,
                     level == 0 ? std::span(kLeafOutline).subspan(1, 4)
                                : std::span<const std::array<float, 2>>(kFewRows),
                     kStemLength);
    } else if (level == 2) {
        append_blade(part, std::span(kLeafOutline).subspan(2, 1), 0.0F);
    } else {
        append_leaf_point(part, 0.0F, 0.0F);
        append_leaf_point(part, kLeafHalfWidth, kLeafOutline[2][0]);
        append_leaf_point(part, 0.0F, 1.0F);
        append_leaf_point(part, -kLeafHalfWidth, kLeafOutline[2][0]);
        part.indices = {0, 1, 2, 0, 2, 3};
    }
    complete_normals(part);
    complete_tangents(part);
    return {.parts = {part}, .droops = true};
}

// --- FLOWER
constexpr std::uint32_t kPetals = 5;

/// A row of points across a petal: distance from the axis, height, half the width.
struct PetalRow {
    float radius;
    float y;
    float half_width;
};
constexpr PetalRow kPetalBase{0.10F, 0.34F, 0.0F};
constexpr PetalRow kPetalTip{0.68F, 1.0F, 0.0F};
// Coarse levels keep only the last rows, which reach farthest out, like the tip.
constexpr std::array<PetalRow, 3> kPetalRows{{
    {0.27F, 0.62F, 0.20F},
    {0.46F, 0.83F, 0.29F},
    {0.60F, 0.95F, 0.21F},
}};
constexpr float kPetalHalfWidth = kPetalRows[1].half_width;

/// The horizontal unit vector that +Z becomes after a part of a turn about +Y.
glm::vec3 outwards(float turns) {
    const SineCosine turn = sine_cosine(2.0 * std::numbers::pi * static_cast<double>(turns));
    return glm::vec3(glm::dvec3(turn.sine, 0.0, turn.cosine));
}

std::uint32_t append_petal_point(ShapePart& part, const PetalRow& row, float side, float turns) {
    const glm::vec3 out = outwards(turns);
    const glm::vec3 across(out.z, 0.0F, -out.x);
    // The edges are bent up and inwards.
    const float bend = 0.12F * std::abs(side) * row.half_width;
    part.positions.push_back((row.radius - bend) * out + side * row.half_width * across +
                             glm::vec3(0.0F, std::min(row.y + bend, 1.0F), 0.0F));
    part.texture_coordinates.emplace_back(0.5F + 0.5F * side * row.half_width / kPetalHalfWidth,
                                          1.0F - (row.radius - kPetalBase.radius) /
                                                     (kPetalTip.radius - kPetalBase.radius));
    return static_cast<std::uint32_t>(part.positions.size() - 1);
}

void append_petal(ShapePart& part, std::span<const PetalRow> rows, float turns) {
    auto& out = part.indices;
    // The inner side of a petal is its front.
    std::uint32_t middle = append_petal_point(part, kPetalBase, 0.0F, turns);
    std::uint32_t left = middle;
    std::uint32_t right = middle;
    for (const PetalRow& row : rows) {
        const std::uint32_t l = append_petal_point(part, row, -1.0F, turns);
        const std::uint32_t m = append_petal_point(part, row, 0.0F, turns);
        const std::uint32_t r = append_petal_point(part, row, 1.0F, turns);
        out.insert(out.end(), {middle, l, m, middle, m, r});
        if (left != middle) {
            out.insert(out.end(), {left, l, middle, middle, r, right});
        }
        left = l;
        middle = m;
        right = r;
    }
    const std::uint32_t tip = append_petal_point(part, kPetalTip, 0.0F, turns);
    out.insert(out.end(), {left, tip, middle, middle, tip, right});
}

/// A pointed leaf under the gap between two petals.
void append_sepal(ShapePart& part, float turns) {
    const glm::vec3 out = outwards(turns);
    const glm::vec3 across(out.z, 0.0F, -out.x);
    const glm::vec3 up(0.0F, 1.0F, 0.0F);
    const auto first = static_cast<std::uint32_t>(part.positions.size());
    for (const glm::vec2 at : {glm::vec2(-0.08F, 0.0F), glm::vec2(0.08F, 0.0F), glm::vec2(0, 1)}) {
        part.positions.push_back((0.12F + 0.25F * at.y) * out + at.x * across +
                                 (0.41F + 0.11F * at.y) * up);
        part.normals.push_back(glm::normalize(0.11F * out - 0.25F * up));
        part.texture_coordinates.emplace_back(0.5F + at.x, 1.0F - at.y);
        part.indices.push_back(first + static_cast<std::uint32_t>(part.indices.size() % 3));
    }
}

Shape make_flower(std::uint32_t level) {
    ShapePart petals;
    petals.material = {.kind = MaterialKind::Flower, .palette = kPink, .two_sided = true};
    const std::span<const PetalRow> all(kPetalRows);
    for (std::uint32_t i = 0; i < kPetals; ++i) {
        append_petal(petals, all.last(3 - std::min(level, 2U)),
                     static_cast<float>(i) / static_cast<float>(kPetals));
    }
    complete_normals(petals);

    ShapePart centre;
    centre.material = {.kind = MaterialKind::Flower, .palette = kYellow};
    centre.takes_colour = false;
    std::vector<ProfilePoint> dome{{0.14F, 0.42F, {}}, {0.11F, 0.51F, {}}, {0.0F, 0.55F, {}}};
    if (level > 0) {
        dome.erase(dome.begin() + 1);
    }
    smooth_normals(dome);
    append_revolution(centre, dome, halved(8, level, 4));

    ShapePart calyx = plain(kPaleGreen);
    calyx.material.two_sided = true;
    calyx.takes_colour = false;
    std::vector<ProfilePoint> cup{{0.0F, 0.0F, {}}, {0.09F, 0.10F, {}}, {0.15F, 0.43F, {}}};
    smooth_normals(cup);
    append_revolution(calyx, cup, level == 0 ? kPetals : 3);
    for (std::uint32_t i = 0; level == 0 && i < kPetals; ++i) {
        append_sepal(calyx, (static_cast<float>(i) + 0.5F) / static_cast<float>(kPetals));
    }

    complete_tangents(petals);
    complete_tangents(centre);
    complete_tangents(calyx);
    return {.parts = {petals, centre, calyx}};
}

// --- bodies of revolution
Shape make_sphere(std::uint32_t level) {
    ShapePart part = plain(kGrey);
    const std::uint32_t rings = halved(8, level, 2);
    std::vector<ProfilePoint> profile;
    for (std::uint32_t i = 0; i <= rings; ++i) {
        // Symmetric, with an exact equator.
        const SineCosine turn =
            sine_cosine(std::numbers::pi * (static_cast<double>(i) / rings - 0.5));
        const bool pole = i == 0 || i == rings;
        const glm::vec2 normal(glm::dvec2(pole ? 0.0 : turn.cosine, turn.sine));
        profile.push_back({0.5F * normal.x, 0.5F + 0.5F * normal.y, normal});
    }
    append_revolution(part, profile, halved(16, level, 4));
    complete_tangents(part);
    return {.parts = {part}};
}

Shape make_heterocyst(std::uint32_t level) {
    // A superellipse of exponent 2.5 with a nodule at each pole.
    constexpr std::array<std::array<float, 2>, 4> kHalf{
        {{0.14F, 0.0F}, {0.15F, 0.07F}, {0.34F, 0.14F}, {0.47F, 0.30F}}};
    std::vector<ProfilePoint> profile{{0.0F, 0.0F, {}}};
    const std::size_t step = level == 0 ? 1 : 2;
    for (std::size_t i = level < 2 ? 0 : kHalf.size(); i < kHalf.size(); i += step) {
        profile.push_back({kHalf[i][0], kHalf[i][1], {}});
    }
    const std::size_t below = profile.size();
    profile.push_back({0.5F, 0.5F, {}});
    for (std::size_t i = below; i-- > 0;) {
        profile.push_back({profile[i].radius, 1.0F - profile[i].y, {}});
    }
    smooth_normals(profile);
    ShapePart part = plain(kPaleGreen);
    append_revolution(part, profile, halved(16, level, 4));
    complete_tangents(part);
    return {.parts = {part}};
}

Shape make_cylinder(std::uint32_t level) {
    ShapePart part = plain(kGrey);
    const std::uint32_t sides = halved(16, level, 4);
    const std::array<ProfilePoint, 2> wall{{{0.5F, 0.0F, {1, 0}}, {0.5F, 1.0F, {1, 0}}}};
    append_revolution(part, wall, sides);
    append_disc(part, 0.0F, false, sides);
    append_disc(part, 1.0F, true, sides);
    complete_tangents(part);
    return {.parts = {part}};
}

Shape make_cone(std::uint32_t level) {
    ShapePart part = plain(kGrey);
    const std::uint32_t sides = halved(16, level, 4);
    const glm::vec2 normal = glm::normalize(glm::vec2(1.0F, 0.5F));
    const std::array<ProfilePoint, 2> wall{{{0.5F, 0.0F, normal}, {0.0F, 1.0F, normal}}};
    append_revolution(part, wall, sides);
    append_disc(part, 0.0F, false, sides);
    complete_tangents(part);
    return {.parts = {part}};
}

Shape make_disk(std::uint32_t level) {
    ShapePart part = plain(kGrey);
    part.material.two_sided = true;
    append_disc(part, 0.0F, true, halved(16, level, 4));
    complete_tangents(part);
    return {.parts = {part}};
}

Shape make_cube() {
    ShapePart part = plain(kGrey);
    append_cube(part);
    complete_tangents(part);
    return {.parts = {part}};
}

} // namespace

float leaf_half_width(float distance) {
    float half_width = distance >= 0.0F && distance <= 1.5F * kStemLength
                           ? kStemHalfWidth * (1.0F - distance / (1.5F * kStemLength))
                           : 0.0F;
    for (std::size_t i = 0; i + 1 < kLeafOutline.size(); ++i) {
        const auto& [y, width] = kLeafOutline[i];
        const auto& [next_y, next_width] = kLeafOutline[i + 1];
        if (distance >= y && distance <= next_y) {
            half_width =
                std::max(half_width, glm::mix(width, next_width, (distance - y) / (next_y - y)));
        }
    }
    return half_width;
}

Shape make_shape(TurtleOperation kind, std::uint32_t level) {
    switch (kind) {
    case TurtleOperation::Leaf:
        return make_leaf(level);
    case TurtleOperation::Flower:
        return make_flower(level);
    case TurtleOperation::Sphere:
        return make_sphere(level);
    case TurtleOperation::Heterocyst:
        return make_heterocyst(level);
    case TurtleOperation::Cylinder:
        return make_cylinder(level);
    case TurtleOperation::Cone:
        return make_cone(level);
    case TurtleOperation::Cube:
        return make_cube();
    case TurtleOperation::Disk:
        return make_disk(level);
    default:
        return {};
    }
}

Shape make_shape(const UserMesh& mesh) {
    ShapePart part = plain(kGrey);
    part.material.two_sided = true; // many user meshes are leaves
    if (mesh.picture != nullptr && !mesh.texture_coordinates.empty()) {
        part.material.textured = true;
        part.material.cut_out = has_holes(*mesh.picture);
        part.takes_colour = false;
    }
    part.positions = mesh.positions;
    part.normals = mesh.normals;
    part.texture_coordinates = mesh.texture_coordinates;
    part.texture_coordinates.resize(part.positions.size(), glm::vec2(0.0F));
    part.indices = mesh.indices;
    complete_tangents(part);
    return {.parts = {part}};
}

} // namespace lsys
