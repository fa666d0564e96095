// SPDX-License-Identifier: MIT
// Objects placed by the turtle: positions, rotations, sizes, colours and drooping leaves.
#include "runtime/meshing/impl/objects.h"
#include "runtime/meshing/shapes.h"
#include "tests/support/mesh_checks.h"

#include <glm/gtc/quaternion.hpp>

#include <random>
#include <string>
#include <vector>

using namespace lsys;

namespace {

struct Meshed {
    Mesh mesh;
    std::optional<Stop> stop;
};

Meshed try_meshed(const Skeleton& skeleton,
                  const std::vector<UserMesh>& user_meshes,
                  const MeshOptions& options) {
    Meshed result;
    MeshBuilder builder(options, result.mesh);
    append_objects(skeleton, user_meshes, options, builder);
    result.stop = builder.finish();
    return result;
}

Mesh meshed(const Skeleton& skeleton,
            const MeshOptions& options = {},
            const std::vector<UserMesh>& user_meshes = {}) {
    Meshed result = try_meshed(skeleton, user_meshes, options);
    REQUIRE(result.stop == std::nullopt);
    test::check_mesh(result.mesh, options);
    return std::move(result.mesh);
}

Skeleton one(const PlacedObject& object) {
    Skeleton skeleton;
    skeleton.objects.push_back(object);
    return skeleton;
}

Skeleton random_objects(std::uint32_t seed, std::size_t count) {
    std::mt19937 random(seed);
    std::normal_distribution<float> normal;
    Skeleton skeleton;
    for (std::size_t i = 0; i < count; ++i) {
        PlacedObject object;
        object.kind = i % 7 == 0 ? TurtleOperation::Flower : TurtleOperation::Leaf;
        object.position = {normal(random), normal(random), normal(random)};
        object.frame = glm::normalize(
            glm::quat(normal(random), normal(random), normal(random), normal(random)));
        object.size = 0.1F + std::abs(normal(random));
        object.colour = static_cast<std::uint16_t>(i % 3);
        skeleton.objects.push_back(object);
    }
    return skeleton;
}

UserMesh triangle() {
    UserMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}};
    mesh.normals.assign(3, {0, 0, 1});
    mesh.indices = {0, 1, 2};
    return mesh;
}

} // namespace

TEST_CASE("an object is moved, turned and scaled") {
    // Heading +X, right -Y, up +Z.
    const glm::quat frame = glm::angleAxis(-1.5707963F, glm::vec3(0, 0, 1));
    const Mesh mesh = meshed(one(
        {.kind = TurtleOperation::Cone, .position = {10, 20, 30}, .size = 2.0F, .frame = frame}));
    const Bounds bounds = test::bounds_of(mesh);
    CHECK(glm::distance(bounds.low, glm::vec3(10, 19, 29)) < 1e-5F);
    CHECK(glm::distance(bounds.high, glm::vec3(12, 21, 31)) < 1e-5F);
    CHECK(test::volume_of(mesh) == Approx(8.0 * 0.2618).epsilon(0.06));
    CHECK(test::corners_turned_over(mesh) == 0);
}

TEST_CASE("a negative size mirrors an object, and its faces still point outwards") {
    const Mesh mesh = meshed(one({.kind = TurtleOperation::Cone, .size = -1.0F}));
    CHECK(test::bounds_of(mesh).low.y == -1.0F);
    CHECK(test::volume_of(mesh) > 0.2);
    CHECK(test::corners_turned_over(mesh) == 0);
    CHECK(meshed(one({.kind = TurtleOperation::Cone, .size = 0.0F})).positions.empty());
}

TEST_CASE("objects have a part for each material and colour") {
    Skeleton skeleton;
    for (const std::uint16_t colour : std::vector<std::uint16_t>{0, 7, 0, 1}) {
        PlacedObject object;
        object.kind = TurtleOperation::Leaf;
        object.colour = colour;
        skeleton.objects.push_back(object);
        object.kind = TurtleOperation::Flower;
        skeleton.objects.push_back(object);
    }
    const Mesh mesh = meshed(skeleton);
    std::vector<std::string> names;
    for (const Material& material : mesh.materials) {
        names.push_back(material.name);
    }
    // Leaves of colour 0 and 1 are one part; the centre and the calyx of flowers keep their colour.
    CHECK(names == std::vector<std::string>{"leaf", "leaf 7", "flower 1", "flower 7", "flower 18",
                                            "flower 20", "flower 14"});
    // The centre is yellow, the petals are pink.
    CHECK(palette_colour(18).g > palette_colour(20).g);
    CHECK(palette_colour(18).b < palette_colour(20).b);
    const std::size_t leaf = make_shape(TurtleOperation::Leaf, 0).parts[0].indices.size();
    CHECK(mesh.parts[0].index_count == 3 * leaf);
    CHECK(mesh.parts[1].index_count == leaf);
    for (const MeshPart& part : mesh.parts) {
        for (std::uint64_t i = 0; i < part.index_count; ++i) {
            const ItemColour palette = mesh.colours[mesh.indices[part.first_index + i]];
            REQUIRE(glm::vec3(mesh.materials[part.material].colour) == palette_colour(palette));
        }
    }
}

