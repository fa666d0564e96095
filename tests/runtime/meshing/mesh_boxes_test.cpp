// SPDX-License-Identifier: MIT
// Catmull-Clark subdivision compared with closed forms, and plants of joined boxes as closed
// surfaces.
#include "runtime/meshing/impl/box_joints.h"
#include "runtime/meshing/impl/boxes.h"
#include "runtime/meshing/impl/catmull_clark.h"
#include "tests/support/mesh_checks.h"

#include <glm/common.hpp>
#include <glm/gtc/quaternion.hpp>

#include <array>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <vector>

using namespace lsys;

namespace {

void add_face(PolygonMesh& mesh, const std::vector<std::uint32_t>& corners) {
    mesh.corners.insert(mesh.corners.end(), corners.begin(), corners.end());
    mesh.face_ends.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
    mesh.colours.push_back(static_cast<std::uint16_t>(mesh.colours.size()));
}

/// A cube from -1 to 1; texture coordinates are x and y.
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

/// Adds segments as the turtle does, with all their fields.
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

/// The mesh with one vertex per position: faces of unsmoothed boxes have separate vertices.
Mesh welded(const Mesh& mesh) {
    Mesh one;
    std::map<std::array<float, 3>, std::uint32_t> places;
    for (const std::uint32_t index : mesh.indices.expanded()) {
        const glm::vec3 p = mesh.positions[index] + 0.0F; // -0 is 0
        const auto [at, is_new] = places.emplace(std::array{p.x, p.y, p.z},
                                                 static_cast<std::uint32_t>(one.positions.size()));
        if (is_new) {
            one.positions.push_back(p);
        }
        one.indices.push_back(at->second);
    }
    return one;
}

/// The number of separate surfaces: components that share no vertex.
std::size_t surface_count(const Mesh& mesh) {
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
        // The limit position of the corner, (n^2 p + 4 edges + faces) / (n (n + 5)) with valence
        // n = 3, is half of the corner.
        const float now = glm::distance(surface.mesh().positions[7], glm::vec3(0.5F));
        CHECK(now < step);
        step = now * 0.5F;
        // Symmetry is kept; texture coordinates move with positions.
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
    // The corner moves to (F + 2 R + 0 P) / 3, with F = (1/3, 1/3, 1/3) the mean of the face points
    // and R = (2/3, 2/3, 2/3) that of the edge midpoints.
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
    // Each face around a vertex counts once: the middle of a pentagon has 5.
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

TEST_CASE("meshes that are not closed are reported") {
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
        const Mesh mesh =
            triangles_of(make_boxes(plant.skeleton, {.width = 1.0F, .smoothed = seed % 2 == 0}));
        const test::Topology topology = test::topology_by_index(mesh);
        CHECK(topology.open_edges == 0);
        CHECK(topology.euler() == 2 * static_cast<std::int64_t>(surface_count(mesh)));
        for (std::uint32_t subdivisions = 0; subdivisions < 3; ++subdivisions) {
            const Mesh made = meshed(plant.skeleton, boxes(subdivisions));
            const Mesh smooth = subdivisions == 0 ? welded(made) : made;
            const test::Topology fine = test::topology_by_index(smooth);
            CHECK(fine.open_edges == 0);
            CHECK(fine.euler() == 2 * static_cast<std::int64_t>(surface_count(smooth)));
            CHECK(test::volume_of(smooth) > 0.0);
        }
    }
}

TEST_CASE("a tree whose branches fit onto their parents is one surface") {
    Plant plant;
    const std::uint32_t trunk = plant.grow(kNoSegment, glm::quat(1, 0, 0, 0), 1.0F, 0.1F, 0.08F);
    const std::uint32_t top = plant.grow(trunk, turned(20, {0, 0, 1}), 1.0F, 0.08F, 0.06F);
    // The headings of all three branches are nearest to the top side of the joint.
    for (int i = 0; i < 3; ++i) {
        const std::uint32_t branch = plant.grow(
            top, turned(120.0F * static_cast<float>(i), {0, 1, 0}) * turned(25, {1, 0, 0}), 0.8F,
            0.05F, 0.03F);
        plant.grow(branch, turned(90, {1, 0, 0}), 0.5F, 0.03F, 0.0F);
        plant.grow(branch, turned(-80, {1, 0, 0}), 0.5F, 0.03F, 0.01F);
    }
    plant.grow(top, turned(80, {0, 0, 1}), 0.5F, 0.03F, 0.02F);
    for (std::uint32_t subdivisions = 0; subdivisions < 4; ++subdivisions) {
        const Mesh mesh = meshed(plant.skeleton, boxes(subdivisions));
        const Mesh joined = subdivisions == 0 ? welded(mesh) : mesh;
        // Without smoothing, branches that would get narrower in their openings are separate closed
        // boxes.
        const std::size_t surfaces = surface_count(joined);
        CHECK((surfaces == 1) == (subdivisions > 0));
        CHECK(test::topology_by_index(joined).open_edges == 0);
        CHECK(test::topology_by_index(joined).euler() == 2 * static_cast<std::int64_t>(surfaces));
        CHECK(mesh.materials.size() == 1);
        CHECK(mesh.materials[0].kind == MaterialKind::Bark);
    }
    const Mesh smooth = meshed(plant.skeleton, boxes(2));
    const double volume = measure(plant.skeleton).volume;
    CHECK(test::volume_of(smooth) == Approx(volume).epsilon(0.15));
    CHECK(test::corners_turned_over(smooth) < smooth.indices.size() / 100);
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
    CHECK(test::corners_turned_over(mesh) == 0);
    // u goes from 0 to 1 and back around the stem; v rises along the stem.
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

TEST_CASE("children that are too many or too short are separate closed boxes") {
    Plant many;
    const std::uint32_t trunk = many.grow(kNoSegment, glm::quat(1, 0, 0, 0), 1.0F, 0.1F, 0.1F);
    for (int i = 0; i < 60; ++i) {
        many.grow(trunk, turned(6.0F * static_cast<float>(i), {0, 1, 0}) * turned(10, {1, 0, 0}),
                  1.0F, 0.02F, 0.02F);
    }
    const Mesh crowd = meshed(many.skeleton, boxes(1));
    CHECK(surface_count(crowd) > 1);
    CHECK(test::topology_by_index(crowd).open_edges == 0);
    Plant short_one;
    const std::uint32_t base = short_one.grow(kNoSegment, glm::quat(1, 0, 0, 0), 1.0F, 0.1F, 0.1F);
    short_one.grow(base, turned(90, {1, 0, 0}), 0.05F, 0.02F, 0.02F);
    short_one.grow(base, turned(10, {1, 0, 0}), 1.0F, 0.02F, 0.02F);
    CHECK(surface_count(meshed(short_one.skeleton, boxes(1))) == 2);
    // A branch that turns back into its parent.
    Plant back;
    back.grow(back.grow(kNoSegment, glm::quat(1, 0, 0, 0), 1.0F, 0.1F, 0.1F),
              turned(175, {1, 0, 0}), 1.0F, 0.05F, 0.05F);
    CHECK(surface_count(meshed(back.skeleton, boxes(2))) == 2);
}

TEST_CASE("segments that cannot be drawn are skipped") {
    Plant plant;
    const std::uint32_t trunk = plant.grow(kNoSegment, glm::quat(1, 0, 0, 0), 1.0F, 0.1F, 0.1F);
    const std::uint32_t without = plant.grow(trunk, turned(5, {1, 0, 0}), 0.0F, 0.1F, 0.1F);
    plant.grow(without, turned(5, {1, 0, 0}), 1.0F, 0.1F, 0.1F); // joined to the trunk
    CHECK(surface_count(meshed(plant.skeleton, boxes(1))) == 1);
    Plant thin;
    thin.grow(kNoSegment, glm::quat(1, 0, 0, 0), 1.0F, 0.0F, 0.0F);
    CHECK(meshed(thin.skeleton, boxes(1)).positions.empty());
    Plant far;
    far.grow(kNoSegment, glm::quat(1, 0, 0, 0), 1.0F, 0.1F, 0.1F);
    far.skeleton.segments[0].base = glm::vec3(1e9F);
    CHECK(meshed(far.skeleton, boxes(1)).positions.empty());
    CHECK(meshed(Skeleton{}, boxes(2)).positions.empty());
}

TEST_CASE("boxes keep colours, coarser levels have fewer steps, and threads change nothing") {
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
    // The coarsest level is not subdivided, but its edges are shaded smoothly.
    CHECK(meshed(plant.skeleton, options).positions.size() ==
          welded(meshed(plant.skeleton, boxes(0))).positions.size());
}

TEST_CASE("an unsmoothed box of a .sys plant is its segment: length, widths, flat faces") {
    Plant plant;
    plant.skeleton.box_segments = true;
    const std::uint32_t first = plant.grow(kNoSegment, glm::quat(1, 0, 0, 0), 2.0F, 0.2F, 0.1F);
    const Mesh mesh = meshed(plant.skeleton, boxes(0));
    CHECK(mesh.positions.size() == 24);
    CHECK(mesh.indices.size() == 36);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec3& at = mesh.positions[i];
        REQUIRE((at.y == 0.0F || at.y == 2.0F));
        const float half = at.y == 0.0F ? 0.2F : 0.1F;
        CHECK(std::abs(at.x) == Approx(half));
        CHECK(std::abs(at.z) == Approx(half));
    }
    // A frustum of a pyramid: h / 3 (A + B + sqrt(A B)).
    CHECK(test::volume_of(mesh) == Approx(2.0 / 3.0 * (0.16 + 0.04 + 0.08)).epsilon(1e-5));
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::dvec3 area =
            test::twice_area(mesh.positions[mesh.indices[i]], mesh.positions[mesh.indices[i + 1]],
                             mesh.positions[mesh.indices[i + 2]]);
        for (std::size_t j = 0; j < 3; ++j) {
            const glm::dvec3 normal(mesh.normals[mesh.indices[i + j]]);
            CHECK(glm::dot(glm::normalize(area), normal) == Approx(1.0).epsilon(1e-5));
        }
    }
    // A following box begins with its own width, so there is a step.
    plant.grow(first, glm::quat(1, 0, 0, 0), 2.0F, 0.2F, 0.1F);
    const Mesh two = meshed(plant.skeleton, boxes(0));
    CHECK(test::volume_of(two) == Approx(4.0 / 3.0 * (0.16 + 0.04 + 0.08)).epsilon(1e-5));
    CHECK(surface_count(welded(two)) == 1);
}

