// SPDX-License-Identifier: MIT
#include "runtime/meshing/impl/surfaces.h"

#include "grammar/base/trigonometry.h"

#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <numbers>

namespace lsys {

namespace {

glm::vec3 around(float radius, float y, float turns) {
    // Quarter turns have exact sines and cosines, so that the extents of shapes are exact.
    const auto exact = [](double x) { return std::abs(x) < 1e-15 ? 0.0 : x; };
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(turns);
    const SineCosine turn = sine_cosine(angle);
    const auto c = static_cast<float>(exact(turn.cosine));
    const auto s = static_cast<float>(exact(turn.sine));
    return {radius * s, y, radius * c};
}

glm::vec3 any_orthogonal(const glm::vec3& normal) {
    const glm::vec3 axis = std::abs(normal.x) < 0.6F ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, 1);
    return glm::normalize(glm::cross(glm::cross(normal, axis), normal));
}

} // namespace

std::uint32_t append_vertex(ShapePart& part,
                            const glm::vec3& position,
                            const glm::vec3& normal,
                            const glm::vec2& texture_coordinate) {
    part.positions.push_back(position);
    part.normals.push_back(normal);
    part.texture_coordinates.push_back(texture_coordinate);
    return static_cast<std::uint32_t>(part.positions.size() - 1);
}

void smooth_normals(std::span<ProfilePoint> profile) {
    std::vector<glm::vec2> pieces;
    for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
        // The outside lies to the right of a profile that rises.
        pieces.push_back(glm::normalize(
            glm::vec2(profile[i + 1].y - profile[i].y, profile[i].radius - profile[i + 1].radius)));
    }
    for (std::size_t i = 0; i < profile.size(); ++i) {
        const glm::vec2 below = pieces[i > 0 ? i - 1 : 0];
        const glm::vec2 above = pieces[i < pieces.size() ? i : i - 1];
        profile[i].normal = glm::normalize(below + above);
        if (profile[i].radius == 0.0F) {
            profile[i].normal = {0.0F, i == 0 ? -1.0F : 1.0F};
        }
    }
}

void append_revolution(ShapePart& part,
                       std::span<const ProfilePoint> profile,
                       std::uint32_t sides) {
    std::vector<std::uint32_t> rows;
    for (const ProfilePoint& point : profile) {
        rows.push_back(static_cast<std::uint32_t>(part.positions.size()));
        const float v =
            1.0F - (point.y - profile.front().y) / (profile.back().y - profile.front().y);
        // A pole has a vertex in the middle of each side; a circle has its first vertex again at
        // the seam.
        const bool pole = point.radius == 0.0F;
        for (std::uint32_t i = 0; i < sides + (pole ? 0U : 1U); ++i) {
            const float u =
                (static_cast<float>(i) + (pole ? 0.5F : 0.0F)) / static_cast<float>(sides);
            const float turns = i == sides ? 0.0F : u;
            append_vertex(part, around(point.radius, point.y, turns),
                          around(point.normal.x, point.normal.y, turns), {u, v});
        }
    }
    for (std::size_t j = 0; j + 1 < profile.size(); ++j) {
        const bool closed_above = profile[j + 1].radius == 0.0F;
        for (std::uint32_t i = 0; i < sides; ++i) {
            const std::uint32_t a = rows[j] + i;
            const std::uint32_t d = rows[j + 1] + i;
            if (profile[j].radius > 0.0F) {
                part.indices.insert(part.indices.end(), {a, a + 1, closed_above ? d : d + 1});
            }
            if (!closed_above) {
                part.indices.insert(part.indices.end(), {a, d + 1, d});
            }
        }
    }
}

void append_disc(ShapePart& part, float y, bool up, std::uint32_t sides) {
    const auto first = static_cast<std::uint32_t>(part.positions.size());
    for (std::uint32_t i = 0; i < sides; ++i) {
        const glm::vec3 at = around(0.5F, y, static_cast<float>(i) / static_cast<float>(sides));
        append_vertex(part, at, {0.0F, up ? 1.0F : -1.0F, 0.0F},
                      {at.x + 0.5F, (up ? at.z : -at.z) + 0.5F});
    }
    for (std::uint32_t i = 1; i + 1 < sides; ++i) {
        part.indices.insert(part.indices.end(),
                            {first, first + (up ? i : i + 1), first + (up ? i + 1 : i)});
    }
}

