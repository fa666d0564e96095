// SPDX-License-Identifier: MIT
// Skins: the segments that move each vertex, and joints shared by segments.
#include "runtime/export/export.h"
#include "runtime/export/impl/skin.h"
#include "tests/runtime/plants.h"
#include "tests/support/plants.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

using namespace lsys;
using namespace lsys::test;

namespace {

Mesh mesh_of(const Skeleton& plant, MeshOptions options) {
    options.segments = true;
    options.threads = 2;
    Mesh mesh;
    REQUIRE(make_mesh(plant, {}, options, mesh) == std::nullopt);
    REQUIRE(mesh.segments.size() == mesh.positions.size());
    return mesh;
}

/// The nearest point of a segment's axis: its distance, and its place along the segment, 0 to 1.
struct Foot {
    float distance = 0.0F;
    float along = 0.0F;
};
Foot foot(const Segment& segment, const glm::vec3& point) {
    const glm::vec3 way = tip(segment) - segment.base;
    const float along =
        std::clamp(glm::dot(point - segment.base, way) / glm::dot(way, way), 0.0F, 1.0F);
    return {glm::length(point - segment.base - along * way), along};
}

/// A crooked line of `count` segments that do not overlap.
Skeleton crooked(std::uint32_t count) {
    Skeleton plant;
    std::uint32_t last = kNoSegment;
    for (std::uint32_t i = 0; i < count; ++i) {
        last = add_segment(plant, last, leaning(i % 2 == 0 ? 0.0F : 0.3F),
                           rod(1.0F, 0.1F, 1.0F, 1.0F));
    }
    return plant;
}

/// Poses of a skeleton at rest.
PlantAnimation still(const Skeleton& plant, std::uint32_t frames) {
    PlantAnimation poses;
    poses.frame_count = frames;
    poses.segment_count = static_cast<std::uint32_t>(plant.segments.size());
    for (std::uint32_t i = 0; i < frames; ++i) {
        for (const Segment& segment : plant.segments) {
            poses.places.push_back({segment.base, segment.frame});
        }
    }
    return poses;
}

} // namespace

TEST_CASE("a ring has half of its weight on each segment of its joint") {
    const Skeleton plant = crooked(5);
    for (const MeshOptions& options :
         {MeshOptions{}, MeshOptions{.texture_coordinates = false, .tangents = false},
          MeshOptions{.level = 1}, MeshOptions{.bark_noise = 0.1F},
          MeshOptions{.level = 3, .bark_noise = 0.3F}}) {
        const Mesh mesh = mesh_of(plant, options);
        bool halved = false;
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            const VertexSegments at = mesh.segments[i];
            REQUIRE(at[0] < 5);
            REQUIRE((at[1] == at[0] || at[1] == at[0] + 1));
            for (const std::uint32_t segment : at) {
                CHECK(foot(plant.segments[segment], mesh.positions[i]).distance < 0.2F);
            }
            if (at[0] != at[1]) {
                halved = true;
                CHECK(foot(plant.segments[at[0]], mesh.positions[i]).along > 0.9F);
                CHECK(foot(plant.segments[at[1]], mesh.positions[i]).along < 0.1F);
            }
        }
        CHECK(halved);
        // The cap at the end belongs to the last segment, the cap at the start to the first.
        CHECK(mesh.segments[0] == VertexSegments{0, 0});
        const auto highest =
            std::max_element(mesh.positions.begin(), mesh.positions.end(),
                             [](const glm::vec3& a, const glm::vec3& b) { return a.y < b.y; });
        CHECK(mesh.segments[static_cast<std::size_t>(highest - mesh.positions.begin())] ==
              VertexSegments{4, 4});
    }
}

TEST_CASE("the rings of a sharp bend are assigned to different segments") {
    Skeleton plant = crooked(1);
    add_segment(plant, 0, leaning(2.8F), rod(1.0F, 0.1F, 1.0F, 1.0F)); // three rings
    const Mesh mesh = mesh_of(plant, {});
    for (const VertexSegments& wanted :
         {VertexSegments{0, 0}, VertexSegments{0, 1}, VertexSegments{1, 1}}) {
        CHECK(std::count(mesh.segments.begin(), mesh.segments.end(), wanted) >= 8);
    }
}