TEST_CASE("plants with the setting for boxes are drawn as boxes unless options override it") {
    Plant plant;
    plant.grow(kNoSegment, glm::quat(1, 0, 0, 0), 2.0F, 0.2F, 0.1F);
    const auto vertices = [&](const MeshOptions& options) {
        Mesh mesh;
        REQUIRE(make_mesh(plant.skeleton, {}, options, mesh) == std::nullopt);
        return mesh.positions.size();
    };
    const std::size_t tube = vertices({});
    CHECK(tube == vertices({.method = MeshMethod::Tubes}));
    plant.skeleton.box_segments = true;
    CHECK(vertices({}) == 24);
    CHECK(vertices({.method = MeshMethod::Boxes}) == 24);
    CHECK(vertices({.method = MeshMethod::Tubes}) == tube);
    CHECK(vertices({.subdivisions = 2}) > 24);
    CHECK(vertices({.grooves = 0.1F}) > vertices({.subdivisions = 2}));
}

TEST_CASE("boxes of another scale are the boxes scaled") {
    for (const float scale : {1.0F / 1024.0F, 1024.0F}) {
        for (std::uint32_t seed = 0; seed < 4; ++seed) {
            Skeleton skeleton = random_plant(seed, 40, 50.0F).skeleton;
            const PolygonMesh before = make_boxes(skeleton, {.smoothed = seed % 2 == 0});
            for (Segment& segment : skeleton.segments) {
                segment.base *= scale;
                segment.length *= scale;
                segment.base_radius *= scale;
                segment.tip_radius *= scale;
            }
            const PolygonMesh after = make_boxes(skeleton, {.smoothed = seed % 2 == 0});
            CAPTURE(scale, seed);
            CHECK(after.corners == before.corners);
            REQUIRE(after.positions.size() == before.positions.size());
            for (std::size_t i = 0; i < after.positions.size(); ++i) {
                CHECK(glm::distance(after.positions[i], scale * before.positions[i]) <
                      1e-4F * scale);
            }
        }
    }
}

