// SPDX-License-Identifier: MIT
// Environments of kind Solid: closed forms, and all triangles one after the other.
#include "runtime/environment/closed_mesh.h"
#include "runtime/environment/environment.h"
#include "tests/runtime/environment/clouds.h"
#include "tests/runtime/environment/slow_fields.h"
#include "tests/runtime/environment/solids.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lsys {

namespace {

using environments::cube_mesh;
using environments::random_places;
using environments::same_bits;
using environments::sphere_mesh;
using environments::TestRandom;

struct Solid {
    explicit Solid(std::uint32_t threads) : workers(threads), context{&workers, nullptr, ~0ULL} {
        declared.kind = EnvironmentKind::Solid;
    }

    void add_plane(float a, float b, float c, float d) {
        EnvironmentSurface surface;
        surface.plane = {a, b, c, d};
        declared.surfaces.push_back(surface);
    }

    void add_mesh(EnvironmentMesh mesh) {
        EnvironmentSurface surface;
        surface.path = "mesh.obj";
        declared.surfaces.push_back(surface);
        files.meshes.push_back(std::move(mesh));
    }

    [[nodiscard]] std::optional<EnvironmentFailure> begin() {
        environment = make_solid(declared, files, context);
        return environment->begin(0);
    }

    [[nodiscard]] std::vector<float> answers(const std::vector<SensePlace>& places) {
        REQUIRE_FALSE(begin().has_value());
        return environments::answers_of(*environment, places);
    }

    [[nodiscard]] std::vector<float> answer(const Vector3& place) {
        std::vector<SensePlace> places(1);
        places[0].position = place;
        return answers(places);
    }

    BytecodeEnvironment declared;
    EnvironmentFiles files;
    Workers workers;
    EnvironmentContext context;
    std::unique_ptr<Environment> environment;
};

Vector3 difference(const Vector3& a, const Vector3& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

double product(const Vector3& a, const Vector3& b) {
    return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}

/// Triangles at random: large, small, slivers, without area, twice the same.
EnvironmentMesh random_mesh(TestRandom& random, std::uint32_t count) {
    EnvironmentMesh mesh;
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        const Vector3 middle = random.in_cube(2.0);
        const double size = std::ldexp(1.0, -static_cast<int>(random.below(8)));
        for (std::uint32_t corner = 0; corner < 3; ++corner) {
            const Vector3 offset = random.in_cube(size);
            mesh.vertices.push_back(
                {middle[0] + offset[0], middle[1] + offset[1], middle[2] + offset[2]});
        }
        const std::uint32_t kind = random.below(6);
        Vector3& last = mesh.vertices.back();
        if (kind == 0) { // a sliver, or without area
            for (std::size_t axis = 0; axis < 3; ++axis) {
                last[axis] = 0.5 * (mesh.vertices[first][axis] + mesh.vertices[first + 1][axis]);
            }
        } else if (kind == 1) {
            last = mesh.vertices[first];
        } else if (kind == 2) { // on a grid, in a plane along an axis
            for (std::uint32_t corner = 0; corner < 3; ++corner) {
                for (double& coordinate : mesh.vertices[first + corner]) {
                    coordinate = std::round(2.0 * coordinate) / 2.0;
                }
                mesh.vertices[first + corner][1] = 0.5;
            }
        }
        mesh.triangles.push_back({first, first + 1, first + 2});
        if (random.below(8) == 0) {
            mesh.triangles.push_back({first + 2, first, first + 1});
        }
    }
    // One triangle that is none of the above, so that the mesh has an area.
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), {{0, 0, 0}, {1, 0, 0}, {0, 1, 0.25}});
    mesh.triangles.push_back({first, first + 1, first + 2});
    return mesh;
}

} // namespace

TEST_CASE("distances to meshes are those of all triangles one after the other, bit by bit") {
    for (std::uint32_t seed = 0; seed < 1000; ++seed) {
        TestRandom random(seed);
        const std::vector<SensePlace> places = random_places(random, 30, 2.5);
        std::vector<EnvironmentMesh> meshes;
        const std::uint32_t mesh_count = 1 + random.below(2);
        for (std::uint32_t i = 0; i < mesh_count; ++i) {
            meshes.push_back(random_mesh(random, 1 + random.below(40)));
        }
        std::vector<float> expected;
        for (const SensePlace& place : places) {
            const std::vector<float> answer = slow::nearest(meshes, place.position);
            expected.insert(expected.end(), answer.begin(), answer.end());
        }
        INFO("seed " << seed);
        for (const std::uint32_t threads : {1U, 2U, 5U}) {
            Solid solid(threads);
            for (const EnvironmentMesh& mesh : meshes) {
                solid.add_mesh(mesh);
            }
            REQUIRE(same_bits(solid.answers(places), expected));
        }
    }
}