TEST_CASE("meshes of files are objects") {
    PlacedObject object;
    object.kind = TurtleOperation::MeshFile;
    object.mesh_file = 1;
    object.size = 3.0F;
    Skeleton skeleton = one(object);
    // No mesh has this index.
    skeleton.objects.push_back({.kind = TurtleOperation::MeshFile, .mesh_file = 9});
    // The mesh is empty.
    skeleton.objects.push_back({.kind = TurtleOperation::MeshFile, .mesh_file = 0});
    const Mesh mesh = meshed(skeleton, {}, {UserMesh{}, triangle()});
    REQUIRE(mesh.indices.size() == 3);
    CHECK(mesh.positions[2] == glm::vec3(0, 6, 0));
    CHECK(mesh.materials[0].two_sided);
}

TEST_CASE("objects do not depend on threads, and coarser levels have fewer triangles") {
    const Skeleton skeleton = random_objects(1, 5000);
    for (const float droop : {0.0F, 0.7F}) {
        const Mesh one_thread = meshed(skeleton, {.droop = droop, .threads = 1});
        const Mesh three = meshed(skeleton, {.droop = droop, .threads = 3});
        CHECK(one_thread.positions == three.positions);
        CHECK(one_thread.normals == three.normals);
        CHECK(one_thread.tangents == three.tangents);
        CHECK(one_thread.indices == three.indices);
        CHECK(one_thread.colours == three.colours);
        std::size_t triangles = one_thread.indices.size();
        for (std::uint32_t level = 1; level < 4; ++level) {
            const Mesh coarse = meshed(skeleton, {.level = level, .droop = droop});
            CHECK(coarse.indices.size() < triangles);
            triangles = coarse.indices.size();
        }
    }
}

TEST_CASE("arrays that the options exclude are not made") {
    MeshOptions options;
    options.texture_coordinates = false;
    options.tangents = false;
    options.colours = false;
    CHECK_FALSE(meshed(random_objects(2, 50), options).indices.empty());
}

TEST_CASE("the skeleton sets the droop of leaves, unless the options override it") {
    Skeleton skeleton = one({.kind = TurtleOperation::Leaf});
    const Mesh straight = meshed(skeleton);
    skeleton.leaf_droop = traits_of(TurtleProfile::Lplus).leaf_droop;
    const Mesh drooping = meshed(skeleton);
    CHECK(meshed(skeleton, {.droop = 0.0F}).positions == straight.positions);
    CHECK(meshed(one({.kind = TurtleOperation::Leaf}), {.droop = 0.25F}).positions ==
          drooping.positions);
    // A leaf that points straight up loses a quarter of its height, as in the program L3D.
    CHECK(test::bounds_of(straight).high.y == 1.0F);
    CHECK(test::bounds_of(drooping).high.y == Approx(0.75F).margin(0.015));
    skeleton.l3d_compatible_surface = true;
    Mesh of_program;
    REQUIRE(make_mesh(skeleton, {}, {.droop = 0.9F}, of_program) == std::nullopt);
    test::check_mesh(of_program, {.droop = 0.9F});
    CHECK(test::bounds_of(of_program).high.y == Approx(0.75F).margin(1e-6));
    for (const TurtleProfile profile : enumerators_of<TurtleProfile>()) {
        CHECK((traits_of(profile).leaf_droop != 0.0F) == (profile == TurtleProfile::Lplus));
    }
}

TEST_CASE("surfaces of L3D change no objects other than leaves") {
    Skeleton skeleton = random_objects(5, 7); // a flower and leaves
    std::erase_if(skeleton.objects,
                  [](const PlacedObject& object) { return object.kind == TurtleOperation::Leaf; });
    REQUIRE(skeleton.objects.size() == 1);
    const Mesh plain = meshed(skeleton);
    skeleton.l3d_compatible_surface = true;
    Mesh of_program;
    REQUIRE(make_mesh(skeleton, {}, {}, of_program) == std::nullopt);
    CHECK(of_program.positions == plain.positions);
    CHECK(of_program.indices == plain.indices);
}