TEST_CASE("a branch whose opening lies beside its axis is centred from its first ring on") {
    // The joint is a cube of half side 1. The axis of the branch crosses the plane of the side from
    // which the branch grows at 1 / tan(44 degrees) = 1.04 above the middle of the joint: just
    // outside of the side.
    Plant plant;
    const glm::quat straight(1, 0, 0, 0);
    const std::uint32_t trunk = plant.grow(kNoSegment, straight, 8.0F, 1.0F, 1.0F);
    plant.grow(trunk, straight, 8.0F, 1.0F, 1.0F);
    const std::uint32_t branch = plant.grow(trunk, turned(44, {1, 0, 0}), 8.0F, 0.1F, 0.1F);
    const PolygonMesh mesh = make_boxes(plant.skeleton, {});
    const Segment& own = plant.skeleton.segments[branch];
    std::set<std::uint32_t> corners; // of the branch, and of the side from which it grows
    std::uint32_t begin = 0;
    for (std::size_t face = 0; face < mesh.face_ends.size(); ++face) {
        if (mesh.segments[face] == branch) {
            corners.insert(mesh.corners.begin() + begin,
                           mesh.corners.begin() + mesh.face_ends[face]);
        }
        begin = mesh.face_ends[face];
    }
    std::size_t centred = 0; // corners of a square of half side 0.1 around the axis, near the joint
    for (const std::uint32_t corner : corners) {
        const glm::vec3 from = mesh.positions[corner] - own.base;
        const float along = glm::dot(from, heading(own.frame));
        const float away = glm::length(from - along * heading(own.frame));
        centred += along < 2.0F && std::abs(away - 0.1F * std::sqrt(2.0F)) < 1e-4F ? 1U : 0U;
    }
    CHECK(centred == 4);
}