TEST_CASE("distances to meshes of any size, far from the origin and from places, are the same") {
    for (std::uint32_t seed = 0; seed < 200; ++seed) {
        TestRandom random(seed);
        EnvironmentMesh mesh = random_mesh(random, 1 + random.below(200));
        std::vector<SensePlace> places = random_places(random, 30, 2.5);
        constexpr std::array<int, 6> kExponents{-120, -40, -10, 0, 60, 120};
        const double size = std::ldexp(1.0, kExponents[random.below(6)]);
        const double offset = random.below(2) == 0 ? 0.0 : size * 1e6;
        const auto move = [&](Vector3& point) {
            for (double& coordinate : point) {
                coordinate = coordinate * size + offset;
            }
        };
        std::for_each(mesh.vertices.begin(), mesh.vertices.end(), move);
        for (SensePlace& place : places) {
            move(place.position);
        }
        places.push_back(places.front());
        places.back().position[0] += 1e20 * size; // where binary32 is of no use
        std::vector<float> expected;
        for (const SensePlace& place : places) {
            const std::vector<float> answer = slow::nearest({mesh}, place.position);
            expected.insert(expected.end(), answer.begin(), answer.end());
        }
        INFO("seed " << seed);
        Solid solid(2);
        solid.add_mesh(mesh);
        REQUIRE(same_bits(solid.answers(places), expected));
    }
}

TEST_CASE("a plane is solid on its negative side") {
    Solid solid(1);
    solid.add_plane(0.0F, 2.0F, 0.0F, -2.0F); // y = 1
    CHECK(solid.answer({5.0, 4.0, 3.0}) == std::vector<float>{3, 0, -1, 0});
    CHECK(solid.answer({5.0, -1.0, 3.0}) == std::vector<float>{-2, 0, 1, 0});
    CHECK(solid.answer({5.0, 1.0, 3.0}) == std::vector<float>{0, 0, 0, 0});
}

TEST_CASE("ties go to the first plane, then to meshes in the order of the statement") {
    Solid solid(1);
    SECTION("planes") {
        solid.add_plane(1.0F, 0.0F, 0.0F, 1.0F);
        solid.add_plane(0.0F, 1.0F, 0.0F, 1.0F);
        CHECK(solid.answer({1.0, 1.0, 0.0}) == std::vector<float>{2, -1, 0, 0});
    }
    SECTION("plane and mesh") {
        solid.add_plane(1.0F, 0.0F, 0.0F, 2.0F);
        solid.add_mesh(cube_mesh({2.0, -1.0, -1.0}, 2.0));
        CHECK(solid.answer({0.0, 0.0, 0.0}) == std::vector<float>{2, -1, 0, 0});
    }
    SECTION("meshes") {
        solid.add_mesh(cube_mesh({-3.0, -1.0, -1.0}, 2.0));
        solid.add_mesh(cube_mesh({1.0, -1.0, -1.0}, 2.0));
        CHECK(solid.answer({0.0, 0.0, 0.0}) == std::vector<float>{1, -1, 0, 0});
    }
    SECTION("triangles") {
        solid.add_mesh(cube_mesh({-1.0, -1.0, -1.0}, 2.0));
        CHECK(solid.answer({0.0, 0.0, 0.0}) == std::vector<float>{-1, -1, 0, 0});
    }
}

TEST_CASE("a place is negative inside any solid, though another surface is nearer") {
    Solid solid(1);
    solid.add_mesh(cube_mesh({-5.0, -5.0, -5.0}, 10.0));
    solid.add_mesh(cube_mesh({1.0, -1.0, -1.0}, 2.0));
    CHECK(solid.answer({0.0, 0.0, 0.0}) == std::vector<float>{-1, 1, 0, 0});
}

