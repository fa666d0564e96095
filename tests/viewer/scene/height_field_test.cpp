// SPDX-License-Identifier: MIT
// Compares picking on a height field with a test of every triangle (Moeller and Trumbore 1997).
#include "runtime/base/random.h"
#include "viewer/scene/height_field.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

using namespace lsys;
using namespace lsys::view;

namespace {

std::optional<double>
intersect(const Ray& ray, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 ab = b - a;
    const glm::dvec3 ac = c - a;
    const glm::dvec3 p = glm::cross(ray.direction, ac);
    const double determinant = glm::dot(ab, p);
    if (determinant == 0.0) {
        return std::nullopt;
    }
    const glm::dvec3 s = ray.origin - a;
    const double u = glm::dot(s, p) / determinant;
    const glm::dvec3 q = glm::cross(s, ab);
    const double v = glm::dot(ray.direction, q) / determinant;
    const double t = glm::dot(ac, q) / determinant;
    constexpr double kEdge = -1e-9;
    return u >= kEdge && v >= kEdge && u + v <= 1.0 - kEdge && t >= 0.0 ? std::optional(t)
                                                                        : std::nullopt;
}

std::optional<glm::dvec3>
slow_pick(const HeightField& field, const Region& region, const Ray& ray) {
    const auto at = [&](std::uint32_t column, std::uint32_t row) {
        return glm::dvec3(
            region.x + column * region.width / field.columns(),
            static_cast<double>(field.heights()[std::size_t{row} * (field.columns() + 1) + column]),
            region.z + row * region.depth / field.rows());
    };
    std::optional<double> nearest;
    for (std::uint32_t row = 0; row < field.rows(); ++row) {
        for (std::uint32_t column = 0; column < field.columns(); ++column) {
            const glm::dvec3 a = at(column, row);
            const glm::dvec3 b = at(column + 1, row);
            const glm::dvec3 c = at(column, row + 1);
            const glm::dvec3 d = at(column + 1, row + 1);
            for (const auto& t : {intersect(ray, a, b, d), intersect(ray, a, d, c)}) {
                if (t && (!nearest || *t < *nearest)) {
                    nearest = t;
                }
            }
        }
    }
    return nearest ? std::optional(ray.origin + *nearest * ray.direction) : std::nullopt;
}

Terrain hills(const Region& region) {
    NoiseOptions noise;
    noise.feature = 20.0;
    noise.height = 15.0;
    noise.octaves = 4;
    return Terrain::noise(region, noise).value();
}

} // namespace

TEST_CASE("a ray finds the same place as a test of every triangle") {
    const Region region{-30.0, 10.0, 64.0, 48.0};
    const HeightField field(hills(region), GENERATE(37U, 64U), 29);
    std::uint32_t hits = 0;
    for (std::uint32_t i = 0; i < 1500; ++i) {
        const PhiloxBlock a = draw_block(5, 0, i, 0);
        const PhiloxBlock b = draw_block(5, 0, i, 1);
        const auto draw = [](std::uint32_t word, double low, double high) {
            return low + (high - low) * static_cast<double>(unit_interval(word));
        };
        Ray ray;
        ray.origin = {draw(a[0], -60.0, 60.0), draw(a[1], 16.0, 40.0), draw(a[2], -30.0, 90.0)};
        // Include grazing rays, which pass many ridges.
        const glm::dvec3 target{draw(b[0], -30.0, 34.0), draw(b[1], 0.0, 16.0),
                                draw(b[2], 10.0, 58.0)};
        ray.direction = (target - ray.origin) * draw(b[3], 0.1, 3.0);
        CAPTURE(i);
        const auto fast = field.pick(ray);
        const auto slow = slow_pick(field, region, ray);
        // Skip rays that enter from the side, below the surface at the border.
        const bool at_border = fast && (std::abs(fast->x - region.x) < 1e-6 ||
                                        std::abs(fast->x - region.x - region.width) < 1e-6 ||
                                        std::abs(fast->z - region.z) < 1e-6 ||
                                        std::abs(fast->z - region.z - region.depth) < 1e-6);
        if (at_border) {
            continue;
        }
        CHECK(fast.has_value() == slow.has_value());
        if (fast && slow) {
            ++hits;
            CHECK(glm::distance(*fast, *slow) < 1e-6);
        }
    }
    CHECK(hits > 500);
}

TEST_CASE("rays along axes, straight down and away from the ground") {
    const Region region{0.0, 0.0, 32.0, 32.0};
    const Terrain terrain = hills(region);
    const HeightField field(terrain, 32, 32);
    for (const double x : {0.0, 7.0, 7.5, 32.0}) { // on borders of cells and between them
        const auto down = field.pick({{x, 100.0, 5.0}, {0.0, -2.0, 0.0}});
        REQUIRE(down);
        CHECK(down->x == x);
        CHECK(down->y <= 15.0);
        CHECK_FALSE(field.pick({{x, 100.0, 5.0}, {0.0, 1.0, 0.0}}));
    }
    CHECK(field.pick({{7.0, 100.0, 9.0}, {0.0, -1.0, 0.0}})->y ==
          Approx(static_cast<double>(terrain.height(7.0F, 9.0F))));
    CHECK(field.pick({{-50.0, 3.0, 16.0}, {1.0, 0.0, 0.0}}).has_value() ==
          (field.heights()[16 * 33] > 3.0F ||
           *std::max_element(field.heights().begin() + 16 * 33, field.heights().begin() + 17 * 33) >
               3.0F));
    CHECK_FALSE(field.pick({{-50.0, 30.0, 16.0}, {1.0, 0.0, 0.0}}));
    CHECK_FALSE(field.pick({{-50.0, 3.0, 16.0}, {-1.0, 0.0, 0.0}}));
    CHECK_FALSE(field.pick({{40.0, 30.0, 40.0}, {0.0, -1.0, 0.0}}));
}

TEST_CASE("no ray from above passes between cells") {
    const Region region{0.0, 0.0, 10.0, 10.0};
    const HeightField field(hills(region), 333, 77);
    for (std::uint32_t i = 0; i < 20'000; ++i) {
        const PhiloxBlock a = draw_block(6, 0, i, 0);
        const glm::dvec3 target{10.0 * static_cast<double>(unit_interval(a[0])), -5.0,
                                10.0 * static_cast<double>(unit_interval(a[1]))};
        CHECK(field.pick({{5.0, 25.0, 5.0}, target - glm::dvec3(5.0, 25.0, 5.0)}));
    }
}
