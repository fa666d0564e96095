// SPDX-License-Identifier: MIT
// The object library: extents, normals, closed surfaces, and levels that fill the same box.
#include "runtime/meshing/shapes.h"
#include "tests/support/mesh_checks.h"

#include <glm/common.hpp>

#include <numbers>
#include <string>
#include <vector>

using namespace lsys;

namespace {

const std::vector<TurtleOperation> kObjects{TurtleOperation::Leaf,     TurtleOperation::Flower,
                                            TurtleOperation::Sphere,   TurtleOperation::Heterocyst,
                                            TurtleOperation::Cylinder, TurtleOperation::Cone,
                                            TurtleOperation::Cube,     TurtleOperation::Disk};

/// All parts of a shape in one mesh.
Mesh mesh_of(const Shape& shape) {
    Mesh mesh;
    for (const ShapePart& part : shape.parts) {
        REQUIRE(part.normals.size() == part.positions.size());
        REQUIRE(part.texture_coordinates.size() == part.positions.size());
        REQUIRE(part.tangents.size() == part.positions.size());
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.parts.push_back({.material = static_cast<std::uint32_t>(mesh.materials.size()),
                              .first_index = mesh.indices.size(),
                              .index_count = part.indices.size()});
        mesh.materials.push_back(make_material(part.material));
        mesh.positions.insert(mesh.positions.end(), part.positions.begin(), part.positions.end());
        mesh.normals.insert(mesh.normals.end(), part.normals.begin(), part.normals.end());
        mesh.texture_coordinates.insert(mesh.texture_coordinates.end(),
                                        part.texture_coordinates.begin(),
                                        part.texture_coordinates.end());
        mesh.tangents.insert(mesh.tangents.end(), part.tangents.begin(), part.tangents.end());
        mesh.colours.resize(mesh.positions.size(), part.material.palette);
        for (const std::uint32_t index : part.indices) {
            mesh.indices.push_back(first + index);
        }
    }
    return mesh;
}

void check_box(const Mesh& mesh, const glm::vec3& low, const glm::vec3& high) {
    const Bounds bounds = test::bounds_of(mesh);
    INFO(bounds.low.x << " " << bounds.low.y << " " << bounds.low.z << " to " << bounds.high.x
                      << " " << bounds.high.y << " " << bounds.high.z);
    CHECK(glm::distance(bounds.low, low) < 1e-6F);
    CHECK(glm::distance(bounds.high, high) < 1e-6F);
}

} // namespace

TEST_CASE("objects of all levels are valid meshes without unused vertices") {
    for (const TurtleOperation kind : kObjects) {
        for (std::uint32_t level = 0; level < 40; level += level < 5 ? 1 : 30) {
            INFO(name_of(kind) << " at level " << level);
            const Shape shape = make_shape(kind, level);
            const Mesh mesh = mesh_of(shape);
            REQUIRE_FALSE(mesh.indices.empty());
            test::check_mesh(mesh, {});
            CHECK(test::corners_turned_over(mesh) == 0);
            std::vector<bool> used(mesh.positions.size());
            for (const std::uint32_t index : mesh.indices.expanded()) {
                used[index] = true;
            }
            CHECK(std::count(used.begin(), used.end(), false) == 0);
            for (const glm::vec2& at : mesh.texture_coordinates) {
                CHECK(glm::min(at.x, at.y) >= -1e-6F);
                CHECK(glm::max(at.x, at.y) <= 1.0F + 1e-6F);
            }
        }
    }
}

