// SPDX-License-Identifier: MIT
#include "runtime/meshing/texture.h"
#include "runtime/terrain/terrain.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

using lsys::GreyMap;
using lsys::HeightFilter;
using lsys::HeightMapOptions;
using lsys::make_terrain_mesh;
using lsys::Mesh;
using lsys::NoiseOptions;
using lsys::Region;
using lsys::Result;
using lsys::Terrain;
using lsys::TerrainMeshOptions;

namespace {

constexpr Region kGround{-500.0, -300.0, 1000.0, 600.0};

GreyMap
map_of(std::uint32_t columns, std::uint32_t rows, const std::vector<std::uint16_t>& values) {
    GreyMap map{columns, rows, {}};
    map.values.assign(values.begin(), values.end());
    return map;
}

/// A map with grey = 100 column + 1,000 row: a plane, which each filter must reproduce exactly.
GreyMap plane(std::uint32_t columns, std::uint32_t rows) {
    std::vector<std::uint16_t> values;
    for (std::uint32_t row = 0; row < rows; ++row) {
        for (std::uint32_t column = 0; column < columns; ++column) {
            values.push_back(static_cast<std::uint16_t>(100 * column + 1000 * row));
        }
    }
    return map_of(columns, rows, values);
}

template <typename T>
std::string terrain_error_of(const Result<T>& result) {
    REQUIRE_FALSE(result);
    return result.error().message;
}

double length(glm::vec3 v) {
    return std::sqrt(static_cast<double>(v.x * v.x + v.y * v.y + v.z * v.z));
}

} // namespace

TEST_CASE("a flat terrain is level") {
    const Terrain terrain = Terrain::flat(kGround, 12.5).value();
    CHECK(terrain.height(-400.0F, 100.0F) == 12.5F);
    CHECK(terrain.slope(3.0F, 4.0F) == 0.0F);
    CHECK(terrain.normal(3.0F, 4.0F) == glm::vec3(0.0F, 1.0F, 0.0F));
}

