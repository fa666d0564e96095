// SPDX-License-Identifier: MIT
// Compares meshes of trees assembled from instances with meshes of plants that were derived, drawn
// and meshed without instancing.
#include "runtime/forest/instance_meshes.h"
#include "tests/support/forest.h"
#include "tests/support/mesh_checks.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <unordered_map>
#include <vector>

using namespace lsys;
using test::heroes;
using test::plain_plant;
using test::plant;
using test::Planted;
using test::tree_of;

namespace {

using Triangle = std::array<glm::dvec3, 3>;

InstanceMeshes meshes_of(const InstanceCache& cache, const MeshOptions& options = {}) {
    InstanceMeshes meshes;
    REQUIRE(make_instance_meshes(cache, {}, options, meshes) == std::nullopt);
    REQUIRE(meshes.first_part.size() == cache.instances.size() + 1);
    return meshes;
}

Mesh plain_mesh(const Skeleton& skeleton, const MeshOptions& options = {}) {
    Mesh mesh;
    REQUIRE(make_mesh(skeleton, {}, options, mesh) == std::nullopt);
    return mesh;
}

/// The triangles of a tree in world space, by the names of their materials.
std::map<std::string, std::vector<Triangle>> triangles_of(const InstanceCache& cache,
                                                          const InstanceMeshes& meshes,
                                                          const Tree& tree,
                                                          std::uint64_t key) {
    std::map<std::string, std::vector<Triangle>> triangles;
    TreeExpander expander(cache, key);
    expander.expand(tree, [&](const BranchInstance& branch) {
        const InstancePose pose = pose_of(branch, cache.instances[branch.instance]);
        for (const MeshPart& part : meshes.parts_of(branch.instance)) {
            std::vector<Triangle>& list = triangles[meshes.mesh.materials[part.material].name];
            for (std::uint64_t i = 0; i < part.index_count; ++i) {
                const glm::vec3& at =
                    meshes.mesh.positions[meshes.mesh.indices[part.first_index + i]];
                if (i % 3 == 0) {
                    list.emplace_back();
                }
                list.back()[i % 3] =
                    glm::dvec3(pose.translation + pose.scale * (pose.rotation * at));
            }
        }
    });
    return triangles;
}

std::map<std::string, std::vector<Triangle>> triangles_of(const Mesh& mesh) {
    std::map<std::string, std::vector<Triangle>> triangles;
    for (const MeshPart& part : mesh.parts) {
        std::vector<Triangle>& list = triangles[mesh.materials[part.material].name];
        for (std::uint64_t i = 0; i < part.index_count; i += 3) {
            Triangle& triangle = list.emplace_back();
            for (std::uint64_t c = 0; c < 3; ++c) {
                triangle[c] = glm::dvec3(mesh.positions[mesh.indices[part.first_index + i + c]]);
            }
        }
    }
    return triangles;
}

/// The coordinates of a triangle, sorted, so that the order of its corners does not matter.
std::array<double, 9> sorted(const Triangle& triangle) {
    std::array<double, 9> values{};
    for (std::size_t c = 0; c < 9; ++c) {
        values[c] = triangle[c / 3][static_cast<int>(c % 3)];
    }
    return values;
}

/// Number of triangles of `a` without a triangle of `b` within `distance` (m). Each triangle of `b`
/// matches at most one triangle.
std::size_t
count_unmatched(const std::vector<Triangle>& a, const std::vector<Triangle>& b, double distance) {
    const double cell = 4.0 * distance;
    const auto middle = [](const Triangle& t) { return (t[0] + t[1] + t[2]) / 3.0; };
    const auto key = [cell](const glm::dvec3& p, int n) {
        const auto part = [cell](double v, int d) {
            return static_cast<std::int64_t>(std::floor(v / cell)) + d;
        };
        return static_cast<std::uint64_t>(part(p.x, n % 3 - 1) * 73856093) ^
               static_cast<std::uint64_t>(part(p.y, n / 3 % 3 - 1) * 19349663) ^
               static_cast<std::uint64_t>(part(p.z, n / 9 - 1) * 83492791);
    };
    constexpr int kHere = 13;
    std::unordered_multimap<std::uint64_t, std::size_t> cells;
    for (std::size_t i = 0; i < b.size(); ++i) {
        cells.emplace(key(middle(b[i]), kHere), i);
    }
    std::vector<bool> taken(b.size());
    const auto alike = [distance](const Triangle& one, const Triangle& other) {
        for (std::size_t turn = 0; turn < 3; ++turn) {
            bool near = true;
            for (std::size_t c = 0; c < 3; ++c) {
                near = near && glm::distance(one[c], other[(c + turn) % 3]) <= distance;
            }
            if (near) {
                return true;
            }
        }
        return false;
    };
    const auto take = [&](const Triangle& triangle) {
        for (int n = 0; n < 27; ++n) {
            const auto [begin, end] = cells.equal_range(key(middle(triangle), n));
            for (auto other = begin; other != end; ++other) {
                if (!taken[other->second] && alike(triangle, b[other->second])) {
                    taken[other->second] = true;
                    return true;
                }
            }
        }
        return false;
    };
    std::size_t strangers = 0;
    for (const Triangle& triangle : a) {
        strangers += take(triangle) ? 0U : 1U;
    }
    return strangers;
}

const std::string kMeshedBush = "#set names letters; #object l LEAF; #w : A;"
                                "#p : A : ~ 0.5 : F[+Al][-A]/A; #q : A : ~ 0.3 : F[+A]//A;"
                                "#r : A : ~ 0.2 : FF[&A]F[+l];";

} // namespace