TEST_CASE("objects have the extents of the language reference") {
    const glm::vec3 low(-0.5F, 0.0F, -0.5F);
    const glm::vec3 high(0.5F, 1.0F, 0.5F);
    for (const TurtleOperation kind :
         {TurtleOperation::Sphere, TurtleOperation::Heterocyst, TurtleOperation::Cylinder,
          TurtleOperation::Cone, TurtleOperation::Cube}) {
        INFO(name_of(kind));
        check_box(mesh_of(make_shape(kind, 0)), low, high);
    }
    const Mesh disk = mesh_of(make_shape(TurtleOperation::Disk, 0));
    check_box(disk, low, {0.5F, 0.0F, 0.5F});
    for (const glm::vec3& normal : disk.normals) {
        CHECK(normal == glm::vec3(0, 1, 0));
    }
    for (const TurtleOperation kind : {TurtleOperation::Leaf, TurtleOperation::Flower}) {
        const Bounds bounds = test::bounds_of(mesh_of(make_shape(kind, 0)));
        CHECK(bounds.low.y == 0.0F);
        CHECK(bounds.high.y == 1.0F);
    }
}

TEST_CASE("coarse objects fill the same box with fewer triangles") {
    for (const TurtleOperation kind : kObjects) {
        const Mesh finest = mesh_of(make_shape(kind, 0));
        const Bounds box = test::bounds_of(finest);
        std::size_t triangles = finest.indices.size() / 3;
        for (std::uint32_t level = 1; level < 6; ++level) {
            INFO(name_of(kind) << " at level " << level);
            const Mesh mesh = mesh_of(make_shape(kind, level));
            check_box(mesh, box.low, box.high);
            CHECK(mesh.indices.size() / 3 <= triangles);
            triangles = mesh.indices.size() / 3;
        }
        if (kind != TurtleOperation::Cube) {
            CHECK(triangles < finest.indices.size() / 6);
        }
    }
}

TEST_CASE("bodies are closed and have about the volume of the exact shape") {
    const double pi = std::numbers::pi;
    struct Body {
        TurtleOperation kind;
        double volume;
    };
    for (const Body body :
         {Body{TurtleOperation::Sphere, pi / 6.0}, Body{TurtleOperation::Cylinder, pi / 4.0},
          Body{TurtleOperation::Cone, pi / 12.0}, Body{TurtleOperation::Cube, 1.0}}) {
        INFO(name_of(body.kind));
        const Mesh mesh = mesh_of(make_shape(body.kind, 0));
        CHECK(test::volume_of(mesh) == Approx(body.volume).epsilon(0.07));
        CHECK(test::volume_of(mesh) <= body.volume + 1e-6);
    }
    for (const TurtleOperation kind :
         {TurtleOperation::Sphere, TurtleOperation::Heterocyst, TurtleOperation::Cylinder,
          TurtleOperation::Cone, TurtleOperation::Cube}) {
        for (std::uint32_t level = 0; level < 4; ++level) {
            INFO(name_of(kind) << " at level " << level);
            const test::Topology topology = test::topology_of(mesh_of(make_shape(kind, level)));
            CHECK(topology.open_edges == 0);
            CHECK(topology.euler() == 2);
        }
    }
}

TEST_CASE("normals of a sphere are its radii, and those of a cone are perpendicular to its side") {
    const Mesh sphere = mesh_of(make_shape(TurtleOperation::Sphere, 0));
    for (std::size_t i = 0; i < sphere.positions.size(); ++i) {
        const glm::vec3 radius = 2.0F * (sphere.positions[i] - glm::vec3(0, 0.5F, 0));
        // The poles have a vertex per side, with the same normal.
        CHECK(glm::distance(radius, sphere.normals[i]) < 1e-5F);
    }
    for (const glm::vec3& normal : mesh_of(make_shape(TurtleOperation::Cone, 0)).normals) {
        CHECK((normal.y == -1.0F || normal.y == Approx(0.5 / std::sqrt(1.25))));
    }
}

