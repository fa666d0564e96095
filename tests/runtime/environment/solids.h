// SPDX-License-Identifier: MIT
// Meshes that tests of environments use.
#pragma once

#include "runtime/environment/environment.h"

#include <array>
#include <cmath>
#include <cstdint>

namespace lsys::environments {

/// A cube from `low` to `low` + `edge` in all axes. Its faces are counter-clockwise seen from
/// outside.
inline EnvironmentMesh cube_mesh(const Vector3& low, double edge) {
    EnvironmentMesh mesh;
    for (std::uint32_t corner = 0; corner < 8; ++corner) {
        const auto bit = [&](std::uint32_t axis) { return (corner >> axis & 1) != 0 ? edge : 0.0; };
        mesh.vertices.push_back({low[0] + bit(0), low[1] + bit(1), low[2] + bit(2)});
    }
    constexpr std::array<std::array<std::uint32_t, 4>, 6> kFaces{
        {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
    for (const std::array<std::uint32_t, 4>& face : kFaces) {
        mesh.triangles.push_back({face[0], face[1], face[2]});
        mesh.triangles.push_back({face[0], face[2], face[3]});
    }
    return mesh;
}

/// A sphere of `rings` by 2 * `rings` quads; the quads at the poles are triangles.
inline EnvironmentMesh sphere_mesh(const Vector3& middle, double radius, std::uint32_t rings) {
    constexpr double kPi = 3.14159265358979323846;
    EnvironmentMesh mesh;
    const std::uint32_t columns = 2 * rings;
    const auto add = [&](double x, double y, double z) {
        mesh.vertices.push_back(
            {middle[0] + radius * x, middle[1] + radius * y, middle[2] + radius * z});
    };
    add(0.0, 1.0, 0.0);
    for (std::uint32_t ring = 1; ring < rings; ++ring) {
        const double polar = kPi * ring / rings;
        for (std::uint32_t column = 0; column < columns; ++column) {
            const double azimuth = 2.0 * kPi * column / columns;
            add(std::sin(polar) * std::cos(azimuth), std::cos(polar),
                std::sin(polar) * std::sin(azimuth));
        }
    }
    add(0.0, -1.0, 0.0);
    const auto at = [&](std::uint32_t ring, std::uint32_t column) {
        return 1 + (ring - 1) * columns + column % columns;
    };
    const auto last = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
    for (std::uint32_t column = 0; column < columns; ++column) {
        mesh.triangles.push_back({0, at(1, column + 1), at(1, column)});
        for (std::uint32_t ring = 1; ring + 1 < rings; ++ring) {
            mesh.triangles.push_back(
                {at(ring, column), at(ring, column + 1), at(ring + 1, column + 1)});
            mesh.triangles.push_back(
                {at(ring, column), at(ring + 1, column + 1), at(ring + 1, column)});
        }
        mesh.triangles.push_back({at(rings - 1, column), at(rings - 1, column + 1), last});
    }
    return mesh;
}

} // namespace lsys::environments