TEST_CASE("vertices of random trees are bound to a segment near them, with every mesh method") {
    for (std::uint32_t seed = 1; seed <= 6; ++seed) {
        const Skeleton plant = random_tree(seed, 3);
        for (const MeshOptions& options :
             {MeshOptions{}, MeshOptions{.level = 2}, MeshOptions{.level = 1, .bark_noise = 0.2F},
              MeshOptions{.deviation = 0.003F},
              MeshOptions{.level = 1, .deviation = 0.003F, .bark_noise = 0.2F},
              MeshOptions{.method = MeshMethod::Cylinders},
              MeshOptions{.method = MeshMethod::Boxes},
              MeshOptions{.method = MeshMethod::Boxes, .subdivisions = 0}}) {
            const Mesh mesh = mesh_of(plant, options);
            // Smoothed boxes cut corners of the axis.
            const bool smooth = options.method == MeshMethod::Boxes && options.subdivisions != 0U;
            const float cut = smooth ? 0.2F : 0.0F;
            std::size_t far = 0;
            std::size_t halved = 0;
            for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
                halved += mesh.segments[i][0] != mesh.segments[i][1] ? 1U : 0U;
                // The larger radius, because a box may begin at the corner of a thicker one.
                float thick = 0.0F;
                for (const std::uint32_t number : mesh.segments[i]) {
                    REQUIRE(number < plant.segments.size());
                    thick = std::max(thick, plant.segments[number].base_radius);
                }
                for (const std::uint32_t number : mesh.segments[i]) {
                    const Segment& segment = plant.segments[number];
                    const float away = foot(segment, mesh.positions[i]).distance;
                    far += away > 2.5F * thick + cut * segment.length ? 1U : 0U;
                }
            }
            INFO("seed " << seed << ", method " << static_cast<int>(options.method) << ", level "
                         << options.level);
            CHECK(far == 0);
            CHECK((halved > 0) == (options.method != MeshMethod::Cylinders));
        }
    }
}

TEST_CASE("objects and polygons are bound to their parent segment, if any") {
    Skeleton plant = crooked(3);
    for (const std::uint32_t parent : {2U, 0U, kNoSegment}) {
        PlacedObject leaf;
        leaf.kind = TurtleOperation::Leaf;
        leaf.parent = parent;
        leaf.colour = 5;
        plant.objects.push_back(leaf);
    }
    plant.corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    plant.polygons.push_back({.first_corner = 0, .corner_count = 3, .parent = 1, .colour = 7});
    const Mesh mesh = mesh_of(plant, {});
    std::vector<std::uint32_t> leaves;
    for (std::size_t i = 0; i < mesh.segments.size(); ++i) {
        const auto [first, second] = mesh.segments[i];
        if (mesh.colours[i] == 7) {
            CHECK(mesh.segments[i] == VertexSegments{1, 1});
        } else if (mesh.colours[i] == 5) {
            CHECK(first == second);
            leaves.push_back(first);
        }
    }
    CHECK(leaves.size() % 3 == 0);
    const auto third = static_cast<std::ptrdiff_t>(leaves.size() / 3);
    for (const std::uint32_t parent : {2U, 0U, kNoSegment}) {
        CHECK(std::count(leaves.begin(), leaves.end(), parent) == third);
    }
}

TEST_CASE("segments that move together share a joint") {
    // Segment 0 is at rest, 1 turns, 2 moves with 1, 3 turns further.
    const Skeleton plant = crooked(4);
    Mesh mesh = mesh_of(plant, {});
    PlantAnimation poses = still(plant, 3);
    const glm::quat turn = glm::angleAxis(0.1F, glm::vec3(1.0F, 0.0F, 0.0F));
    const glm::vec3 about = plant.segments[1].base;
    for (const std::size_t segment : {1U, 2U, 3U}) {
        SegmentPlace& place = poses.places[8 + segment];
        place.base = about + turn * (place.base - about);
        place.frame = turn * place.frame;
    }
    poses.places[11].frame = turn * poses.places[11].frame;
    const std::optional<Skin> skin = make_skin(mesh, plant, poses);
    REQUIRE(skin);
    CHECK(skin->segments == std::vector<std::uint32_t>{1, 3});
    CHECK(skin->joint_count() == 3);
    CHECK(skin->joint_of(0) == 0);
    CHECK(skin->joint_of(1) == 1);
    CHECK(skin->joint_of(2) == 1);
    CHECK(skin->joint_of(3) == 2);
    CHECK(skin->joint_of(kNoSegment) == 0);

    // A joint without vertices is left out.
    for (VertexSegments& segments : mesh.segments) {
        segments = {std::min(segments[0], 2U), std::min(segments[1], 2U)};
    }
    CHECK(make_skin(mesh, plant, poses)->segments == std::vector<std::uint32_t>{1});
}

TEST_CASE("rotations of a joint have unit length and continuous signs") {
    const Skeleton plant = crooked(1);
    PlantAnimation poses = still(plant, 9);
    for (std::size_t i = 0; i < poses.places.size(); ++i) {
        const auto angle = static_cast<float>(i);
        poses.places[i].frame =
            (i % 2 == 0 ? 1.01F : -0.98F) * glm::angleAxis(angle, glm::vec3(0.0F, 0.0F, 1.0F));
    }
    std::vector<glm::quat> rotations;
    joint_rotations(poses, 0, rotations);
    REQUIRE(rotations.size() == 9);
    for (std::size_t i = 0; i < rotations.size(); ++i) {
        CHECK(glm::length(rotations[i]) == Approx(1.0F));
        CHECK(std::abs(glm::dot(rotations[i], glm::normalize(poses.places[i].frame))) ==
              Approx(1.0F));
        CHECK((i == 0 || glm::dot(rotations[i - 1], rotations[i]) >= 0.0F));
    }
}

