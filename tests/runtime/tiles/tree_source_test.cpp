// SPDX-License-Identifier: MIT
// Compares trees of tiles and expected numbers of trees with placements of a whole region.
#include "runtime/forest/surroundings.h"
#include "runtime/placement/density_field.h"
#include "runtime/tiles/impl/canopy_field.h"
#include "runtime/tiles/impl/tree_source.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <utility>

namespace lsys {
namespace {

GreyMap slope_map() {
    GreyMap map;
    map.columns = 16;
    map.rows = 16;
    for (std::uint32_t i = 0; i < 256; ++i) {
        map.values.push_back(static_cast<std::uint16_t>(i % 16 * 4000));
    }
    return map;
}

Terrain hills(const Region& region) {
    NoiseOptions noise;
    noise.feature = 60.0;
    noise.height = 40.0;
    return std::move(Terrain::noise(region, noise).value());
}

/// Two species, one of which cannot live high up or on slopes.
PlacementOptions options_of(PlacementMethod method, const Region& region, const GreyMap& map) {
    PlacementOptions options;
    options.key = 5;
    options.method = method;
    options.region = region;
    options.species.resize(2);
    options.species[0].share = 3.0;
    options.species[0].highest = 20.0F;
    options.species[0].steepest = 0.9F;
    options.species[1].min_scale = 0.5F;
    options.species[1].lowest = 8.0F;
    options.spacing = 4.0;
    options.density = 0.06;
    options.density_map = &map;
    options.map_region = region;
    return options;
}

constexpr std::array kMethods{PlacementMethod::Jittered, PlacementMethod::UniformCells,
                              PlacementMethod::PoissonCells, PlacementMethod::DensityCells};

bool same(const Tree& a, const Tree& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}

TEST_CASE("the tiles of a level together hold each tree of the region once") {
    const Region region{-70.3, 12.7, 333.3, 201.9};
    const GreyMap map = slope_map();
    const Terrain terrain = hills(region);
    const TileGrid grid(region);
    for (const PlacementMethod method : kMethods) {
        CAPTURE(static_cast<int>(method));
        const PlacementOptions options = options_of(method, region, map);
        REQUIRE(CellTrees::check(options, terrain));
        LargeVector<Tree> all = place_trees(options, terrain).value().trees;
        REQUIRE(all.size() > 1000);
        std::map<std::uint32_t, Tree> by_number;
        for (const Tree& tree : all) {
            by_number[tree.number] = tree;
        }
        const std::vector<double> none(2, 0.0);
        Forest kinds;
        kinds.species.resize(2);
        const TreeSizer keeps_scales(none, kinds);
        const CellTrees cells(options, terrain, keeps_scales, kinds, grid);
        sort_by_tile(grid, all);
        const PlacedTrees placed(all, grid);
        for (const std::uint32_t level : {0U, 2U, 5U}) {
            std::size_t count = 0;
            for (std::uint32_t i = 0; i < 1U << (2 * level); ++i) {
                const TileId tile{level, i % (1U << level), i >> level};
                if (!grid.has_ground(tile)) {
                    continue;
                }
                const std::vector<Tree> trees = cells.trees_of(tile);
                const std::vector<Tree> again = placed.trees_of(tile);
                REQUIRE(trees.size() == again.size());
                for (std::size_t k = 0; k < trees.size(); ++k) {
                    REQUIRE(same(trees[k], again[k]));
                    REQUIRE(same(trees[k], by_number.at(trees[k].number)));
                }
                count += trees.size();
            }
            CHECK(count == all.size());
        }
    }
}

TEST_CASE("the tiles of a forest that senses its surroundings are those of the whole forest") {
    const Region region{-70.3, 12.7, 333.3, 201.9};
    const GreyMap map = slope_map();
    const Terrain terrain = hills(region);
    const TileGrid grid(region);
    Forest kinds;
    kinds.key = 5;
    kinds.species.resize(2);
    kinds.species[0].senses_surroundings = true;
    kinds.species[0].stages.resize(kSurroundings);
    for (ForestStage& stage : kinds.species[0].stages) {
        stage.crown_radius = 2.0;
        stage.plant_height = 10.0;
    }
    kinds.species[1].stages.resize(1);
    kinds.species[1].stages[0].plant_height = 5.0; // takes quarters of small trees only
    const TreeSizer keeps_scales(std::vector<double>(2, 0.0), kinds);
    for (const PlacementMethod method : kMethods) {
        CAPTURE(static_cast<int>(method));
        PlacementOptions options = options_of(method, region, map);
        options.species[0].max_scale = 1.5F;
        LargeVector<Tree> all = place_trees(options, terrain).value().trees;
        sense_surroundings(kinds, all, all, 2);
        std::array<int, kSurroundings> cases{};
        for (const Tree& tree : all) {
            cases[tree.species == 0 ? surroundings_of(tree) : 0] += 1;
        }
        CHECK(*std::min_element(cases.begin(), cases.end()) > 0);
        sort_by_tile(grid, all);
        const PlacedTrees placed(all, grid);
        const CellTrees cells(options, terrain, keeps_scales, kinds, grid);
        for (const std::uint32_t level : {0U, 3U, 6U}) {
            for (std::uint32_t i = 0; i < 1U << (2 * level); ++i) {
                const TileId tile{level, i % (1U << level), i >> level};
                if (!grid.has_ground(tile)) {
                    continue;
                }
                const std::vector<Tree> trees = cells.trees_of(tile);
                const std::vector<Tree> again = placed.trees_of(tile);
                REQUIRE(trees.size() == again.size());
                for (std::size_t k = 0; k < trees.size(); ++k) {
                    REQUIRE(same(trees[k], again[k]));
                }
            }
        }
    }
}

TEST_CASE("a placement whose cells have no numbers is refused before a tile is made") {
    const Region region{0.0, 0.0, 900'000.0, 900'000.0};
    const GreyMap map = slope_map();
    PlacementOptions options = options_of(PlacementMethod::Jittered, region, map);
    const Terrain level = Terrain::flat(region).value();
    CHECK_FALSE(CellTrees::check(options, level)); // cells of 4 m have numbers only up to 131 km
    options.spacing = 30.0;
    CHECK(CellTrees::check(options, level));
    options.spacing = -1.0;
    CHECK_FALSE(CellTrees::check(options, level));
}

TEST_CASE("expected numbers of trees are those of placements within 3 %") {
    const Region region{-300.0, 100.0, 800.0, 800.0};
    const GreyMap map = slope_map();
    const Terrain terrain = hills(region);
    for (const PlacementMethod method : kMethods) {
        CAPTURE(static_cast<int>(method));
        const PlacementOptions options = options_of(method, region, map);
        const DensityField field(options, terrain);
        std::array<double, 2> expected{};
        double places = 0.0;
        constexpr int kSide = 200;
        for (int i = 0; i < kSide * kSide; ++i) {
            const double x = region.x + region.width * (i % kSide + 0.5) / kSide;
            const double z = region.z + region.depth * (i / kSide + 0.5) / kSide;
            std::array<double, 2> densities{};
            field.trees_at(x, z, densities);
            places += field.places_at(x, z) * region.area() / (kSide * kSide);
            for (std::size_t s = 0; s < 2; ++s) {
                expected[s] += densities[s] * region.area() / (kSide * kSide);
            }
        }
        const Placement placed = std::move(place_trees(options, terrain).value());
        std::array<double, 2> counted{};
        for (const Tree& tree : placed.trees) {
            counted[tree.species] += 1.0;
        }
        CHECK(places == Approx(static_cast<double>(placed.report.places)).epsilon(0.01));
        CHECK(expected[0] == Approx(counted[0]).epsilon(0.03));
        CHECK(expected[1] == Approx(counted[1]).epsilon(0.03));
    }
}

TEST_CASE("a tree of the field looks like the placed tree with its number") {
    const Region region{0.0, 0.0, 100.0, 100.0};
    const GreyMap map = slope_map();
    const Terrain terrain = hills(region);
    const PlacementOptions options = options_of(PlacementMethod::Jittered, region, map);
    const DensityField field(options, terrain);
    const Placement placed = std::move(place_trees(options, terrain).value());
    REQUIRE(placed.trees.size() > 100);
    for (const Tree& tree : placed.trees) {
        Tree expected = field.tree_of(tree.number, tree.species);
        expected.position = tree.position;
        REQUIRE(same(expected, tree));
    }
}

TEST_CASE("a canopy of expected trees is that of counted trees within 3 %") {
    const Region region{0.0, 0.0, 640.0, 640.0};
    const GreyMap map = slope_map();
    const Terrain terrain = hills(region);
    const TileGrid grid(region);
    const std::array crowns{Crown{12.0, 9.0, {0.1, 0.3, 0.05}}, Crown{5.0, 4.0, {0.2, 0.2, 0.1}}};
    for (const PlacementMethod method : kMethods) {
        CAPTURE(static_cast<int>(method));
        PlacementOptions options = options_of(method, region, map);
        options.species[1].min_scale = 1.0F;
        const DensityField field(options, terrain);
        const CanopyField canopy(field, {sums_of(crowns[0], 1.0), sums_of(crowns[1], 1.0)}, grid);
        Canopy counted(kCanopyCells, grid.side(0) / kCanopyCells);
        const Placement placed = std::move(place_trees(options, terrain).value());
        for (const Tree& tree : placed.trees) {
            const TileId cell = grid.tile_at(kCanopyLevels, tree.position.x, tree.position.z);
            counted.add(cell.column, cell.row, crowns[tree.species], 1.0);
        }
        CanopyPoint sum;
        CanopyPoint counted_sum;
        const auto add = [](CanopyPoint& to, const CanopyPoint& point) {
            to.cover += point.cover;
            to.height += point.height;
            to.colour += point.cover * point.colour;
        };
        for (std::int64_t row = 1; row < kCanopyCells; ++row) {
            for (std::int64_t column = 1; column < kCanopyCells; ++column) {
                add(sum, canopy.at_corner(0, column, row));
                add(counted_sum, counted.at_corner(column, row));
            }
        }
        CHECK(sum.cover == Approx(counted_sum.cover).epsilon(0.03));
        CHECK(sum.height == Approx(counted_sum.height).epsilon(0.03));
        CHECK(sum.colour.y == Approx(counted_sum.colour.y).epsilon(0.03));
    }
}

} // namespace
} // namespace lsys