TEST_CASE("noise stays within its heights and depends only on its seed") {
    NoiseOptions options;
    options.height = 80.0;
    options.base = 10.0;
    options.feature = 60.0;
    const Terrain terrain = Terrain::noise(kGround, options).value();
    const Terrain again = Terrain::noise({0.0, 0.0, 10.0, 10.0}, options).value();
    options.seed = std::uint64_t{1} << 40; // all 64 bits of a seed matter
    const Terrain other = Terrain::noise(kGround, options).value();
    float lowest = 1.0e9F;
    float highest = -1.0e9F;
    int differences = 0;
    for (int i = 0; i < 20'000; ++i) {
        const float x = static_cast<float>(i % 200) * 5.0F - 500.0F;
        const float z = static_cast<float>(i / 200) * 6.0F - 300.0F;
        const float height = terrain.height(x, z);
        lowest = std::min(lowest, height);
        highest = std::max(highest, height);
        REQUIRE(again.height(x, z) == height);
        differences += other.height(x, z) != height ? 1 : 0;
    }
    CHECK(lowest >= 10.0F);
    CHECK(highest <= 90.0F);
    CHECK(highest - lowest > 20.0F); // it has hills
    CHECK(differences > 19'900);
}

TEST_CASE("noise is continuous: neighbouring heights differ as the slope says, also far from the "
          "origin") {
    NoiseOptions options;
    options.octaves = 3;
    const Terrain terrain = Terrain::noise(kGround, options).value();
    for (const float origin : {0.0F, -400.0F, 300'000.0F}) {
        for (int i = 0; i < 5'000; ++i) {
            const float x = origin + static_cast<float>(i) * 0.25F;
            const float rise = terrain.height(x + 0.25F, 7.0F) - terrain.height(x, 7.0F);
            REQUIRE(std::abs(rise) < 0.5F);
        }
    }
}

TEST_CASE("octaves differ by lacunarity and gain") {
    NoiseOptions smooth;
    smooth.octaves = 1;
    NoiseOptions rough = smooth;
    rough.octaves = 8;
    rough.gain = 0.7;
    const Terrain calm = Terrain::noise(kGround, smooth).value();
    const Terrain wild = Terrain::noise(kGround, rough).value();
    double calm_slope = 0.0;
    double wild_slope = 0.0;
    for (int i = 0; i < 1'000; ++i) {
        const float x = static_cast<float>(i) - 500.0F;
        calm_slope += static_cast<double>(calm.slope(x, 11.0F));
        wild_slope += static_cast<double>(wild.slope(x, 11.0F));
    }
    CHECK(wild_slope > 3.0 * calm_slope);
    CHECK(calm.slope_step() == Approx(250.0 / 32.0));
    CHECK(wild.slope_step() == Approx(250.0 / 128.0 / 32.0));
}

TEST_CASE("both filters interpolate the pixels and reproduce a plane") {
    for (const HeightFilter filter : {HeightFilter::Bilinear, HeightFilter::Bicubic}) {
        const Terrain terrain =
            Terrain::height_map(kGround, plane(11, 7), {0.0, 65.535, filter}).value();
        // A grey value is 1 mm; columns and rows are 100 m apart.
        CHECK(terrain.height(-500.0F, -300.0F) == Approx(0.0).margin(1e-6));
        CHECK(terrain.height(500.0F, 300.0F) == Approx(1.0 + 6.0));
        CHECK(terrain.height(-150.0F, 25.0F) == Approx(0.35 + 3.25));
        CHECK(terrain.height(-499.0F, 299.0F) == Approx(0.001 + 5.99));
        CHECK(terrain.height(-900.0F, -300.0F) ==
              Approx(0.0).margin(1e-6)); // constant beyond the map
        for (const float x : {-500.0F, 0.0F, 500.0F}) {
            const glm::vec3 normal = terrain.normal(x, 10.0F);
            CHECK(normal.x == Approx(-0.001).epsilon(1e-3));
            CHECK(normal.z == Approx(-0.01).epsilon(1e-3));
            CHECK(length(normal) == Approx(1.0));
            CHECK(terrain.slope(x, 10.0F) == Approx(std::sqrt(0.001 * 0.001 + 0.01 * 0.01)));
        }
    }
}

TEST_CASE("bicubic heights are smooth where bilinear heights have an edge") {
    const GreyMap ridge = map_of(5, 2, {0, 0, 60000, 0, 0, 0, 0, 60000, 0, 0});
    const Region ground{0.0, 0.0, 4.0, 1.0};
    const auto fold = [&](HeightFilter filter) {
        const Terrain terrain = Terrain::height_map(ground, ridge, {0.0, 65.535, filter}).value();
        const float e = 1.0F / 64.0F;
        const float left = terrain.height(2.0F, 0.5F) - terrain.height(2.0F - e, 0.5F);
        const float right = terrain.height(2.0F + e, 0.5F) - terrain.height(2.0F, 0.5F);
        return std::abs(right - left) / e;
    };
    CHECK(fold(HeightFilter::Bilinear) == Approx(120.0).epsilon(0.01));
    CHECK(fold(HeightFilter::Bicubic) < 6.0F);
}

TEST_CASE("every vertex of the ground's mesh lies at the height of its place") {
    NoiseOptions options;
    const Terrain terrain = Terrain::noise(kGround, options).value();
    TerrainMeshOptions mesh_options;
    mesh_options.columns = 37;
    mesh_options.rows = 21;
    mesh_options.texture_size = 10.0;
    mesh_options.threads = 1;
    const Mesh mesh = make_terrain_mesh(terrain, mesh_options).value();
    REQUIRE(mesh.positions.size() == 38 * 22);
    REQUIRE(mesh.normals.size() == mesh.positions.size());
    REQUIRE(mesh.texture_coordinates.size() == mesh.positions.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec3 at = mesh.positions[i];
        REQUIRE(at.y == terrain.height(at.x, at.z));
        REQUIRE(mesh.normals[i] == terrain.normal(at.x, at.z));
        REQUIRE(length(mesh.normals[i]) == Approx(1.0));
        REQUIRE(mesh.texture_coordinates[i].x == Approx((at.x + 500.0F) / 10.0F).margin(1e-4));
    }
    CHECK(mesh.positions.front().x == -500.0F);
    CHECK(mesh.positions.back().x == 500.0F);
    CHECK(mesh.positions.back().z == 300.0F);
    // Faces look up and cover the ground.
    REQUIRE(mesh.indices.size() == 6 * 37 * 21);
    double area = 0.0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::vec3 a = mesh.positions[mesh.indices[i]];
        const glm::vec3 b = mesh.positions[mesh.indices[i + 1]];
        const glm::vec3 c = mesh.positions[mesh.indices[i + 2]];
        const double twice =
            static_cast<double>((b.z - a.z) * (c.x - a.x) - (b.x - a.x) * (c.z - a.z));
        REQUIRE(twice > 0.0);
        area += 0.5 * twice;
    }
    CHECK(area == Approx(600'000.0));

    mesh_options.threads = 2;
    const Mesh same = make_terrain_mesh(terrain, mesh_options).value();
    CHECK(same.positions == mesh.positions);
    CHECK(same.normals == mesh.normals);
    CHECK(same.indices == mesh.indices);
}

TEST_CASE("pictures of the ground are tiled from their origin") {
    const Terrain terrain = Terrain::noise(kGround, NoiseOptions{}).value();
    TerrainMeshOptions options;
    options.columns = 16;
    options.rows = 12;
    options.tangents = true;
    options.pictures.colour =
        std::make_shared<const lsys::Texture>(lsys::Texture{1, 1, {10, 20, 30, 255}});
    options.pictures.normals = options.pictures.colour;
    options.pictures.origin_x = 3.0;
    options.pictures.origin_z = -1.0;
    options.pictures.width = 8.0;
    options.pictures.depth = 5.0;
    const Mesh mesh = make_terrain_mesh(terrain, options).value();
    const glm::vec2 first = mesh.texture_coordinates.front();
    CHECK((first.x >= 0.0F && first.x < 1.0F));
    CHECK((first.y >= 0.0F && first.y < 1.0F));
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec3 at = mesh.positions[i];
        const glm::vec2 uv = mesh.texture_coordinates[i];
        // Texture coordinates are the distance from the origin in tiles plus a whole number.
        const float tiles_x = uv.x - (at.x - 3.0F) / 8.0F;
        const float tiles_z = uv.y - (at.z + 1.0F) / 5.0F;
        REQUIRE(tiles_x == Approx(std::round(tiles_x)).margin(1e-4));
        REQUIRE(tiles_z == Approx(std::round(tiles_z)).margin(1e-4));
        const glm::vec4 tangent = mesh.tangents[i];
        const glm::vec3 along(tangent);
        REQUIRE(glm::dot(along, mesh.normals[i]) == Approx(0.0).margin(1e-5));
        REQUIRE(glm::dot(along, along) == Approx(1.0));
        REQUIRE(along.x > 0.0F);
        REQUIRE(along.z == 0.0F);
        REQUIRE(tangent.w == 1.0F);
    }
    CHECK(mesh.materials[0].picture == options.pictures.colour);
    CHECK(mesh.materials[0].normal_map == options.pictures.normals);
    CHECK(mesh.materials[0].textured);
    CHECK(mesh.materials[0].colour == glm::vec4(1.0F));
    options.pictures.depth = 0.0;
    CHECK_FALSE(make_terrain_mesh(terrain, options));
}

TEST_CASE("messages about invalid terrains have the reason") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinite = std::numeric_limits<double>::infinity();
    CHECK(terrain_error_of(Terrain::flat({0.0, 0.0, 0.0, 5.0})) ==
          "a ground of 0 by 5 m; both sides must be above 0");
    CHECK_FALSE(Terrain::flat({0.0, 0.0, nan, 5.0}));
    CHECK_FALSE(Terrain::flat({0.0, 0.0, 5.0, -1.0}));
    CHECK_FALSE(Terrain::flat({nan, 0.0, 5.0, 5.0}));
    CHECK_FALSE(Terrain::flat({0.0, 0.0, infinite, 5.0}));
    CHECK_FALSE(Terrain::flat({0.0, 0.0, 2.0e6, 5.0}));
    CHECK_FALSE(Terrain::flat(kGround, nan));
    CHECK(terrain_error_of(Terrain::height_map(kGround, map_of(1, 1, {7}), {})) ==
          "a height map of 1 by 1 pixels; it takes at least 2 by 2");
    CHECK_FALSE(Terrain::height_map(kGround, map_of(2, 1, {7, 7}), {}));
    CHECK(terrain_error_of(
              Terrain::height_map(kGround, plane(2, 2), {0.0, infinite, HeightFilter::Bilinear})) ==
          "the highest height of the terrain is inf m; it must be from -1000000 to 1000000");
    NoiseOptions options;
    options.octaves = 0;
    CHECK(terrain_error_of(Terrain::noise(kGround, options)) ==
          "the octaves of the terrain's noise is 0; it must be from 1 to 16");
    options = {};
    options.gain = nan;
    CHECK_FALSE(Terrain::noise(kGround, options));
    options = {};
    options.feature = 0.0;
    CHECK_FALSE(Terrain::noise(kGround, options));
    const Terrain terrain = Terrain::flat(kGround).value();
    CHECK_FALSE(make_terrain_mesh(terrain, {0, 5, 0.0, 1, {}, false}));
    CHECK_FALSE(make_terrain_mesh(terrain, {65'536, 65'536, 0.0, 1, {}, false}));
    CHECK_FALSE(make_terrain_mesh(terrain, {5, 5, nan, 1, {}, false}));
}

TEST_CASE("a mesh of the ground is nowhere farther from it than its error") {
    NoiseOptions noise;
    noise.octaves = 5;
    noise.feature = 80.0;
    noise.height = 40.0;
    std::vector<std::uint16_t> values;
    std::uint32_t state = 7;
    for (int i = 0; i < 40 * 25; ++i) {
        state = state * 1664525U + 1013904223U;
        values.push_back(static_cast<std::uint16_t>(state >> 16U));
    }
    std::vector<Terrain> grounds;
    grounds.push_back(Terrain::noise(kGround, noise).value());
    for (const HeightFilter filter : {HeightFilter::Bilinear, HeightFilter::Bicubic}) {
        HeightMapOptions options;
        options.highest = 30.0;
        options.filter = filter;
        grounds.push_back(Terrain::height_map(kGround, map_of(40, 25, values), options).value());
    }
    for (const Terrain& ground : grounds) {
        for (const double cell : {0.5, 4.0, 12.0, 60.0}) {
            const double bound = ground.mesh_error(cell);
            double worst = 0.0;
            for (int i = 0; i < 4000; ++i) {
                state = state * 1664525U + 1013904223U;
                const auto column = static_cast<float>(state >> 24U);
                state = state * 1664525U + 1013904223U;
                const auto row = static_cast<float>(state >> 24U);
                const auto side = static_cast<float>(cell);
                const float x = -500.0F + std::fmod(column * side, 900.0F);
                const float z = -300.0F + std::fmod(row * side, 500.0F);
                // The middles of the two legs and of the diagonal.
                const float corner = ground.height(x, z);
                const float right = ground.height(x + side, z);
                const float below = ground.height(x, z + side);
                const float across = ground.height(x + side, z + side);
                const auto off = [&](float a, float b, float part_x, float part_z) {
                    const float there = ground.height(x + part_x * side, z + part_z * side);
                    worst = std::max(worst, std::abs(static_cast<double>(0.5F * (a + b) - there)));
                };
                off(corner, right, 0.5F, 0.0F);
                off(corner, below, 0.0F, 0.5F);
                off(corner, across, 0.5F, 0.5F);
                off(right, below, 0.5F, 0.5F);
            }
            INFO(cell);
            CHECK(worst <= bound + 1e-4); // heights are binary32
            CHECK(worst > 0.002 * bound);
        }
    }
    CHECK(Terrain::flat(kGround, 3.0).value().mesh_error(100.0) == 0.0);
}

TEST_CASE("the heights of a grid are those of its points") {
    const auto check = [](const Result<Terrain>& terrain) {
        REQUIRE(terrain);
        std::vector<float> x;
        std::vector<float> z;
        for (int i = 0; i < 67; ++i) {
            x.push_back(-520.0F + 13.1F * static_cast<float>(i));
            z.push_back(0.37F * static_cast<float>(i * i));
        }
        const std::vector<float> heights = terrain.value().heights(x, z);
        REQUIRE(heights.size() == x.size() * z.size());
        std::size_t different = 0;
        for (std::size_t i = 0; i < heights.size(); ++i) {
            different +=
                heights[i] == terrain.value().height(x[i % x.size()], z[i / x.size()]) ? 0U : 1U;
        }
        CHECK(different == 0);
    };
    check(Terrain::flat(kGround, 12.5));
    NoiseOptions noise;
    noise.seed = 4;
    noise.feature = 90.0;
    check(Terrain::noise(kGround, noise));
    for (const HeightFilter filter : {HeightFilter::Bilinear, HeightFilter::Bicubic}) {
        HeightMapOptions options;
        options.filter = filter;
        check(Terrain::height_map(kGround, plane(9, 7), options));
    }
    CHECK(Terrain::flat(kGround).value().heights({}, {}).empty());
}
