// SPDX-License-Identifier: MIT
// Squares of a streamed forest: which ones a camera wants, and the trees of those shown.
#include "tests/viewer/wood.h"
#include "viewer/scene/forest_square.h"
#include "viewer/scene/forest_stream.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

using namespace lsys;
using namespace lsys::tests;
using namespace lsys::view;

namespace {

constexpr double kStreamedDensity = 0.01;          // trees per m2
constexpr std::uint64_t kStreamBytes = 20'000'000; // bytes
constexpr Region kStreamedGround{-100'000.0, -90'000.0, 200'000.0, 180'000.0};

ForestStream make_stream(std::uint64_t bytes) {
    return {make_square_layout(kStreamedGround, kStreamedDensity), 12.0F,
            [](const Region& region) { return kStreamedDensity * region.area(); }, bytes};
}

Camera camera_over(double x, double y, double z) {
    Camera camera;
    camera.origin = nearest_origin({x, y, z});
    camera.eye = glm::vec3(glm::dvec3(x, y, z) - camera.origin);
    camera.target = camera.eye + glm::vec3(1.0F, 0.0F, 0.0F);
    return camera;
}

/// Distance in m from the eye to a square, seen from above.
double distance_to_square(const ForestStream& stream, const SquareId& id, const Camera& camera) {
    const Region region = stream.layout().region_of(id);
    const glm::dvec3 eye = eye_of(camera);
    return std::hypot(eye.x - std::clamp(eye.x, region.x, region.x + region.width),
                      eye.z - std::clamp(eye.z, region.z, region.z + region.depth));
}

/// A wood in squares of 64 m, which are added to ForestLod one by one.
struct StreamedWood {
    std::unique_ptr<Wood> wood;
    std::vector<std::shared_ptr<const ForestSquare>> squares;
};

/// `shift`: m by which the trees are moved along X and Z.
StreamedWood make_streamed_wood(double shift) {
    StreamedWood made;
    made.wood = make_wood(3000, 256.0F);
    LargeVector<Tree> trees = std::exchange(made.wood->forest.trees, {});
    auto streamed = std::make_shared<StreamedTrees>();
    streamed->layout = {{shift, shift, 256.0, 256.0}, 64.0, 4};
    streamed->mean_scales = {1.0F};
    streamed->crown_weights = {1.0F};
    streamed->tallest = 20.0F;
    made.wood->model.streamed = streamed;
    std::map<SquareId, std::vector<Tree>> by_square;
    for (Tree& tree : trees) {
        for (float* const along : {&tree.position.x, &tree.position.z}) {
            // Multiples of 1/64 m, which binary32 can represent at far places too.
            *along =
                static_cast<float>(std::floor(static_cast<double>(*along) * 64.0) / 64.0 + shift);
        }
        by_square[streamed->layout.square_at(static_cast<double>(tree.position.x),
                                             static_cast<double>(tree.position.z))]
            .push_back(tree);
    }
    SquareMaker maker(made.wood->model);
    for (auto& [id, own] : by_square) {
        made.squares.push_back(std::make_shared<const ForestSquare>(maker.make(id, own)));
    }
    return made;
}

struct DrawnSquares {
    std::vector<std::array<float, 4>> trees; // place and BlendRange::low, in the order of drawing
    std::vector<std::array<float, 4>> clusters;                // place and BlendRange::low
    std::vector<std::pair<std::uint32_t, std::uint32_t>> runs; // instance and count
    std::uint64_t triangles = 0;

    friend bool operator==(const DrawnSquares&, const DrawnSquares&) = default;
};

DrawnSquares drawn_list_of(ForestLod& lod, const Camera& camera) {
    const DrawLists& lists = lod.select(make_frustum(camera, 640, 480), wood_lod());
    DrawnSquares drawn;
    for (const ImpostorEntry& entry : lists.trees) {
        const glm::vec3& place = lod.lod_tree(entry.index).position;
        drawn.trees.push_back({place.x, place.y, place.z, entry.range.low});
    }
    for (const ImpostorEntry& entry : lists.clusters) {
        const glm::vec3& place = lod.cells()[entry.index].middle;
        drawn.clusters.push_back({place.x, place.y, place.z, entry.range.low});
    }
    for (const BranchRun& run : lists.runs) {
        drawn.runs.emplace_back(run.instance, run.count);
    }
    drawn.triangles = lists.triangles;
    return drawn;
}

Camera streamed_wood_camera() {
    return {{20.0F, 5.0F, 20.0F}, {200.0F, 2.0F, 190.0F}, 70.0F};
}

} // namespace

