// SPDX-License-Identifier: MIT
#include "tests/viewer/drawn_ground.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace lsys::tests {

using view::HeightGrid;
using view::TerrainLod;

namespace {

/// Cells along a side of a node, which has 2 by 2 patches.
constexpr float kNodeCells = 2.0F * static_cast<float>(view::kPatchCells);

/// Morph factor, computed like terrain.vert.glsl.
float morph_of(float distance, std::uint32_t level, std::uint32_t levels) {
    if (level + 1 == levels) {
        return 0.0F;
    }
    const float start = TerrainLod::morph_start(level);
    return std::clamp((distance - start) / (TerrainLod::range(level) - start), 0.0F, 1.0F);
}

/// The level of the smallest node that contains a place and is within the range of its level.
std::uint32_t level_at(const TerrainLod& lod, const glm::vec3& eye, const glm::vec2& place) {
    std::uint32_t level = lod.levels() - 1;
    while (level != 0) {
        const float size = TerrainLod::cell(level - 1) * kNodeCells;
        const glm::vec2 low = glm::floor(place / size) * size;
        const glm::vec2 at(eye.x, eye.z);
        const glm::vec2 away = at - glm::clamp(at, low, low + size);
        if (glm::length(glm::vec3(away, lod.eye_height())) >= TerrainLod::range(level - 1)) {
            break;
        }
        --level;
    }
    return level;
}

} // namespace

float drawn_height(const TerrainLod& lod, const glm::vec3& eye, float x, float z) {
    // corner(): the position to which a corner of a cell has morphed.
    const std::uint32_t level = level_at(lod, eye, {x, z});
    const HeightGrid& grid = lod.grid(level);
    const float size = TerrainLod::cell(level);
    const auto corner = [&](std::int32_t cx, std::int32_t cz) {
        const glm::vec2 place(static_cast<float>(cx) * size, static_cast<float>(cz) * size);
        const float distance =
            glm::length(glm::vec3(place - glm::vec2(eye.x, eye.z), lod.eye_height()));
        const float morph = morph_of(distance, level, lod.levels());
        const std::int32_t even_x = cx - (cx & 1);
        const std::int32_t even_z = cz - (cz & 1);
        const glm::vec2 even(static_cast<float>(even_x) * size, static_cast<float>(even_z) * size);
        const glm::vec2 moved = glm::mix(place, even, morph);
        const float height = glm::mix(grid.at(cx, cz), grid.at(even_x, even_z), morph);
        return glm::vec3(moved.x, height, moved.y);
    };
    const auto cx = static_cast<std::int32_t>(std::floor(x / size));
    const auto cz = static_cast<std::int32_t>(std::floor(z / size));
    // Corners morph towards lower even coordinates, so the triangle above a place belongs to its
    // cell or to the next.
    for (std::int32_t dz = 0; dz <= 1; ++dz) {
        for (std::int32_t dx = 0; dx <= 1; ++dx) {
            const glm::vec3 a = corner(cx + dx, cz + dz);
            const glm::vec3 b = corner(cx + dx + 1, cz + dz);
            const glm::vec3 c = corner(cx + dx, cz + dz + 1);
            const glm::vec3 d = corner(cx + dx + 1, cz + dz + 1);
            for (const auto& [p, q, r] : {std::array{a, c, d}, std::array{a, d, b}}) {
                const glm::vec2 u(q.x - p.x, q.z - p.z);
                const glm::vec2 v(r.x - p.x, r.z - p.z);
                const glm::vec2 w(x - p.x, z - p.z);
                const float area = u.x * v.y - u.y * v.x;
                if (std::abs(area) < 1e-9F) {
                    continue;
                }
                const float s = (w.x * v.y - w.y * v.x) / area;
                const float t = (u.x * w.y - u.y * w.x) / area;
                constexpr float kSlack = 1e-4F;
                if (s >= -kSlack && t >= -kSlack && s + t <= 1.0F + kSlack) {
                    return p.y + s * (q.y - p.y) + t * (r.y - p.y);
                }
            }
        }
    }
    return std::nanf("");
}

} // namespace lsys::tests