TEST_CASE("the distance to a cube has its closed form, its sign everywhere") {
    TestRandom random(3);
    Solid solid(2);
    solid.add_mesh(cube_mesh({-1.0, -1.0, -1.0}, 2.0));
    std::vector<SensePlace> places(20'000);
    for (SensePlace& place : places) {
        place.position = random.in_cube(1.5);
        for (double& coordinate : place.position) {
            if (random.below(3) == 0) { // in planes of edges and of diagonals of faces
                coordinate = std::round(4.0 * coordinate) / 4.0;
            }
        }
    }
    const std::vector<float> answers = solid.answers(places);
    for (std::size_t i = 0; i < places.size(); ++i) {
        double outside_squared = 0.0;
        double largest = -1.0;
        for (const double coordinate : places[i].position) {
            const double apart = std::abs(coordinate) - 1.0;
            outside_squared += std::max(apart, 0.0) * std::max(apart, 0.0);
            largest = std::max(largest, apart);
        }
        const double expected = largest < 0.0 ? largest : std::sqrt(outside_squared);
        REQUIRE(static_cast<double>(answers[4 * i]) == Approx(expected).margin(1e-6));
        REQUIRE((answers[4 * i] < 0.0F) == (largest < 0.0));
    }
}

TEST_CASE("the distance to a sphere of triangles is near that to the sphere") {
    TestRandom random(4);
    for (const bool is_turned : {false, true}) {
        Solid solid(2);
        EnvironmentMesh mesh = sphere_mesh({1.0, 2.0, 3.0}, 2.0, 64);
        for (std::array<std::uint32_t, 3>& corners : mesh.triangles) {
            if (is_turned) {
                std::swap(corners[1], corners[2]);
            }
        }
        solid.add_mesh(mesh);
        std::vector<SensePlace> places(3000);
        for (SensePlace& place : places) {
            const Vector3 offset = random.in_cube(3.0);
            place.position = {1.0 + offset[0], 2.0 + offset[1], 3.0 + offset[2]};
        }
        const std::vector<float> answers = solid.answers(places);
        for (std::size_t i = 0; i < places.size(); ++i) {
            const Vector3 offset = difference(places[i].position, {1.0, 2.0, 3.0});
            const double expected = std::sqrt(product(offset, offset)) - 2.0;
            // The middle of a quad is 2 (1 - cos(pi / 128)^2) = 0.0012 inside the sphere.
            REQUIRE(static_cast<double>(answers[4 * i]) == Approx(expected).margin(0.003));
            double cosine = 0.0; // of the direction and the way to the sphere
            for (std::size_t axis = 0; axis < 3; ++axis) {
                cosine += static_cast<double>(answers[4 * i + 1 + axis]) * offset[axis];
            }
            if (std::abs(expected) > 0.1 && std::abs(expected + 2.0) > 0.2) {
                REQUIRE(cosine * expected < 0.0);
            }
        }
    }
}

TEST_CASE("the sign is right in line with vertices and edges, and next to the surface") {
    // The ray of every place meets vertices or edges.
    Solid solid(1);
    const EnvironmentMesh mesh = sphere_mesh({0.0, 0.0, 0.0}, 1.0, 16);
    solid.add_mesh(mesh);
    std::vector<SensePlace> places;
    std::vector<bool> is_inside;
    for (const Vector3& vertex : mesh.vertices) {
        for (const double along : {0.0, 0.5, 1.0 - 1e-12, 1.0 + 1e-12, 2.0}) {
            SensePlace place;
            place.position = {vertex[0] * along, vertex[1] * along, vertex[2] * along};
            places.push_back(place);
            is_inside.push_back(along < 1.0);
            // At the y and z of the vertex, left of the sphere.
            place.position = {vertex[0] - 2.5, vertex[1], vertex[2]};
            places.push_back(place);
            is_inside.push_back(false);
        }
    }
    const std::vector<float> answers = solid.answers(places);
    for (std::size_t i = 0; i < places.size(); ++i) {
        INFO(i << " " << answers[4 * i]);
        REQUIRE((answers[4 * i] < 0.0F) == is_inside[i]);
    }
}

TEST_CASE("a place on a face has the distance 0 and no direction") {
    TestRandom random(5);
    for (const double size : {1e-3, 1.0, 1e3}) {
        for (const EnvironmentMesh& mesh : {cube_mesh({0.1 * size, 0.3 * size, -0.7 * size}, size),
                                            sphere_mesh({0.1 * size, 0.0, 0.0}, size, 16)}) {
            Solid solid(1);
            solid.add_mesh(mesh);
            std::vector<SensePlace> places;
            for (const std::array<std::uint32_t, 3>& corners : mesh.triangles) {
                const Vector3& a = mesh.vertices[corners[0]];
                const Vector3 u = difference(mesh.vertices[corners[1]], a);
                const Vector3 v = difference(mesh.vertices[corners[2]], a);
                for (int i = 0; i < 20; ++i) {
                    const double s = static_cast<double>(random.below(1000)) / 1000.0;
                    const double t = (1.0 - s) * static_cast<double>(random.below(1000)) / 1000.0;
                    SensePlace& place = places.emplace_back();
                    for (std::size_t axis = 0; axis < 3; ++axis) {
                        place.position[axis] = a[axis] + s * u[axis] + t * v[axis];
                    }
                }
            }
            CAPTURE(size, mesh.triangles.size());
            const std::vector<float> answers = solid.answers(places);
            CHECK(std::count(answers.begin(), answers.end(), 0.0F) ==
                  static_cast<std::ptrdiff_t>(answers.size()));
            // Places near the surface are not on it.
            for (SensePlace& place : places) {
                for (double& coordinate : place.position) {
                    coordinate += 1e-11 * size;
                }
            }
            const std::vector<float> moved = solid.answers(places);
            std::size_t zero_count = 0;
            for (std::size_t i = 0; i < moved.size(); i += 4) {
                zero_count += moved[i] == 0.0F ? 1U : 0U;
            }
            CHECK(zero_count < places.size() / 10);
        }
    }
}

TEST_CASE("corners at one place are one vertex") {
    EnvironmentMesh mesh;
    const EnvironmentMesh cube = cube_mesh({0.0, 0.0, 0.0}, 1.0);
    for (const std::array<std::uint32_t, 3>& corners : cube.triangles) {
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        for (const std::uint32_t corner : corners) {
            Vector3 vertex = cube.vertices[corner];
            vertex[0] = vertex[0] == 0.0 && first % 2 == 1 ? -0.0 : vertex[0];
            mesh.vertices.push_back(vertex);
        }
        mesh.triangles.push_back({first, first + 1, first + 2});
    }
    CHECK(mesh_closure(mesh).closed);
    Solid solid(1);
    solid.add_mesh(mesh);
    CHECK(solid.answer({0.5, 0.5, 0.25})[0] == -0.25F);
}

TEST_CASE("an open mesh is positive on both sides") {
    Solid solid(1);
    SECTION("hole") {
        EnvironmentMesh mesh = cube_mesh({-1.0, -1.0, -1.0}, 2.0);
        mesh.triangles.pop_back();
        solid.add_mesh(mesh);
    }
    SECTION("a face twice") {
        EnvironmentMesh mesh = cube_mesh({-1.0, -1.0, -1.0}, 2.0);
        mesh.triangles.push_back(mesh.triangles.front());
        solid.add_mesh(mesh);
    }
    CHECK(solid.answer({-0.25, 0.0, 0.0}) == std::vector<float>{0.75, -1, 0, 0});
    CHECK(solid.answer({-1.5, 0.0, 0.0}) == std::vector<float>{0.5, 1, 0, 0});
}

TEST_CASE("winding numbers: a cavity is outside, overlaps are inside") {
    Solid solid(1);
    EnvironmentMesh mesh = cube_mesh({-2.0, -2.0, -2.0}, 4.0);
    const auto add = [&](const EnvironmentMesh& other, bool turned) {
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
        for (const std::array<std::uint32_t, 3>& c : other.triangles) {
            mesh.triangles.push_back(
                {first + c[0], first + c[turned ? 2 : 1], first + c[turned ? 1 : 2]});
        }
    };
    SECTION("cavity") {
        add(cube_mesh({-1.0, -1.0, -1.0}, 2.0), true);
        solid.add_mesh(mesh);
        CHECK(solid.answer({0.0, 0.0, 0.0})[0] == 1.0F);
        CHECK(solid.answer({1.25, 0.0, 0.0})[0] == -0.25F);
    }
    SECTION("overlap") {
        add(cube_mesh({-1.0, -1.0, -1.0}, 4.0), false);
        solid.add_mesh(mesh);
        CHECK(solid.answer({0.0, 0.0, 0.0})[0] == -1.0F);
        CHECK(solid.answer({2.5, 0.0, 0.0})[0] == -0.5F);
    }
}

TEST_CASE("faces of a closed mesh may face either side, one by one") {
    EnvironmentMesh mesh = sphere_mesh({0.0, 0.0, 0.0}, 1.0, 8);
    TestRandom random(9);
    for (std::array<std::uint32_t, 3>& corners : mesh.triangles) {
        if (random.below(2) == 0) {
            std::swap(corners[1], corners[2]);
        }
    }
    const MeshClosure closure = mesh_closure(mesh);
    CHECK(closure.closed);
    CHECK(closure.orientable);
    Solid solid(1);
    solid.add_mesh(mesh);
    CHECK(solid.answer({0.01, 0.02, 0.03})[0] < 0.0F);
    CHECK(solid.answer({0.3, -0.4, 0.5})[0] < 0.0F);
    CHECK(solid.answer({0.8, 0.8, 0.8})[0] > 0.0F);
}

TEST_CASE("triangles without area are no surface, and triangles with two equal corners no edge") {
    EnvironmentMesh mesh = cube_mesh({-1.0, -1.0, -1.0}, 2.0);
    mesh.vertices.push_back({0.0, 0.5, 0.0});
    mesh.triangles.push_back({8, 8, 8});
    mesh.triangles.push_back({0, 8, 8});
    CHECK(mesh_closure(mesh).closed);
    Solid solid(1);
    solid.add_mesh(mesh);
    CHECK(solid.answer({0.0, 0.5, 0.0}) == std::vector<float>{-0.5, 0, 1, 0});
}

TEST_CASE("a mesh without area or with a vertex that is not finite is refused") {
    Solid solid(1);
    EnvironmentMesh mesh;
    mesh.vertices = {{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, {2.0, 2.0, 2.0}};
    mesh.triangles = {{0, 1, 2}};
    SECTION("no area") {
        CHECK_FALSE(mesh_closure(mesh).closed);
    }
    SECTION("not finite") {
        mesh.vertices[1][2] = std::numeric_limits<double>::quiet_NaN();
    }
    solid.add_mesh(mesh);
    const auto failure = solid.begin();
    REQUIRE(failure.has_value());
    CHECK(failure->stop == Stop::Diagnosed);
}

TEST_CASE("a mesh with more edges than one block of the sort is closed") {
    EnvironmentMesh mesh = sphere_mesh({0.0, 0.0, 0.0}, 1.0, 120);
    CHECK(mesh_closure(mesh).closed);
    mesh.triangles.pop_back();
    CHECK_FALSE(mesh_closure(mesh).closed);
}

TEST_CASE("a mesh beyond the memory is refused, and building its tree can be cancelled") {
    Solid solid(2);
    solid.add_mesh(sphere_mesh({0.0, 0.0, 0.0}, 1.0, 100));
    const std::atomic<bool> cancelled{true};
    SECTION("limit") {
        solid.context.max_bytes = 1000;
        const auto failure = solid.begin();
        REQUIRE(failure.has_value());
        CHECK(failure->stop == Stop::Limit);
        CHECK(failure->bytes > 1000);
    }
    SECTION("limit of the order of places") {
        solid.context.max_bytes = 1000;
        const std::uint64_t tree_bytes = solid.begin()->bytes;
        solid.context.max_bytes = tree_bytes;
        REQUIRE_FALSE(solid.begin().has_value());
        const std::vector<SensePlace> places(1);
        SensedWord word;
        word.places = places;
        std::vector<float> answers(4);
        std::vector<std::uint32_t> sizes;
        const auto failure = solid.environment->answer(word, answers, sizes);
        REQUIRE(failure.has_value());
        CHECK(failure->stop == Stop::Limit);
        CHECK(failure->bytes > tree_bytes);
    }
    SECTION("cancelled") {
        solid.context.cancelled = &cancelled;
        const auto failure = solid.begin();
        REQUIRE(failure.has_value());
        CHECK(failure->stop == Stop::Cancelled);
        CHECK_FALSE(mesh_closure(solid.files.meshes[0], &cancelled).closed);
    }
}

} // namespace lsys