TEST_CASE("a branch is not wider where it leaves its parent") {
    for (const float degrees : {35.0F, 60.0F, 90.0F}) {
        for (const float roll : {0.0F, 30.0F, 45.0F}) {
            Plant plant;
            const std::uint32_t trunk =
                plant.grow(kNoSegment, glm::quat(1, 0, 0, 0), 1.0F, 0.1F, 0.1F);
            plant.grow(trunk, glm::quat(1, 0, 0, 0), 1.0F, 0.1F, 0.1F);
            const std::uint32_t branch = plant.grow(
                trunk, turned(roll, {0, 1, 0}) * turned(degrees, {1, 0, 0}), 1.0F, 0.03F, 0.03F);
            MeshOptions options = boxes(0);
            options.segments = true;
            const Mesh mesh = meshed(plant.skeleton, options);
            CHECK(surface_count(welded(mesh)) <= 2);
            const Segment& own = plant.skeleton.segments[branch];
            const glm::vec3 on = heading(own.frame);
            std::size_t seen = 0;
            for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
                if (mesh.segments[i] == VertexSegments{branch, branch}) {
                    const glm::vec3 from = mesh.positions[i] - own.base;
                    const float away = glm::length(from - glm::dot(from, on) * on);
                    INFO(degrees << " degrees, roll " << roll);
                    CHECK(away == Approx(0.886F * 0.03F * std::sqrt(2.0F)).epsilon(0.01));
                    ++seen;
                }
            }
            CHECK(seen >= 16);
        }
    }
}

TEST_CASE("smoothed ends are flat, with a rounded edge") {
    Plant plant;
    plant.grow(kNoSegment, glm::quat(1, 0, 0, 0), 1.0F, 0.1F, 0.1F);
    const Mesh mesh = meshed(plant.skeleton, boxes(3));
    const Bounds box = test::bounds_of(mesh);
    CHECK(box.high.y == Approx(1.0F).margin(0.01));
    CHECK(box.low.y == Approx(0.0F).margin(0.01));
    // A half ball would be 0.03 lower at a distance of 0.07 from the axis than on the axis.
    float widest = 0.0F;
    for (const glm::vec3& at : mesh.positions) {
        widest = at.y > 0.985F ? std::max(widest, std::hypot(at.x, at.z)) : widest;
    }
    CHECK(widest > 0.075F);
}