TEST_CASE("a USDA has a skeleton with a sample for each frame") {
    const Skeleton plant = crooked(2);
    const Mesh mesh = mesh_of(plant, {.sides = 3, .texture_coordinates = false, .tangents = false});
    PlantAnimation poses = still(plant, 2);
    poses.frames_per_second = 12.5F;
    poses.places[3].base += glm::vec3(0.0F, 0.0F, 0.5F);
    poses.places[3].frame = glm::quat(0.5F, 0.5F, -0.5F, 0.5F);
    const ExportInfo info{.grammar = "g",
                          .seed = 1,
                          .generations = 1,
                          .generator = "lsc",
                          .mtl_name = "",
                          .picture_prefix = "",
                          .animation = &poses};
    std::string text;
    REQUIRE(export_mesh(mesh, plant, ExportFormat::Usda, info, [&text](std::string_view piece) {
                text += piece;
                return true;
            }).ok());
    const auto has = [&text](const std::string& part) {
        return text.find(part) != std::string::npos;
    };
    CHECK(has("    startTimeCode = 0\n    endTimeCode = 1\n    timeCodesPerSecond = 12.5\n"
              "    framesPerSecond = 12.5\n"));
    CHECK(has("def SkelRoot \"Plant\" ("));
    CHECK(
        has("    def Mesh \"Mesh\" (\n        prepend apiSchemas = [\"SkelBindingAPI\"]\n    )\n"));
    // Segment 0 is at rest; the first ring belongs to it alone, the second to both segments.
    CHECK(has("        int[] primvars:skel:jointIndices = [0, 0, "));
    CHECK(has("        float[] primvars:skel:jointWeights = [1, 0, "));
    CHECK(has("0, 1, 0, 1"));
    CHECK(has("0.5, 0.5"));
    CHECK(has("        rel skel:skeleton = </Plant/Skeleton>\n"));
    CHECK(has("uniform token[] joints = [\"plant\", \"plant/segment_1\"]\n"));
    const glm::vec3& rest = poses.places[1].base;
    const glm::vec3& moved = poses.places[3].base;
    CHECK(has(fmt::format("            float3[] translations.timeSamples = {{\n"
                          "                0: [(0, 0, 0), ({}, {}, {})],\n"
                          "                1: [(0, 0, 0), ({}, {}, {})],\n"
                          "            }}\n",
                          rest.x, rest.y, rest.z, moved.x, moved.y, moved.z)));
    CHECK(has("                1: [(1, 0, 0, 0), (0.5, 0.5, -0.5, 0.5)],\n"));
    // Last row of restTransforms.
    CHECK(has(fmt::format("({}, {}, {}, 1))]\n", rest.x, rest.y, rest.z)));
}

TEST_CASE("a skin has at most 65,535 moving joints") {
    for (const std::uint32_t count : {kMaxJoints, kMaxJoints + 1}) {
        Skeleton plant;
        for (std::uint32_t i = 0; i < count; ++i) {
            Segment segment = rod(0.5F, 0.1F, 1.0F, 1.0F);
            segment.sides = 3;
            segment.base.x = static_cast<float>(i % 256);
            segment.base.z = static_cast<float>(i / 256);
            plant.segments.push_back(segment);
        }
        const Mesh mesh = mesh_of(plant, {.texture_coordinates = false, .tangents = false});
        PlantAnimation poses = still(plant, 2);
        for (std::uint32_t i = 0; i < count; ++i) {
            poses.places[count + i].base.y += 1.0F;
        }
        const ExportInfo info{.grammar = "g",
                              .seed = 1,
                              .generations = 1,
                              .generator = "lsc",
                              .mtl_name = "",
                              .picture_prefix = "",
                              .animation = &poses};
        std::uint64_t bytes = 0;
        const Outcome<void> outcome =
            export_mesh(mesh, plant, ExportFormat::Glb, info, [&bytes](std::string_view piece) {
                bytes += piece.size();
                return true;
            });
        const bool fits = count == kMaxJoints;
        CHECK(outcome.ok() == fits);
        if (!fits) {
            REQUIRE(outcome.stop() == Stop::Limit);
            const Diagnostic& diagnostic = outcome.messages().all().at(0).diagnostics.all()[0];
            CHECK(diagnostic.message == "the skin does not fit into 65,535 joints");
            CHECK(diagnostic.help.at(0) ==
                  "ask for fewer generations with `-n`, or for a numbered series in a format "
                  "without skins: `-o tree.ply`");
        }
        CHECK((bytes > 0) == fits);
    }
}