TEST_CASE("leaves of any direction droop to the ground and keep their length") {
    const Mesh straight = meshed(one({.kind = TurtleOperation::Leaf}));
    std::mt19937 random(3);
    std::normal_distribution<float> normal;
    for (int round = 0; round < 100; ++round) {
        const glm::quat frame = glm::normalize(
            glm::quat(normal(random), normal(random), normal(random), normal(random)));
        // The height of the leaf's tip for each droop.
        std::vector<float> tips;
        for (const float droop : {0.0F, 0.25F, 0.5F, 0.75F, 1.0F, 2.0F}) {
            MeshOptions options;
            options.droop = droop;
            const Mesh mesh = meshed(one({.kind = TurtleOperation::Leaf, .frame = frame}), options);
            CHECK(test::corners_turned_over(mesh) == 0);
            CHECK(test::area_of(mesh) == Approx(test::area_of(straight)).epsilon(0.12));
            float tip_height = 0.0F;
            for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
                tip_height = straight.positions[i].y == 1.0F ? mesh.positions[i].y : tip_height;
                // The base stays.
                if (straight.positions[i].y == 0.0F) {
                    CHECK(glm::length(mesh.positions[i]) < 0.03F);
                }
            }
            tips.push_back(tip_height);
        }
        for (std::size_t i = 1; i < tips.size(); ++i) {
            CHECK(tips[i] <= tips[i - 1] + 0.06F);
        }
        CHECK(tips[5] == tips[4]); // larger droops count as 1
        // With droop 1, a leaf that points down ends at least 0.7 below its base.
        if (heading(frame).y < 0.0F) {
            CHECK(tips[4] < -0.7F);
        }
    }
}

TEST_CASE("a leaf that points straight up falls over its lower side") {
    MeshOptions options;
    options.droop = 1.0F;
    const Mesh mesh = meshed(one({.kind = TurtleOperation::Leaf}), options);
    CHECK(test::bounds_of(mesh).low.z < -0.2F);
    CHECK(test::bounds_of(mesh).high.x <= 0.2501F);
    // A leaf that points straight down does not change.
    const glm::quat down = glm::angleAxis(3.14159265F, glm::vec3(0, 0, 1));
    const Mesh hanging = meshed(one({.kind = TurtleOperation::Leaf, .frame = down}), options);
    CHECK(test::bounds_of(hanging).low.y == Approx(-1.0F));
}

TEST_CASE("objects over the limit leave the mesh empty") {
    MeshOptions options;
    options.max_bytes = 1000;
    const Meshed result = try_meshed(random_objects(4, 100), {}, options);
    CHECK(result.stop == Stop::Limit);
    CHECK(result.mesh.positions.empty());
}

TEST_CASE(
    "materials of mesh files have unique names of the file, different from those of the library",
    "[objects]") {
    CHECK(object_file_names({"leaves/maple.obj", "leaf.png", "old/Maple.png", "two words.obj",
                             "a\nb.obj", ".png", "other\\leaf.png", "AZ.obj", "az.obj"}) ==
          std::vector<std::string>{"maple", "leaf file", "Maple file", "two words", "a_b", "file",
                                   "leaf file 2", "AZ", "az file"});
}

TEST_CASE("the name of a plain material lists the parts that use it", "[objects]") {
    Skeleton skeleton;
    Segment segment;
    segment.length = 1.0F;
    segment.base_radius = 0.1F;
    segment.tip_radius = 0.1F;
    segment.colour = 3;
    skeleton.segments.push_back(segment);
    PlacedObject sphere;
    sphere.kind = TurtleOperation::Sphere;
    sphere.colour = 3;
    skeleton.objects.push_back(sphere);
    sphere.kind = TurtleOperation::Cube;
    sphere.colour = 0;
    skeleton.objects.push_back(sphere);
    Mesh mesh;
    REQUIRE_FALSE(make_mesh(skeleton, {}, MeshOptions{}, mesh));
    std::vector<std::string> names;
    for (const Material& material : mesh.materials) {
        names.push_back(material.name);
    }
    CHECK(names == std::vector<std::string>{"wood and sphere 3", "cube"});
}