TEST_CASE("separate boxes overlap at their joint") {
    Plant plant;
    const std::uint32_t trunk = plant.grow(kNoSegment, glm::quat(1, 0, 0, 0), 1.0F, 0.1F, 0.1F);
    const std::uint32_t branch = plant.grow(trunk, turned(40, {1, 0, 0}), 1.0F, 0.1F, 0.1F);
    plant.skeleton.segments[trunk].forked = true;
    plant.skeleton.segments[branch].linked = false;
    plant.skeleton.segments[branch].cut = true;
    for (std::uint32_t subdivisions = 0; subdivisions < 3; ++subdivisions) {
        const Mesh made = meshed(plant.skeleton, boxes(subdivisions));
        const Mesh mesh = welded(made);
        CHECK(surface_count(mesh) == 2);
        CHECK(test::topology_by_index(mesh).open_edges == 0);
        // The trunk ends after the joint, within the branch; the branch begins within the trunk.
        const Segment& own = plant.skeleton.segments[branch];
        float trunk_top = 0.0F;
        float nearest = 1.0F;
        for (const glm::vec3& at : mesh.positions) {
            const float along = glm::dot(at - own.base, heading(own.frame));
            const float away = glm::length(at - own.base - along * heading(own.frame));
            nearest = away < 0.05F ? std::min(nearest, along) : nearest;
            trunk_top = std::hypot(at.x, at.z) < 0.05F ? std::max(trunk_top, at.y) : trunk_top;
        }
        if (subdivisions > 0) {
            CHECK(trunk_top > 1.02F);
            CHECK(nearest < 0.02F);
        }
    }
}

TEST_CASE("grooves of boxes are within the stem, symmetric, and keep its ridges") {
    Plant plant;
    std::uint32_t last = plant.grow(kNoSegment, glm::quat(1, 0, 0, 0), 1.0F, 0.1F, 0.1F);
    for (int i = 0; i < 4; ++i) {
        last = plant.grow(last, glm::quat(1, 0, 0, 0), 1.0F, 0.1F, 0.1F);
    }
    const Mesh plain = meshed(plant.skeleton, boxes(4));
    MeshOptions options = boxes(4);
    options.grooves = 0.3F;
    const Mesh grooved = meshed(plant.skeleton, options);
    REQUIRE(grooved.positions.size() == plain.positions.size());
    CHECK(test::topology_by_index(grooved).open_edges == 0);
    CHECK(test::corners_turned_over(grooved) < grooved.indices.size() / 300);
    float min_depth = 1.0F;
    float max_depth = 0.0F;
    for (std::size_t i = 0; i < plain.positions.size(); ++i) {
        const glm::vec3& at = plain.positions[i];
        if (at.y > 1.0F && at.y < 4.0F) {
            const float before = std::hypot(at.x, at.z);
            const float after = std::hypot(grooved.positions[i].x, grooved.positions[i].z);
            const float depth = (before - after) / 0.1075F;
            CHECK(depth > -1e-4F);
            CHECK(depth < 0.3F + 1e-4F);
            min_depth = std::min(min_depth, depth);
            max_depth = std::max(max_depth, depth);
        }
    }
    CHECK(min_depth < 0.01F);
    CHECK(max_depth > 0.29F);
    // A coarser level has too few vertices for grooves, but the same mean thickness.
    options.level = 3;
    const Mesh coarse = meshed(plant.skeleton, options);
    const double coarse_part =
        test::volume_of(coarse) / test::volume_of(meshed(plant.skeleton, boxes(1)));
    CHECK(coarse_part == Approx(test::volume_of(grooved) / test::volume_of(plain)).epsilon(0.1));
}

TEST_CASE("too many subdivisions are refused before memory is allocated") {
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
