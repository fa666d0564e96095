// Catmull-Clark subdivision by its closed forms, and plants of joined boxes as closed surfaces.
#include "runtime/meshing/impl/box_joints.h"
#include "runtime/meshing/impl/boxes.h"
#include "runtime/meshing/impl/catmull_clark.h"
#include "tests/support/mesh_checks.h"

#include <glm/common.hpp>
#include <glm/gtc/quaternion.hpp>

#include <numbers>
#include <random>
#include <vector>

using namespace lsys;

namespace {

void add_face(PolygonMesh& mesh, const std::vector<std::uint32_t>& corners) {
    mesh.corners.insert(mesh.corners.end(), corners.begin(), corners.end());
    mesh.face_ends.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
    mesh.colours.push_back(static_cast<std::uint16_t>(mesh.colours.size()));
}

/// From -1 to 1; texture coordinates are x and y.
PolygonMesh cube() {
    PolygonMesh mesh;
    for (int i = 0; i < 8; ++i) {
        const glm::vec3 at((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1);
        mesh.positions.push_back(at);
        mesh.texture_coordinates.emplace_back(at.x, at.y);
    }
    for (const std::vector<std::uint32_t>& face : std::vector<std::vector<std::uint32_t>>{
             {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
        add_face(mesh, face);
    }
    return mesh;
}

Mesh triangles_of(const PolygonMesh& from) {
    Mesh mesh;
    mesh.positions.assign(from.positions.begin(), from.positions.end());
    std::uint32_t begin = 0;
    for (const std::uint32_t end : from.face_ends) {
        for (std::uint32_t i = begin + 1; i + 1 < end; ++i) {
            for (const std::uint32_t corner : {begin, i, i + 1}) {
                mesh.indices.push_back(from.corners[corner]);
            }
        }
        begin = end;
    }
    return mesh;
}

glm::quat turned(float degrees, const glm::vec3& axis) {
    return glm::angleAxis(degrees * std::numbers::pi_v<float> / 180.0F, axis);
}

/// Draws like a turtle, with all the facts of a segment.
struct Plant {
    Skeleton skeleton;

    std::uint32_t grow(std::uint32_t parent,
                       const glm::quat& turn,
                       float length,
                       float base_radius,
                       float tip_radius) {
        Segment segment;
        if (parent != kNoSegment) {
            segment.base = tip(skeleton.segments[parent]);
            segment.frame = skeleton.segments[parent].frame;
            segment.linked = true;
        }
        segment.frame = glm::normalize(segment.frame * turn);
        segment.parent = parent;
        segment.length = length;
        segment.base_radius = base_radius;
        segment.tip_radius = tip_radius;
        skeleton.segments.push_back(segment);
        return static_cast<std::uint32_t>(skeleton.segments.size() - 1);
    }
};

Plant random_plant(std::uint32_t seed, std::size_t segments, float wildness) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(0.0F, 1.0F);
    Plant plant;
    plant.grow(kNoSegment, glm::quat(1, 0, 0, 0), 1.0F, 0.1F, 0.09F);
    while (plant.skeleton.segments.size() < segments) {
        const auto parent = static_cast<std::uint32_t>(std::uniform_int_distribution<std::size_t>(
            0, plant.skeleton.segments.size() - 1)(random));
        const float base =
            plant.skeleton.segments[parent].tip_radius * (0.5F + 0.5F * unit(random));
        const glm::quat turn = turned(360.0F * unit(random), glm::vec3(0, 1, 0)) *
                               turned(wildness * unit(random), glm::vec3(1, 0, 0));
        plant.grow(parent, turn, (0.1F + unit(random)) * (unit(random) < 0.1F ? 0.0F : 0.5F), base,
                   base * unit(random));
    }
    return plant;
}

Mesh meshed(const Skeleton& skeleton, const MeshOptions& options) {
    Mesh mesh;
    MeshBuilder builder(options, mesh);
    append_boxes(skeleton, options, builder);
    REQUIRE(builder.finish() == std::nullopt);
    test::check_mesh(mesh, options);
    return mesh;
}

MeshOptions boxes(std::uint32_t subdivisions) {
    MeshOptions options;
    options.method = MeshMethod::Boxes;
    options.subdivisions = subdivisions;
    return options;
}

std::size_t plants_in(const Mesh& mesh) {
    std::vector<std::uint32_t> root(mesh.positions.size());
    for (std::uint32_t i = 0; i < root.size(); ++i) {
        root[i] = i;
    }
    const auto find = [&](std::uint32_t i) {
        while (root[i] != i) {
            root[i] = root[root[i]];
            i = root[i];
        }
        return i;
    };
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        root[find(mesh.indices[i])] = find(mesh.indices[i + 1]);
        root[find(mesh.indices[i])] = find(mesh.indices[i + 2]);
    }
    std::size_t count = 0;
    for (std::uint32_t i = 0; i < root.size(); ++i) {
        count += root[i] == i ? 1U : 0U;
    }
    return count;
}

} // namespace

TEST_CASE("a subdivided cube has the known counts and limits") {
    Workers workers(2);
    CatmullClark surface(cube(), workers);
    REQUIRE(surface.closed());
    const std::vector<std::size_t> vertices{8, 26, 98, 386, 1538, 6146};
    float step = 2.0F;
    for (std::uint32_t i = 0; i < vertices.size(); ++i) {
        if (i > 0) {
            surface.refine();
        }
        const MeshCounts counts = refined_counts(cube(), i);
        CHECK(counts.vertices == vertices[i]);
        CHECK(surface.mesh().positions.size() == vertices[i]);
        CHECK(counts.faces == surface.mesh().face_ends.size());
        CHECK(counts.vertices + counts.faces - counts.edges == 2);
        const test::Topology topology = test::topology_by_index(triangles_of(surface.mesh()));
        CHECK(topology.open_edges == 0);
        CHECK(topology.euler() == 2);
        // (n^2 p + 4 edge + faces) / n (n + 5) for the corner of valence 3: half of it.
        const float now = glm::distance(surface.mesh().positions[7], glm::vec3(0.5F));
        CHECK(now < step);
        step = now * 0.5F;
        // What is symmetric stays so; texture coordinates move with positions.
        for (std::size_t j = 0; j < surface.mesh().positions.size(); ++j) {
            const glm::vec3& at = surface.mesh().positions[j];
            CHECK(glm::distance(glm::vec2(at), surface.mesh().texture_coordinates[j]) < 1e-6F);
        }
        CHECK(glm::distance(surface.mesh().positions[0], -surface.mesh().positions[7]) < 1e-6F);
    }
    CHECK(step < 0.005F);
    // Faces keep the colour of the face they come from.
    CHECK(surface.mesh().colours.front() == 0);
    CHECK(surface.mesh().colours.back() == 5);
}

TEST_CASE("the first step of Catmull-Clark by hand") {
    Workers workers(1);
    CatmullClark surface(cube(), workers);
    surface.refine();
    const PolygonMesh& mesh = surface.mesh();
    // The corner: (F + 2R + 0 P) / 3 with F = (1/3, 1/3, 1/3), R = (2/3, 2/3, 2/3).
    CHECK(glm::distance(mesh.positions[7], glm::vec3(5.0F / 9.0F)) < 1e-6F);
    std::size_t faces = 0;
    std::size_t edges = 0;
    for (std::size_t i = 8; i < 26; ++i) {
        const glm::vec3 size = glm::abs(mesh.positions[i]);
        faces += std::max({size.x, size.y, size.z}) == 1.0F ? 1U : 0U;
        edges += std::max({size.x, size.y, size.z}) == 0.75F ? 1U : 0U;
    }
    CHECK(faces == 6);
    CHECK(edges == 12);
}

TEST_CASE("faces of any number of corners become quads") {
    // A prism over a pentagon.
    PolygonMesh mesh;
    for (int i = 0; i < 10; ++i) {
        const float angle = 2.0F * std::numbers::pi_v<float> * static_cast<float>(i % 5) / 5.0F;
        mesh.positions.emplace_back(std::cos(angle), i < 5 ? -1.0F : 1.0F, -std::sin(angle));
    }
    add_face(mesh, {4, 3, 2, 1, 0});
    add_face(mesh, {5, 6, 7, 8, 9});
    for (std::uint32_t i = 0; i < 5; ++i) {
        add_face(mesh, {i, (i + 1) % 5, (i + 1) % 5 + 5, i + 5});
    }
    Workers workers(1);
    CatmullClark surface(mesh, workers);
    REQUIRE(surface.closed());
    surface.refine();
    CHECK(surface.mesh().face_ends.size() == 30);
    CHECK(surface.mesh().corners.size() == 120);
    CHECK(surface.mesh().positions.size() == 10 + 7 + 15);
    surface.refine();
    const Mesh triangles = triangles_of(surface.mesh());
    CHECK(test::topology_by_index(triangles).open_edges == 0);
    CHECK(test::volume_of(triangles) > 1.0);
    // Faces around a vertex, each once: 5 around the middle of a pentagon.
    for (std::uint32_t vertex = 0; vertex < surface.mesh().positions.size(); ++vertex) {
        std::size_t count = 0;
        surface.visit_faces(vertex, [&](std::uint32_t face, std::uint32_t half) {
            CHECK(half / 4 == face);
            CHECK(surface.mesh().corners[half] == vertex);
            ++count;
        });
        CHECK((count == 3 || count == 4 || count == 5));
    }
}

TEST_CASE("what is not closed is told") {
    Workers workers(1);
    PolygonMesh open = cube();
    open.corners.resize(20);
    open.face_ends.resize(5);
    CHECK_FALSE(CatmullClark(open, workers).closed());
    PolygonMesh turned_over = cube();
    std::swap(turned_over.corners[1], turned_over.corners[3]);
    CHECK_FALSE(CatmullClark(turned_over, workers).closed());
    PolygonMesh thrice = cube();
    add_face(thrice, {0, 2, 3, 1});
    CHECK_FALSE(CatmullClark(thrice, workers).closed());
    PolygonMesh unused = cube();
    unused.positions.emplace_back(0.0F);
    CHECK_FALSE(CatmullClark(unused, workers).closed());
}

TEST_CASE("boxes of random plants are closed") {
    for (std::uint32_t seed = 0; seed < 30; ++seed) {
        const Plant plant = random_plant(seed, 3 + 5 * seed, seed % 2 == 0 ? 50.0F : 180.0F);
        const Mesh mesh = triangles_of(make_boxes(plant.skeleton, 1.0F));
        const test::Topology topology = test::topology_by_index(mesh);
        CHECK(topology.open_edges == 0);
        CHECK(topology.euler() == 2 * static_cast<std::int64_t>(plants_in(mesh)));
        for (std::uint32_t subdivisions = 0; subdivisions < 3; ++subdivisions) {
            const Mesh smooth = meshed(plant.skeleton, boxes(subdivisions));
            const test::Topology fine = test::topology_by_index(smooth);
            CHECK(fine.open_edges == 0);
            CHECK(fine.euler() == 2 * static_cast<std::int64_t>(plants_in(smooth)));
            CHECK(test::volume_of(smooth) > 0.0);
        }
    }
}

TEST_CASE("a tree whose branches fit is one surface") {
    Plant plant;
    const std::uint32_t trunk = plant.grow(kNoSegment, glm::quat(1, 0, 0, 0), 1.0F, 0.1F, 0.08F);
    const std::uint32_t top = plant.grow(trunk, turned(20, {0, 0, 1}), 1.0F, 0.08F, 0.06F);
    for (int i = 0; i < 3; ++i) { // all of them nearest to the top
        const std::uint32_t branch = plant.grow(
            top, turned(120.0F * static_cast<float>(i), {0, 1, 0}) * turned(25, {1, 0, 0}), 0.8F,
            0.05F, 0.03F);
        plant.grow(branch, turned(90, {1, 0, 0}), 0.5F, 0.03F, 0.0F);
        plant.grow(branch, turned(-80, {1, 0, 0}), 0.5F, 0.03F, 0.01F);
    }
    plant.grow(top, turned(80, {0, 0, 1}), 0.5F, 0.03F, 0.02F);
    for (std::uint32_t subdivisions = 0; subdivisions < 4; ++subdivisions) {
        const Mesh mesh = meshed(plant.skeleton, boxes(subdivisions));
        CHECK(plants_in(mesh) == 1);
        CHECK(test::topology_by_index(mesh).open_edges == 0);
        CHECK(test::topology_by_index(mesh).euler() == 2);
        CHECK(mesh.materials.size() == 1);
        CHECK(mesh.materials[0].kind == MaterialKind::Bark);
    }
    const Mesh smooth = meshed(plant.skeleton, boxes(2));
    const double volume = measure(plant.skeleton).volume;
    CHECK(test::volume_of(smooth) == Approx(volume).epsilon(0.15));
    CHECK(test::triangles_turned_over(smooth) < smooth.indices.size() / 100);
    const Bounds box = test::bounds_of(smooth);
    CHECK(box.low.y == Approx(0.0).margin(0.03));
}

TEST_CASE("a smoothed stem is round, of its radius and length") {
    Plant plant;
    std::uint32_t last = plant.grow(kNoSegment, glm::quat(1, 0, 0, 0), 1.0F, 0.1F, 0.1F);
    for (int i = 0; i < 4; ++i) {
        last = plant.grow(last, glm::quat(1, 0, 0, 0), 1.0F, 0.1F, 0.1F);
    }
    const Mesh mesh = meshed(plant.skeleton, boxes(3));
    for (const glm::vec3& at : mesh.positions) {
        if (at.y > 1.0F && at.y < 4.0F) {
            CHECK(std::hypot(at.x, at.z) == Approx(0.1F).epsilon(0.04));
        }
    }
    const Bounds box = test::bounds_of(mesh);
    CHECK(box.low.y == Approx(0.0F).margin(0.05));
    CHECK(box.high.y == Approx(5.0F).margin(0.05));
    CHECK(test::triangles_turned_over(mesh) == 0);
    // u goes there and back, v up the stem.
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        CHECK(mesh.texture_coordinates[i].x >= 0.0F);
        CHECK(mesh.texture_coordinates[i].x <= 1.0F);
    }
}

