// SPDX-License-Identifier: MIT
#include "runtime/placement/placement.h"
#include "tests/runtime/placement/placements.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdint>
#include <string>

using namespace lsys;
using namespace lsys::test;

namespace {

LargeVector<Tree> trees_of(const PlacementOptions& options, const Terrain& ground) {
    LargeVector<Tree> trees = place_trees(options, ground).value().trees;
    sort_by_number(trees);
    return trees;
}

} // namespace

TEST_CASE("4 by 4 tiles have exactly the trees of the whole") {
    const GreyMap map = sloped_map(9, 9);
    NoiseOptions noise;
    noise.feature = 40.0;
    const Terrain ground = Terrain::noise({0.0, 0.0, 100.0, 100.0}, noise).value();
    for (const PlacementMethod method : kTileableMethods) {
        REQUIRE(is_tileable(method));
        // Sizes that are no multiple of a cell, and coordinates of both signs.
        for (const double side : {60.0, 97.3}) {
            CAPTURE(static_cast<int>(method), side);
            PlacementOptions options = small_forest(method, map, side);
            options.species[0].highest = 27.0F;
            options.region.x -= 3.3;
            const LargeVector<Tree> whole = trees_of(options, ground);
            REQUIRE(whole.size() > 150);
            PlacementOptions tile = options;
            tile.threads = 1;
            tile.region.width = side / 4.0;
            tile.region.depth = side / 4.0;
            LargeVector<Tree> together;
            for (int i = 0; i < 16; ++i) {
                tile.region.x = options.region.x + i % 4 * (side / 4.0);
                tile.region.z = options.region.z + i / 4 * (side / 4.0);
                const LargeVector<Tree> part = place_trees(tile, ground).value().trees;
                together.insert(together.end(), part.begin(), part.end());
            }
            sort_by_number(together);
            CHECK(same_trees(together, whole));
        }
    }
    CHECK_FALSE(is_tileable(PlacementMethod::Uniform));
    CHECK_FALSE(is_tileable(PlacementMethod::PoissonDisk));
    CHECK_FALSE(is_tileable(PlacementMethod::DensityMap));
    CHECK_FALSE(is_tileable(PlacementMethod::Domination));
}

TEST_CASE("a tile has the trees of the whole also among many blocks of a Poisson sample") {
    const GreyMap none;
    const Terrain ground = Terrain::flat({0.0, 0.0, 1.0, 1.0}).value();
    PlacementOptions options = small_forest(PlacementMethod::PoissonCells, none, 300.0);
    options.spacing = 1.0; // small enough for several blocks in each direction
    const LargeVector<Tree> whole = trees_of(options, ground);
    PlacementOptions tile = options;
    tile.region = {-20.7, 31.1, 33.3, 12.9};
    LargeVector<Tree> expected;
    std::copy_if(whole.begin(), whole.end(), std::back_inserter(expected), [&](const Tree& tree) {
        return tile.region.contains(tree.position.x, tree.position.z);
    });
    REQUIRE(expected.size() > 200);
    CHECK(same_trees(trees_of(tile, ground), expected));
}

TEST_CASE("tiles far from the origin work up to the range of numbers and are refused beyond") {
    const GreyMap map = grey_map(1, 1, {40000});
    const Terrain ground = Terrain::flat({0.0, 0.0, 1.0, 1.0}).value();
    for (const PlacementMethod method : kTileableMethods) {
        CAPTURE(static_cast<int>(method));
        PlacementOptions options = small_forest(method, map, 40.0);
        options.density = 1.0;
        options.spacing = 1.0;
        options.region.x = 8'000.0;
        options.region.z = -8'000.0;
        options.map_region = Region{-1.0e5, -1.0e5, 2.0e5, 2.0e5};
        const LargeVector<Tree> whole = trees_of(options, ground);
        REQUIRE(whole.size() > 500);
        PlacementOptions half = options;
        half.region.width = 20.0;
        LargeVector<Tree> together = trees_of(half, ground);
        half.region.x += 20.0;
        const LargeVector<Tree> right = trees_of(half, ground);
        together.insert(together.end(), right.begin(), right.end());
        sort_by_number(together);
        CHECK(same_trees(together, whole));

        options.region.x = 200'000.0;
        const auto refused = place_trees(options, ground);
        REQUIRE_FALSE(refused);
        CHECK_THAT(refused.error().message,
                   Catch::Matchers::StartsWith(
                       "the region from (200000, -8000) to (200040, -7960) m has trees whose "
                       "numbers do not fit into 32 bits; with cells of "));
    }
}