TEST_CASE("a layout has squares of about 4,096 trees and cells of about 16") {
    for (const double density : {0.0004, 0.01, 0.04, 1.0}) {
        const SquareLayout layout = make_square_layout(kStreamedGround, density);
        const double trees = density * layout.side * layout.side;
        CHECK(trees >= 2048.0);
        CHECK(trees <= 8192.0);
        CHECK(trees / layout.cell_count() >= 16.0);
        CHECK(trees / layout.cell_count() < 20.0);
        CHECK(std::exp2(std::round(std::log2(layout.side))) == layout.side);
    }
}

TEST_CASE("a camera wants the nearest squares within its budget, each once") {
    const ForestStream stream = make_stream(kStreamBytes);
    const auto [x, z] = GENERATE(std::pair(0.0, 0.0), std::pair(99'999.0, 12.5),
                                 std::pair(-100'000.0, -90'000.0), std::pair(70'000.5, -33.0));
    const Camera camera = camera_over(x, 60.0, z);
    const WantedSquares wanted = stream.wanted(camera, 30.0F, 720);
    REQUIRE(!wanted.squares.empty());
    double bytes = 0.0;
    double before = 0.0;
    for (const SquareId& id : wanted.squares) {
        bytes += stream.expected_bytes(id);
        const double distance = distance_to_square(stream, id, camera);
        CHECK(distance >= before);
        before = distance;
    }
    CHECK(bytes <= kWantedPart * static_cast<double>(kStreamBytes));
    const std::set<SquareId> unique(wanted.squares.begin(), wanted.squares.end());
    CHECK(unique.size() == wanted.squares.size());
    // No gap: every place of the ground within the range is in a wanted square.
    const double range = std::sqrt(std::pow(static_cast<double>(wanted.range), 2.0) - 900.0);
    for (int i = 0; i < 2000; ++i) {
        const double angle = 0.01 * i;
        const double away = range * 0.9995 * (i % 50) / 49.0;
        const double px = x + away * std::cos(angle);
        const double pz = z + away * std::sin(angle);
        if (kStreamedGround.contains(static_cast<float>(px), static_cast<float>(pz))) {
            CHECK(unique.count(stream.layout().square_at(px, pz)) == 1);
        }
    }
}

TEST_CASE("a larger budget shows more, up to trees of three pixels") {
    std::size_t before = 0;
    for (const std::uint64_t bytes : {kStreamBytes, 4 * kStreamBytes, 16 * kStreamBytes}) {
        const std::size_t count =
            make_stream(bytes).wanted(camera_over(0, 2, 0), 0.0F, 720).squares.size();
        CHECK(count > before);
        before = count;
    }
    const WantedSquares all =
        make_stream(64 * kStreamBytes).wanted(camera_over(0, 2, 0), 0.0F, 720);
    CHECK(all.range == Approx(12.0 * 360.0 / std::tan(20.0 * 3.14159265358979 / 180.0) / 3.0));
    CHECK(make_stream(128 * kStreamBytes).wanted(camera_over(0, 2, 0), 0.0F, 720).squares ==
          all.squares);
    CHECK(make_stream(kStreamBytes).wanted(camera_over(0, 9000, 0), 0.0F, 720).squares.empty());
}

TEST_CASE("trees of squares are drawn alike whatever way the squares have come") {
    const StreamedWood made = make_streamed_wood(0.0);
    ForestLod direct(made.wood->model);
    for (const auto& square : made.squares) {
        direct.add_square(square);
    }
    ForestLod other(made.wood->model);
    for (auto square = made.squares.rbegin(); square != made.squares.rend(); ++square) {
        other.add_square(*square);
    }
    for (std::size_t i = 0; i < made.squares.size(); i += 3) {
        other.remove_square(made.squares[i]->id);
    }
    other.set_origin({4096.0, 0.0, -8192.0});
    CHECK(other.alive_count() < direct.alive_count());
    for (std::size_t i = 0; i < made.squares.size(); i += 3) {
        other.add_square(made.squares[i]);
    }
    other.set_origin({});
    CHECK(direct.alive_count() == 3000);
    CHECK(other.alive_count() == 3000);
    const DrawnSquares near = drawn_list_of(direct, streamed_wood_camera());
    CHECK(near.trees.size() > 100);
    CHECK(near.triangles > 0);
    CHECK(near == drawn_list_of(other, streamed_wood_camera()));
    const Camera away{{-3000.0F, 50.0F, 100.0F}, {100.0F, 0.0F, 100.0F}, 20.0F};
    const DrawnSquares far = drawn_list_of(direct, away);
    CHECK(far.clusters.size() > 10);
    CHECK(far == drawn_list_of(other, away));
    std::set<std::uint32_t> numbers;
    other.for_each_alive([&](const LodTree&, const Tree& tree) { numbers.insert(tree.number); });
    CHECK(numbers.size() == 3000);
}

TEST_CASE("a forest 147 km away is drawn exactly as the same forest at the origin") {
    constexpr double kShift = 36.0 * kOriginStep;
    const StreamedWood near = make_streamed_wood(0.0);
    const StreamedWood far = make_streamed_wood(kShift);
    ForestLod near_lod(near.wood->model);
    ForestLod far_lod(far.wood->model);
    for (std::size_t i = 0; i < near.squares.size(); ++i) {
        near_lod.add_square(near.squares[i]);
        far_lod.add_square(far.squares[i]);
    }
    far_lod.set_origin({kShift, 0.0, kShift});
    const DrawnSquares drawn = drawn_list_of(near_lod, streamed_wood_camera());
    CHECK(drawn.trees.size() > 100);
    CHECK(drawn == drawn_list_of(far_lod, streamed_wood_camera()));
}

TEST_CASE("a far camera keeps places of a tenth of a millimetre") {
    const Camera camera =
        parse_camera("eye 150000.1234,2.5,-149999.8765 target 150001.5,2.5,-149990", Camera{})
            .value();
    CHECK(camera.origin == glm::dvec3(151'552.0, 0.0, -151'552.0));
    CHECK(std::abs(eye_of(camera).x - 150'000.1234) < 1.3e-4);
    CHECK(std::abs(eye_of(camera).z + 149'999.8765) < 1.3e-4);
    CHECK(parse_camera(to_text(camera), Camera{}).value() == camera);
    // A move of 1 mm moves the eye by 1 mm.
    const Camera later = moved(camera, 0.001F, 0.0F, 0.0F);
    CHECK(glm::distance(eye_of(later), eye_of(camera)) == Approx(0.001).margin(1.5e-4));
    const Camera half = between(camera, Camera{}, 0.5);
    CHECK(half.origin == nearest_origin(eye_of(half)));
    CHECK(eye_of(half).x == Approx(75'002.0617));
}

TEST_CASE("heights of a moved ground are those of the terrain") {
    const Terrain terrain = hills(240.0F);
    TerrainLod lod(terrain, 3000.0F);
    lod.set_cover([](double x, double z) { return static_cast<float>(std::sin(x + 2.0 * z)); });
    const auto check_all = [&](const glm::dvec3& origin) {
        for (std::uint32_t level = 0; level < lod.levels(); ++level) {
            const HeightGrid& grid = lod.grid(level);
            CHECK(grid.covers.empty() == (level < TerrainLod::kFirstCoverLevel));
            for (std::size_t i = 0; grid.is_valid && i < grid.heights.size(); i += 41) {
                const auto size = static_cast<double>(TerrainLod::cell(level));
                const double x =
                    origin.x + size * (grid.origin.x + static_cast<double>(i % kHeightTexels));
                const double z =
                    origin.z + size * (grid.origin.y + static_cast<double>(i / kHeightTexels));
                REQUIRE(grid.heights[i] ==
                        terrain.height(static_cast<float>(x), static_cast<float>(z)));
                if (!grid.covers.empty()) {
                    REQUIRE(grid.covers[i] == static_cast<float>(std::sin(x + 2.0 * z)));
                }
            }
        }
    };
    for (const double x : {0.0, 100.0, 2040.0, 2060.0, 6200.0, 147'000.0, 2060.0}) {
        const Camera camera = camera_over(x, 40.0, 0.5 * x);
        lod.set_origin(camera.origin);
        lod.select(make_frustum(camera, 640, 480));
        check_all(camera.origin);
    }
}