TEST_CASE("a leaf is a pointed blade with a stem, bent along its midrib") {
    const Shape shape = make_shape(TurtleOperation::Leaf, 0);
    REQUIRE(shape.parts.size() == 1);
    const ShapePart& leaf = shape.parts[0];
    CHECK(leaf.material.two_sided);
    CHECK(leaf.material.cut_out);
    CHECK(leaf.material.textured);
    CHECK(leaf.indices.size() / 3 >= 12);
    CHECK(leaf.indices.size() / 3 <= 20);
    for (std::size_t i = 0; i < leaf.positions.size(); ++i) {
        const glm::vec3& at = leaf.positions[i];
        // The outline is that of leaf pictures, and texture coordinates cover its bounding box.
        CHECK(std::abs(at.x) <= leaf_half_width(at.y) + 1e-6F);
        CHECK(leaf.texture_coordinates[i].x == Approx(at.x / 0.5F + 0.5F));
        CHECK(leaf.texture_coordinates[i].y == Approx(1.0F - at.y));
        CHECK(leaf.normals[i].z > 0.0F); // the front faces the turtle's up
        CHECK(leaf.tangents[i].x > 0.5F);
        CHECK(leaf.tangents[i].w == 1.0F);
    }
    CHECK(leaf_half_width(0.0F) > 0.0F);
    CHECK(leaf_half_width(0.0F) < 0.03F);
    CHECK(leaf_half_width(0.1F) < 0.03F);
    CHECK(leaf_half_width(1.0F) == 0.0F);
    CHECK(leaf_half_width(0.38F) == 0.25F);
    CHECK(leaf_half_width(-1.0F) == 0.0F);
    CHECK(leaf_half_width(2.0F) == 0.0F);
    // The leaf is folded to a V: normals of both halves lean to the middle.
    for (std::size_t i = 0; i < leaf.positions.size(); ++i) {
        if (leaf.positions[i].x > 0.1F) {
            CHECK(leaf.normals[i].x < -0.1F);
        }
    }
}

TEST_CASE("a flower has petals that take a colour and a centre that keeps its own") {
    const Shape shape = make_shape(TurtleOperation::Flower, 0);
    std::size_t takes = 0;
    for (const ShapePart& part : shape.parts) {
        takes += part.takes_colour ? 1U : 0U;
    }
    CHECK(shape.parts.size() == 3);
    CHECK(takes == 1);
    CHECK(shape.parts[0].takes_colour);
    CHECK(shape.parts[0].material.kind == MaterialKind::Flower);
}

TEST_CASE("operations that place no object have no shape") {
    CHECK(make_shape(TurtleOperation::Branch, 0).parts.empty());
    CHECK(make_shape(TurtleOperation::Nothing, 0).parts.empty());
    CHECK(make_shape(TurtleOperation::MeshFile, 0).parts.empty());
}

TEST_CASE("tangents follow u and mark mirrored texture coordinates") {
    UserMesh user;
    user.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
    user.normals.assign(3, {0, 0, 1});
    user.indices = {0, 1, 2};
    // V points down, so the texture is not mirrored.
    user.texture_coordinates = {{0, 1}, {1, 1}, {1, 0}};
    CHECK(make_shape(user).parts[0].tangents[0] == glm::vec4(1, 0, 0, 1));
    user.texture_coordinates = {{1, 1}, {0, 1}, {0, 0}};
    CHECK(make_shape(user).parts[0].tangents[0] == glm::vec4(-1, 0, 0, -1));
    user.texture_coordinates.clear();
    const ShapePart without = make_shape(user).parts[0];
    CHECK(without.texture_coordinates.size() == 3);
    CHECK(glm::length(glm::vec3(without.tangents[0])) == Approx(1.0F));
}

TEST_CASE("every operation that places an object has a shape") {
    for (const TurtleOperation operation : enumerators_of<TurtleOperation>()) {
        // The turtle places the shapes of Sphere and Disk for these operations.
        const bool is_placed_as_another =
            operation == TurtleOperation::CentredSphere || operation == TurtleOperation::LevelDisk;
        // Files and organs have meshes of their own.
        const bool has_own_mesh =
            operation == TurtleOperation::MeshFile || operation == TurtleOperation::SurfaceBegin;
        const bool is_shape =
            info(operation).drawn == DrawnKind::Object && !has_own_mesh && !is_placed_as_another;
        CAPTURE(std::string(name_of(operation)));
        CHECK(make_shape(operation, 0).parts.empty() == !is_shape);
    }
}