TEST_CASE("an unsmoothed box has the area of the segment's cross-section") {
    Plant plant;
    plant.grow(kNoSegment, turned(30, {0, 0, 1}), 2.0F, 0.1F, 0.1F);
    const Mesh mesh = meshed(plant.skeleton, boxes(0));
    CHECK(test::volume_of(mesh) == Approx(std::numbers::pi * 0.01 * 2.0).epsilon(0.01));
}

TEST_CASE("too many or too short children are closed boxes of their own") {
    Plant many;
    const std::uint32_t trunk = many.grow(kNoSegment, glm::quat(1, 0, 0, 0), 1.0F, 0.1F, 0.1F);
    for (int i = 0; i < 60; ++i) {
        many.grow(trunk, turned(6.0F * static_cast<float>(i), {0, 1, 0}) * turned(10, {1, 0, 0}),
                  1.0F, 0.02F, 0.02F);
    }
    const Mesh crowd = meshed(many.skeleton, boxes(1));
    CHECK(plants_in(crowd) > 1);
    CHECK(test::topology_by_index(crowd).open_edges == 0);
    Plant short_one;
    const std::uint32_t base = short_one.grow(kNoSegment, glm::quat(1, 0, 0, 0), 1.0F, 0.1F, 0.1F);
    short_one.grow(base, turned(90, {1, 0, 0}), 0.05F, 0.02F, 0.02F);
    short_one.grow(base, turned(10, {1, 0, 0}), 1.0F, 0.02F, 0.02F);
    CHECK(plants_in(meshed(short_one.skeleton, boxes(1))) == 2);
    // One that turns back into its parent.
    Plant back;
    back.grow(back.grow(kNoSegment, glm::quat(1, 0, 0, 0), 1.0F, 0.1F, 0.1F),
              turned(175, {1, 0, 0}), 1.0F, 0.05F, 0.05F);
    CHECK(plants_in(meshed(back.skeleton, boxes(2))) == 2);
}