TEST_CASE(
    "without exchanged branches, an instance has the triangles of the plain plant, bit for bit") {
    const auto method = GENERATE(MeshMethod::Tubes, MeshMethod::Cylinders);
    MeshOptions options;
    options.method = method;
    const Planted planted = plant(kMeshedBush, 6, 0.0F, heroes(4, 40));
    const InstanceMeshes meshes = meshes_of(planted.cache, options);
    for (std::uint32_t i = 0; i < planted.cache.instances.size(); ++i) {
        const Instance& instance = planted.cache.instances[i];
        if (instance.slot != 0) {
            // With rho 0 no branch is replaced, so no tree contains this instance.
            CHECK(meshes.parts_of(i).empty());
            continue;
        }
        const auto expected =
            triangles_of(plain_mesh(plain_plant(kMeshedBush, 6, 40 + instance.hero), options));
        std::size_t found = 0;
        for (const MeshPart& part : meshes.parts_of(i)) {
            std::vector<std::array<double, 9>> found_triangles;
            std::vector<std::array<double, 9>> expected_triangles;
            for (std::uint64_t t = 0; t < part.index_count; t += 3) {
                Triangle triangle;
                for (std::uint64_t c = 0; c < 3; ++c) {
                    triangle[c] = glm::dvec3(
                        meshes.mesh.positions[meshes.mesh.indices[part.first_index + t + c]]);
                }
                found_triangles.push_back(sorted(triangle));
            }
            for (const Triangle& triangle :
                 expected.at(meshes.mesh.materials[part.material].name)) {
                expected_triangles.push_back(sorted(triangle));
            }
            std::sort(found_triangles.begin(), found_triangles.end());
            std::sort(expected_triangles.begin(), expected_triangles.end());
            CHECK(found_triangles == expected_triangles);
            ++found;
        }
        CHECK(found == expected.size());
    }
}

