// SPDX-License-Identifier: MIT
#include "runtime/meshing/impl/mesh_builder.h"

#include <catch2/catch.hpp>

#include <array>
#include <span>
#include <utility>
#include <vector>

namespace lsys {

namespace {

void number(std::span<std::uint32_t> indices, const MeshBlock& block) {
    for (std::size_t i = 0; i < indices.size(); ++i) {
        indices[i] = block.first_vertex + static_cast<std::uint32_t>(i % block.positions.size());
    }
}

void fill(const MeshBlock& block, float value) {
    for (std::size_t i = 0; i < block.positions.size(); ++i) {
        block.set(i, {.position = {value, 0, 0}, .normal = {0, 1, 0}, .palette = 7});
    }
    number(block.indices, block);
}

} // namespace

TEST_CASE("whole parts keep their triangles unchanged", "[mesh]") {
    Mesh mesh;
    const MeshOptions options{.texture_coordinates = false, .tangents = false, .colours = false};
    MeshBuilder builder(options, mesh);
    std::vector<MeshBuilder::WholePart> parts(3);
    parts[0].material = wood_material(0);
    parts[0].triangles.append_bands({.first = 0, .sides = 3}, 1000);
    parts[1].material = wood_material(1);
    parts[2].material = wood_material(2);
    parts[2].triangles = {5, 6, 7};
    const std::uint64_t bytes = parts[0].triangles.byte_count();
    CHECK(bytes < 100);
    MeshBlock block;
    REQUIRE(builder.place_parts(std::move(parts), 3003, block));
    fill(block, 1);
    REQUIRE(builder.reserve(builder.part(wood_material(0)), 3, 3, block));
    fill(block, 2);
    REQUIRE(builder.finish() == std::nullopt);
    REQUIRE(mesh.parts.size() == 2);
    CHECK(mesh.parts[0].index_count == 18'003);
    CHECK(mesh.parts[1].first_index == 18'003);
    CHECK(mesh.indices.size() == 18'006);
    CHECK(mesh.indices[17'999] == 3002);
    CHECK(mesh.indices[18'000] == 3003);
    CHECK(mesh.indices[18'005] == 7);
    CHECK(mesh.byte_count() == 3006 * 24 + bytes + 6 * 4);
}

TEST_CASE("parts made in place come first, the others by material", "[mesh]") {
    Mesh mesh;
    const MeshOptions options;
    MeshBuilder builder(options, mesh);
    const std::array<MeshBuilder::PartSize, 2> sizes{
        {{wood_material(0), 3, "wood"}, {wood_material(4), 6, "wood"}}};
    MeshBlock block;
    std::vector<std::span<std::uint32_t>> indices;
    REQUIRE(builder.reserve_parts(sizes, 3, block, indices));
    REQUIRE(indices.size() == 2);
    fill(block, 1);
    number(indices[0], block);
    number(indices[1], block);
    REQUIRE(builder.reserve(builder.part({.kind = MaterialKind::Flower}), 3, 3, block));
    fill(block, 2);
    REQUIRE(builder.reserve(builder.part({.kind = MaterialKind::Leaf}), 3, 3, block));
    fill(block, 3);
    REQUIRE(builder.reserve(builder.part(wood_material(0)), 3, 3, block)); // adds to the first part
    fill(block, 4);
    REQUIRE(builder.finish() == std::nullopt);

    REQUIRE(mesh.parts.size() == 4);
    CHECK(mesh.materials[0].name == "bark");
    CHECK(mesh.materials[1].name == "wood 4");
    CHECK(mesh.materials[2].kind == MaterialKind::Leaf);
    CHECK(mesh.materials[3].kind == MaterialKind::Flower);
    const std::array<std::uint64_t, 4> counts{6, 6, 3, 3};
    std::uint64_t first = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        CHECK(mesh.parts[i].material == i);
        CHECK(mesh.parts[i].first_index == first);
        CHECK(mesh.parts[i].index_count == counts[i]);
        first += counts[i];
    }
    CHECK(mesh.indices == TriangleList{0, 1, 2, 9, 10, 11, 0, 1, 2, 0, 1, 2, 6, 7, 8, 3, 4, 5});
    CHECK(mesh.positions.size() == 12);
    CHECK(mesh.colours[11] == 7);
}

TEST_CASE("arrays that the options exclude stay empty", "[mesh]") {
    Mesh mesh;
    mesh.tangents.resize(9);
    const MeshOptions options{.texture_coordinates = false, .tangents = false, .colours = false};
    MeshBuilder builder(options, mesh);
    MeshBlock block;
    REQUIRE(builder.reserve(builder.part(wood_material(0)), 3, 3, block));
    fill(block, 1);
    REQUIRE(builder.finish() == std::nullopt);
    CHECK(mesh.texture_coordinates.empty());
    CHECK(mesh.tangents.empty());
    CHECK(mesh.colours.empty());
    CHECK(mesh.byte_count() == 3 * 24 + 3 * 4);
}

TEST_CASE("meshes over a limit are refused before memory is allocated", "[mesh]") {
    Mesh mesh;
    MeshBlock block;
    SECTION("limit of bytes") {
        const MeshOptions options{.texture_coordinates = false,
                                  .tangents = false,
                                  .colours = false,
                                  .max_bytes = 3 * 24 + 3 * 4};
        MeshBuilder builder(options, mesh);
        const std::uint32_t part = builder.part(wood_material(0));
        REQUIRE(builder.reserve(part, 3, 3, block));
        CHECK(builder.stop() == std::nullopt);
        CHECK_FALSE(builder.reserve(part, 0, 1, block));
        CHECK_FALSE(builder.reserve(part, 0, 0, block));
        CHECK(builder.finish() == Stop::Limit);
    }
    SECTION("limit of indices") {
        const MeshOptions options;
        MeshBuilder builder(options, mesh);
        CHECK_FALSE(
            builder.reserve(builder.part(wood_material(0)), std::uint64_t{1} << 32, 3, block));
        CHECK(builder.finish() == Stop::Failed);
    }
    CHECK(mesh.positions.empty());
    CHECK(mesh.indices.empty());
    CHECK(mesh.parts.empty());
}

TEST_CASE("palette colours are distinct and repeat", "[mesh]") {
    for (std::uint32_t i = 0; i < 25; ++i) {
        for (std::uint32_t j = 0; j < i; ++j) {
            CHECK(palette_colour(i) != palette_colour(j));
        }
    }
    CHECK(palette_colour(25) == palette_colour(2));
    CHECK(palette_colour(65535) != palette_colour(0));
}

} // namespace lsys