void append_cube(ShapePart& part) {
    for (const glm::vec3 normal : {glm::vec3(1, 0, 0), glm::vec3(-1, 0, 0), glm::vec3(0, 0, 1),
                                   glm::vec3(0, 0, -1), glm::vec3(0, 1, 0), glm::vec3(0, -1, 0)}) {
        const glm::vec3 up = normal.y == 0.0F ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, -normal.y);
        const glm::vec3 right = glm::cross(up, normal);
        const auto first = static_cast<std::uint32_t>(part.positions.size());
        for (const glm::vec2 at :
             {glm::vec2(0, 1), glm::vec2(1, 1), glm::vec2(1, 0), glm::vec2(0, 0)}) {
            append_vertex(part,
                          glm::vec3(0, 0.5F, 0) + 0.5F * normal + (at.x - 0.5F) * right +
                              (0.5F - at.y) * up,
                          normal, at);
        }
        part.indices.insert(part.indices.end(),
                            {first, first + 1, first + 2, first, first + 2, first + 3});
    }
}

void complete_normals(ShapePart& part) {
    std::vector<glm::vec3> sums(part.positions.size(), glm::vec3(0.0F));
    for (std::size_t i = 0; i + 2 < part.indices.size(); i += 3) {
        const std::array corners{part.indices[i], part.indices[i + 1], part.indices[i + 2]};
        const glm::vec3 area = glm::cross(part.positions[corners[1]] - part.positions[corners[0]],
                                          part.positions[corners[2]] - part.positions[corners[0]]);
        for (const std::uint32_t corner : corners) {
            sums[corner] += area;
        }
    }
    part.normals.clear();
    for (const glm::vec3& sum : sums) {
        part.normals.push_back(glm::normalize(sum));
    }
}

void complete_tangents(ShapePart& part) {
    std::vector<glm::dvec3> along_u(part.positions.size(), glm::dvec3(0.0));
    std::vector<glm::dvec3> along_v(part.positions.size(), glm::dvec3(0.0));
    for (std::size_t i = 0; i + 2 < part.indices.size(); i += 3) {
        const std::array corners{part.indices[i], part.indices[i + 1], part.indices[i + 2]};
        const glm::dvec3 first(part.positions[corners[0]]);
        const glm::dvec3 p = glm::dvec3(part.positions[corners[1]]) - first;
        const glm::dvec3 q = glm::dvec3(part.positions[corners[2]]) - first;
        const glm::dvec2 start(part.texture_coordinates[corners[0]]);
        const glm::dvec2 s = glm::dvec2(part.texture_coordinates[corners[1]]) - start;
        const glm::dvec2 t = glm::dvec2(part.texture_coordinates[corners[2]]) - start;
        const double side = s.x * t.y - s.y * t.x < 0.0 ? -1.0 : 1.0;
        for (const std::uint32_t corner : corners) {
            along_u[corner] += side * (p * t.y - q * s.y);
            along_v[corner] += side * (q * s.x - p * t.x);
        }
    }
    part.tangents.clear();
    for (std::size_t i = 0; i < part.positions.size(); ++i) {
        const glm::dvec3 normal(part.normals[i]);
        const glm::dvec3 u = along_u[i] - glm::dot(along_u[i], normal) * normal;
        const double length = std::sqrt(glm::dot(u, u));
        const double whole = std::sqrt(glm::dot(along_u[i], along_u[i]));
        if (!(length > 1e-6 * whole) || !std::isfinite(length)) {
            part.tangents.emplace_back(any_orthogonal(part.normals[i]), 1.0F);
            continue;
        }
        // The bitangent points to the top of the picture, where v is 0.
        const double sign = glm::dot(glm::cross(normal, u), along_v[i]) > 0.0 ? -1.0 : 1.0;
        part.tangents.emplace_back(glm::vec3(u / length), static_cast<float>(sign));
    }
}

} // namespace lsys
