// SPDX-License-Identifier: MIT
#include "runtime/meshing/looks.h"
#include "runtime/meshing/mesh_film.h"

#include <catch2/catch.hpp>

#include <memory>
#include <utility>

using namespace lsys;

namespace {

/// Triangles above one another, from `height` on.
Mesh triangles(std::uint32_t count, float height, const std::string& material) {
    Mesh mesh;
    for (std::uint32_t i = 0; i < count; ++i) {
        const float y = height + static_cast<float>(i);
        for (const glm::vec3 corner :
             {glm::vec3(0, y, 0), glm::vec3(1, y, 0), glm::vec3(0, y, 1)}) {
            mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
            mesh.positions.push_back(corner);
            mesh.normals.emplace_back(0.0F, 1.0F, 0.0F);
        }
    }
    mesh.materials.emplace_back().name = material;
    mesh.parts.push_back({0, 0, std::uint64_t{3} * count});
    return mesh;
}

} // namespace

TEST_CASE("frames with the same triangles are one shape") {
    MeshFilmBuilder builder(12.0F);
    builder.add(triangles(1, 0.0F, "bark"));
    builder.add(triangles(1, 0.5F, "bark"));
    builder.add(triangles(1, 1.0F, "bark"));
    builder.add(triangles(2, 1.0F, "bark"));
    builder.add(triangles(2, 2.0F, "leaf")); // another material is another shape
    builder.add(triangles(2, 3.0F, "leaf"));
    const std::uint64_t bytes = builder.byte_count();
    const MeshFilm film = builder.finish();

    CHECK(film.frames_per_second == 12.0F);
    CHECK(film.frame_count() == 6);
    REQUIRE(film.shapes.size() == 3);
    CHECK(film.shapes[0].first_frame == 0);
    CHECK(film.shapes[1].first_frame == 3);
    CHECK(film.shapes[2].first_frame == 4);
    REQUIRE(film.shapes[0].earlier.size() == 2);
    CHECK(film.shapes[0].earlier[0].positions[0].y == 0.0F);
    CHECK(film.shapes[0].earlier[1].positions[0].y == 0.5F);
    CHECK(film.shapes[1].earlier.empty());
    REQUIRE(film.shapes[2].earlier.size() == 1);
    CHECK(film.shapes[2].earlier[0].positions[3].y == 3.0F);
    CHECK(film.byte_count() == bytes);
}

TEST_CASE("the mesh of a film holds the last frame of each shape") {
    MeshFilmBuilder builder(24.0F);
    builder.add(triangles(1, 0.0F, "bark"));
    builder.add(triangles(1, 0.5F, "bark"));
    builder.add(triangles(2, 1.0F, "bark"));
    builder.add(triangles(1, 7.0F, "leaf"));
    const MeshFilm film = builder.finish();

    const Mesh& mesh = film.mesh;
    REQUIRE(mesh.positions.size() == 12);
    CHECK(mesh.positions[0].y == 0.5F);
    CHECK(mesh.positions[3].y == 1.0F);
    CHECK(mesh.positions[6].y == 2.0F);
    CHECK(mesh.positions[9].y == 7.0F);
    CHECK(mesh.normals.size() == 12);
    REQUIRE(mesh.indices.size() == 12);
    for (std::uint32_t i = 0; i < 12; ++i) {
        CHECK(mesh.indices[i] == i);
    }
    REQUIRE(mesh.materials.size() == 2);
    CHECK(mesh.materials[0].name == "bark");
    CHECK(mesh.materials[1].name == "leaf");
    REQUIRE(mesh.parts.size() == 3);
    CHECK(mesh.parts[1].material == 0);
    CHECK(mesh.parts[1].first_index == 3);
    CHECK(mesh.parts[1].index_count == 6);
    CHECK(mesh.parts[2].material == 1);
    CHECK(film.shapes[1].first_vertex == 3);
    CHECK(film.shapes[1].first_part == 1);
    CHECK(film.shapes[2].first_vertex == 9);
    CHECK(film.shapes[2].first_part == 2);
}

TEST_CASE("the mesh of a film has the looks of its frames") {
    const auto looks = std::make_shared<const Looks>();
    MeshFilmBuilder builder(24.0F);
    for (const std::uint32_t count : {1U, 2U}) {
        Mesh frame = triangles(count, 0.0F, "bark");
        frame.looks = looks;
        builder.add(std::move(frame));
    }
    CHECK(builder.finish().mesh.looks == looks);
}

TEST_CASE("a film without frames is empty") {
    MeshFilmBuilder builder(24.0F);
    const MeshFilm film = builder.finish();
    CHECK(film.frame_count() == 0);
    CHECK(film.shapes.empty());
    CHECK(film.mesh.positions.empty());
}
