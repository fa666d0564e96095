// SPDX-License-Identifier: MIT
#include "runtime/tiles/impl/canopy.h"

#include <catch2/catch.hpp>

#include <cmath>

namespace lsys {
namespace {

/// A level rectangle of 2 by 3 m at a height of 5 m, and a vertex that no triangle uses.
Mesh table() {
    Mesh mesh;
    mesh.positions = {{0, 5, 0}, {0, 5, 3}, {2, 5, 3}, {2, 5, 0}, {1, 1, 1}};
    LargeVector<std::uint32_t> indices{0, 1, 2, 0, 2, 3};
    mesh.indices = TriangleList(std::move(indices));
    Material material;
    material.colour = {0.2F, 0.4F, 0.6F, 1.0F};
    mesh.materials.push_back(material);
    mesh.parts.push_back({0, 0, 6});
    return mesh;
}

TEST_CASE("a crown has the area, height and colour that are seen from above") {
    const Crown crown = crown_of(table());
    CHECK(crown.area == Approx(6.0).epsilon(0.01));
    CHECK(crown.height == Approx(5.0));
    CHECK(crown.colour.y == Approx(0.4));
    CHECK(crown_of({}).area == 0.0);
}

TEST_CASE("parts below another part of a crown are not seen") {
    Mesh mesh = table();
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const glm::vec3& corner : {glm::vec3(0, 9, 0), glm::vec3(0, 9, 3), glm::vec3(2, 9, 3)}) {
        mesh.positions.push_back(corner);
    }
    LargeVector<std::uint32_t> indices{0, 1, 2, 0, 2, 3, first, first + 1, first + 2};
    mesh.indices = TriangleList(std::move(indices));
    mesh.parts.front().index_count = 9;
    const Crown crown = crown_of(mesh);
    CHECK(crown.area == Approx(6.0).epsilon(0.01));
    CHECK(crown.height == Approx(7.0).epsilon(0.02)); // half at 9 m, half at 5 m
}

TEST_CASE("a coarser canopy has the same cover and height on average") {
    const Crown crown{12.0, 8.0, {0.1, 0.3, 0.05}};
    Canopy canopy(64, 5.0);
    std::uint32_t state = 1;
    for (int i = 0; i < 3000; ++i) {
        state = state * 1664525U + 1013904223U;
        canopy.add(state >> 26U, (state >> 20U) & 63U, crown, 0.5 + (state >> 8U & 0xFFU) / 255.0);
    }
    const auto mean = [](const Canopy& level, auto value) {
        double sum = 0.0;
        for (std::uint32_t row = 0; row <= level.side(); ++row) {
            for (std::uint32_t column = 0; column <= level.side(); ++column) {
                // A corner on the border represents half of the area of an inner corner.
                const double part = (row % level.side() == 0 ? 0.5 : 1.0) *
                                    (column % level.side() == 0 ? 0.5 : 1.0);
                sum += part * value(level.at_corner(column, row));
            }
        }
        return sum / (level.side() * level.side());
    };
    const auto height = [](const CanopyPoint& point) { return point.height; };
    const double fine = mean(canopy, height);
    Canopy coarse = canopy.coarser();
    CHECK(mean(coarse, height) == Approx(fine).epsilon(0.02));
    CHECK(mean(coarse.coarser(), height) == Approx(fine).epsilon(0.03));
    CHECK(coarse.at_corner(3, 3).colour.y == Approx(0.3).epsilon(1e-5));
}

TEST_CASE("crowns at independent places cover 1 - exp(-area) of the ground") {
    for (const double area : {0.01, 0.3, 1.0, 2.5}) {
        Canopy canopy(1, 10.0);
        for (int i = 0; i < 1000; ++i) {
            canopy.add(0, 0, {0.1 * area, 4.0, {0.0, 0.0, 0.0}}, 1.0);
        }
        const CanopyPoint point = canopy.at_corner(0, 0);
        CHECK(point.cover == Approx(1.0 - std::exp(-area)).epsilon(0.01));
        CHECK(point.height == Approx(4.0 * point.cover));
    }
    CHECK(Canopy(2, 1.0).at_corner(1, 1).cover == 0.0);
}

} // namespace
} // namespace lsys