TEST_CASE("without chance, a tree has the surface of the plain plant") {
    const std::string grammar = GENERATE(
        as<std::string>{},
        "#set turtle houdini; #set names letters; #w : A; #p : A : * : !\"F[&A][//&A]////[^A]F;",
        "#w : A(1, 0.3); #p : A(l, w) : * : !(w) F(l) [&(30) A(l*0.8, w*0.7)] /(137)"
        "[&(50) A(l*0.6, w*0.5)] A(l*0.9, w*0.8);",
        "#set names letters; #object l LEAF; #w : A; #p : A : * : F[+B]A[-l]; "
        "#q : B : * : F[-Bl]FB; "
        "#r : F : * : FF;",
        // Branches without a segment, a polygon in a branch, and an end that forks.
        "#set names letters; #object l LEAF; #w : A; "
        "#p : A : * : F[+l][-{.f.+f.+f}]F[&A][^B]; "
        "#q : B : * : [//C]F; #s : C : * : FC[+l];");
    const float rho = GENERATE(0.3F, 0.6F, 1.0F);
    const auto method = GENERATE(MeshMethod::Tubes, MeshMethod::Cylinders);
    MeshOptions options;
    options.method = method;
    const Planted planted = plant(grammar, 5, rho, heroes(3));
    const InstanceMeshes meshes = meshes_of(planted.cache, options);
    const Mesh whole = plain_mesh(plain_plant(grammar, 5, 0), options);
    const auto plain = triangles_of(whole);
    Bounds bounds = test::bounds_of(whole);
    for (std::uint32_t number = 0; number < 5; ++number) {
        const auto tree = triangles_of(planted.cache, meshes, tree_of(number), 1);
        INFO(grammar << " rho " << rho << " tree " << number);
        REQUIRE(tree.size() == plain.size());
        Bounds of_tree;
        for (const auto& [material, triangles] : tree) {
            INFO(material);
            REQUIRE(plain.count(material) == 1);
            CHECK(triangles.size() == plain.at(material).size());
            CHECK(count_unmatched(triangles, plain.at(material), 1e-4) == 0);
            for (const Triangle& triangle : triangles) {
                for (const glm::dvec3& corner : triangle) {
                    of_tree.add(glm::vec3(corner));
                }
            }
        }
        CHECK(glm::distance(of_tree.low, bounds.low) < 1e-4F);
        CHECK(glm::distance(of_tree.high, bounds.high) < 1e-4F);
    }
}

TEST_CASE("nested instances share vertices") {
    const Planted planted = plant(kMeshedBush, 6, 0.5F, heroes(10));
    const InstanceMeshes meshes = meshes_of(planted.cache);
    const Mesh heroes_mesh = plain_mesh(planted.cache.skeleton);
    // There are more vertices than in the heroes only because ends at omitted branches are half
    // balls instead of discs.
    CHECK(meshes.mesh.positions.size() < 2 * heroes_mesh.positions.size());
    std::uint64_t end = 0;
    for (const MeshPart& part : meshes.mesh.parts) {
        CHECK(part.first_index == end);
        CHECK(part.index_count > 0);
        CHECK(part.index_count % 3 == 0);
        CHECK(part.material < meshes.mesh.materials.size());
        end += part.index_count;
    }
    CHECK(end == meshes.mesh.indices.size());
    CHECK(end > heroes_mesh.indices.size());
    for (const std::uint32_t index : meshes.mesh.indices.expanded()) {
        REQUIRE(index < meshes.mesh.positions.size());
    }
    CHECK(meshes.mesh.segments.empty());
}

TEST_CASE("an exchanged branch begins with the place and width of the slot in its parent") {
    const std::string grammar = "#set names letters; #set turtle houdini; #w : A;"
                                "#p : A : ~ 0.5 : F![&A][//&A]/A; #q : A : ~ 0.5 : F[^A]F[+A];";
    const Planted planted = plant(grammar, 6, 0.6F, heroes(10));
    const InstanceCache& cache = planted.cache;
    std::size_t grafts = 0;
    double worst = 0.0;
    for (const Instance& instance : cache.instances) {
        for (std::uint32_t e = 0; e < instance.exit_count; ++e) {
            const InstanceExit& exit = cache.exits[instance.first_exit + e];
            const InstanceSlot& slot = cache.slots[exit.slot];
            // Radius and offset of the first ring of each instance that can fill the slot, in the
            // frame of its entry.
            std::vector<std::array<double, 2>> rings;
            for (std::uint32_t v = 0; v < slot.variant_count; ++v) {
                const Instance& variant = cache.instances[cache.variants[slot.first_variant + v]];
                if (variant.size.segments == 0) {
                    continue;
                }
                const std::uint32_t first = cache.ranges[variant.first_range].begin.segments;
                const Segment& segment = cache.skeleton.segments[first];
                rings.push_back({static_cast<double>(segment.base_radius),
                                 glm::distance(glm::dvec3(segment.base), variant.position)});
            }
            for (const auto& [radius, off] : rings) {
                worst = std::max(
                    {worst, std::abs(radius - rings[0][0]) / rings[0][0], off / rings[0][0]});
                ++grafts;
            }
        }
    }
    CHECK(grafts > 500);
    CHECK(worst <= 1e-3);
}