TEST_CASE("segments that cannot be drawn are passed over") {
    Plant plant;
    const std::uint32_t trunk = plant.grow(kNoSegment, glm::quat(1, 0, 0, 0), 1.0F, 0.1F, 0.1F);
    const std::uint32_t without = plant.grow(trunk, turned(5, {1, 0, 0}), 0.0F, 0.1F, 0.1F);
    plant.grow(without, turned(5, {1, 0, 0}), 1.0F, 0.1F, 0.1F); // goes on from the trunk
    CHECK(plants_in(meshed(plant.skeleton, boxes(1))) == 1);
    Plant thin;
    thin.grow(kNoSegment, glm::quat(1, 0, 0, 0), 1.0F, 0.0F, 0.0F);
    CHECK(meshed(thin.skeleton, boxes(1)).positions.empty());
    Plant far;
    far.grow(kNoSegment, glm::quat(1, 0, 0, 0), 1.0F, 0.1F, 0.1F);
    far.skeleton.segments[0].base = glm::vec3(1e9F);
    CHECK(meshed(far.skeleton, boxes(1)).positions.empty());
    CHECK(meshed(Skeleton{}, boxes(2)).positions.empty());
}

TEST_CASE("boxes keep colours, levels take steps away, and threads do not show") {
    Plant plant = random_plant(77, 400, 60.0F);
    for (std::size_t i = 0; i < plant.skeleton.segments.size(); ++i) {
        plant.skeleton.segments[i].colour = static_cast<std::uint16_t>(i % 3);
    }
    MeshOptions options = boxes(3);
    options.threads = 1;
    const Mesh one = meshed(plant.skeleton, options);
    options.threads = 3;
    const Mesh three = meshed(plant.skeleton, options);
    CHECK(one.positions == three.positions);
    CHECK(one.normals == three.normals);
    CHECK(one.indices == three.indices);
    CHECK(one.materials.size() == 3);
    options.level = 1;
    CHECK(meshed(plant.skeleton, options).positions == meshed(plant.skeleton, boxes(2)).positions);
    options.level = 9;
    CHECK(meshed(plant.skeleton, options).positions.size() ==
          meshed(plant.skeleton, boxes(0)).positions.size());
}

TEST_CASE("too many subdivisions are refused before they are made") {
    const Plant plant = random_plant(1, 50, 60.0F);
    for (const std::uint32_t subdivisions : {14U, 40U, 0xFFFFFFFFu}) {
        Mesh mesh;
        const MeshOptions options = boxes(subdivisions);
        MeshBuilder builder(options, mesh);
        append_boxes(plant.skeleton, options, builder);
        CHECK(builder.finish() == Stop::Failed);
    }
    Mesh mesh;
    MeshOptions options = boxes(4);
    options.max_bytes = 100'000;
    MeshBuilder builder(options, mesh);
    append_boxes(plant.skeleton, options, builder);
    CHECK(builder.finish() == Stop::Limit);
}