TEST_CASE("surfaces of instances are the same for any number of threads") {
    const Planted planted = plant(kMeshedBush, 7, 0.5F, heroes(10));
    MeshOptions options;
    options.threads = 1;
    const InstanceMeshes one = meshes_of(planted.cache, options);
    options.threads = 4;
    const InstanceMeshes four = meshes_of(planted.cache, options);
    CHECK(one.mesh.indices == four.mesh.indices);
    CHECK(one.mesh.positions == four.mesh.positions);
    CHECK(one.first_part == four.first_part);
}

TEST_CASE("the boxes of an instance are separate closed surfaces") {
    const std::string grammar =
        GENERATE(as<std::string>{}, kMeshedBush,
                 "#set turtle sys; #set names letters; #w : F; #p : F : * : F[`>`F][`<`F]F;",
                 "#set names letters; #w : A; #p : A : * : F[+B]A[-B]; #q : B : * : F[-B]FB; "
                 "#r : F : * : FF;");
    const float rho = GENERATE(0.0F, 0.5F, 1.0F);
    const std::uint32_t subdivisions = GENERATE(0U, 2U);
    MeshOptions options;
    options.method = MeshMethod::Boxes;
    options.subdivisions = subdivisions;
    const Planted planted = plant(grammar, 5, rho, heroes(4));
    const InstanceMeshes meshes = meshes_of(planted.cache, options);
    std::size_t instances = 0;
    for (std::uint32_t i = 0; i < planted.cache.instances.size(); ++i) {
        Mesh bark; // only the bark of the instance
        bark.positions = meshes.mesh.positions;
        for (const MeshPart& part : meshes.parts_of(i)) {
            for (std::uint64_t k = 0;
                 k < part.index_count &&
                 meshes.mesh.materials[part.material].kind == MaterialKind::Bark;
                 ++k) {
                bark.indices.push_back(meshes.mesh.indices[part.first_index + k]);
            }
        }
        INFO(grammar << " rho " << rho << " instance " << i);
        // Branches that begin at one place share edges there, so edges need only be balanced.
        REQUIRE(test::topology_of(bark).unbalanced_edges == 0);
        if (bark.indices.size() != 0) {
            ++instances;
            CHECK(test::volume_of(bark) > 0.0);
        }
    }
    CHECK(instances > 0);
    // Every segment of a tree is drawn, so the bounding box of the tree equals that of the plain
    // plant to 0.1 m.
    const Bounds plain = test::bounds_of(plain_mesh(plain_plant(grammar, 5, 0), options));
    if (grammar.find('~') == std::string::npos) {
        Bounds bounds;
        for (const auto& [material, triangles] :
             triangles_of(planted.cache, meshes, tree_of(1), 1)) {
            for (const Triangle& triangle : triangles) {
                for (const glm::dvec3& corner : triangle) {
                    bounds.add(glm::vec3(corner));
                }
            }
        }
        CHECK(glm::distance(bounds.low, plain.low) < 0.1F);
        CHECK(glm::distance(bounds.high, plain.high) < 0.1F);
    }
}

TEST_CASE("surfaces of instances over the limit of memory are refused") {
    const Planted planted = plant(kMeshedBush, 5, 0.5F, heroes(4));
    InstanceMeshes meshes;
    MeshOptions options;
    options.method = MeshMethod::Tubes;
    REQUIRE(make_instance_meshes(planted.cache, {}, options, meshes) == std::nullopt);
    const std::uint64_t bytes = meshes.mesh.byte_count();
    options.max_bytes = bytes;
    CHECK(make_instance_meshes(planted.cache, {}, options, meshes) == std::nullopt);
    options.max_bytes = bytes - 1;
    CHECK(make_instance_meshes(planted.cache, {}, options, meshes) == Stop::Limit);
    CHECK(meshes.mesh.positions.empty());
    options.max_bytes = 100;
    CHECK(make_instance_meshes(planted.cache, {}, options, meshes) == Stop::Limit);
    CHECK(make_instance_meshes({}, {}, {}, meshes) == std::nullopt);
    CHECK(meshes.first_part.size() == 1);
}
