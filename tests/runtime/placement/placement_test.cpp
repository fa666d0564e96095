// SPDX-License-Identifier: MIT
#include "grammar/base/hash.h"
#include "runtime/placement/placement.h"
#include "tests/runtime/placement/placements.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

using namespace lsys;
using namespace lsys::test;

namespace {

Terrain flat_ground() {
    return Terrain::flat({-100.0, -100.0, 200.0, 200.0}, 3.0).value();
}

/// The smallest distance of two trees, and the fraction of probed places without a tree within
/// `spacing`.
struct Distances {
    double min_distance = 1.0e9;
    double empty_fraction = 0.0; // fraction of probes without a tree
};

Distances distances_of(const LargeVector<Tree>& trees, const Region& region, double spacing) {
    Distances distances;
    const auto distance = [](const Tree& a, double x, double z) {
        return std::hypot(static_cast<double>(a.position.x) - x,
                          static_cast<double>(a.position.z) - z);
    };
    for (std::size_t i = 0; i < trees.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            distances.min_distance = std::min(
                distances.min_distance, distance(trees[i], static_cast<double>(trees[j].position.x),
                                                 static_cast<double>(trees[j].position.z)));
        }
    }
    constexpr int kProbes = 30;
    for (int i = 0; i < kProbes * kProbes; ++i) {
        const double x = region.x + region.width * (0.5 + i % kProbes) / kProbes;
        const double z = region.z + region.depth * (0.5 + i / kProbes) / kProbes;
        const bool near = std::any_of(trees.begin(), trees.end(), [&](const Tree& tree) {
            return distance(tree, x, z) < spacing;
        });
        distances.empty_fraction += near ? 0.0 : 1.0 / (kProbes * kProbes);
    }
    return distances;
}

std::string error_of(const PlacementOptions& options) {
    const auto placed = place_trees(options, flat_ground());
    REQUIRE_FALSE(placed);
    return placed.error().message;
}

} // namespace

TEST_CASE(
    "every method gives the same forest for any number of threads, and another for another key") {
    const GreyMap map = sloped_map(16, 16);
    const Terrain ground = flat_ground();
    for (const PlacementMethod method : kAllMethods) {
        CAPTURE(static_cast<int>(method));
        PlacementOptions options = small_forest(method, map, 140.0);
        options.threads = 1;
        const LargeVector<Tree> one = place_trees(options, ground).value().trees;
        REQUIRE(one.size() > 500);
        for (const std::uint32_t threads : {2U, 5U}) {
            options.threads = threads;
            CHECK(same_trees(place_trees(options, ground).value().trees, one));
        }
        options.key += std::uint64_t{1} << 32; // all 64 bits of a key matter
        CHECK_FALSE(same_trees(place_trees(options, ground).value().trees, one));
    }
}

TEST_CASE("forests are the same on every machine and in every version") {
    const GreyMap map = sloped_map(16, 16);
    NoiseOptions noise;
    noise.feature = 30.0;
    const Terrain ground = Terrain::noise({-100.0, -100.0, 200.0, 200.0}, noise).value();
    // FNV-1a of the bytes of all trees, each followed by four zero bytes; results of g++ 12 and
    // clang 14 on x86-64.
    const std::vector<std::uint64_t> expected{
        0x5A58215400336BECU, 0xC692149E8450D500U, 0xE64B21214A83C50AU, 0x40D270F84CC7DA36U,
        0x91CCFC13974ACAE4U, 0x6B80210703125606U, 0x3BF438036224C867U, 0xF0C93E5550AF4479U,
    };
    for (std::size_t i = 0; i < kAllMethods.size(); ++i) {
        CAPTURE(i);
        const PlacementOptions options = small_forest(kAllMethods[i], map, 60.0);
        const LargeVector<Tree> trees = place_trees(options, ground).value().trees;
        std::string bytes;
        for (const Tree& tree : trees) {
            bytes.append(reinterpret_cast<const char*>(&tree), sizeof tree);
            bytes.append(4, '\0');
        }
        CHECK(fnv1a(bytes) == expected[i]);
    }
}

TEST_CASE("trees of every method stand on the ground within the region and have unique numbers") {
    const GreyMap map = sloped_map(16, 16);
    NoiseOptions noise;
    noise.feature = 30.0;
    const Terrain ground = Terrain::noise({-100.0, -100.0, 200.0, 200.0}, noise).value();
    for (const PlacementMethod method : kAllMethods) {
        CAPTURE(static_cast<int>(method));
        const PlacementOptions options = small_forest(method, map, 83.7);
        LargeVector<Tree> trees = place_trees(options, ground).value().trees;
        std::array<int, 2> counts{};
        for (const Tree& tree : trees) {
            REQUIRE(options.region.contains(tree.position.x, tree.position.z));
            REQUIRE(tree.position.y == ground.height(tree.position.x, tree.position.z));
            REQUIRE((tree.yaw >= 0.0F && tree.yaw < 6.2832F));
            REQUIRE(tree.species < 2);
            ++counts[tree.species];
            if (method != PlacementMethod::Domination) {
                REQUIRE(tree.scale >= (tree.species == 1 ? 0.5F : 1.0F));
                REQUIRE(tree.scale <= (tree.species == 1 ? 2.0F : 1.0F));
                REQUIRE(tree.age == 0);
            }
        }
        // One in three is of the second species, within four standard errors.
        const auto total = static_cast<double>(trees.size());
        CHECK(std::abs(counts[1] / total - 1.0 / 3.0) < 4.0 * std::sqrt(2.0 / 9.0 / total));
        sort_by_number(trees);
        CHECK(std::adjacent_find(trees.begin(), trees.end(), [](const Tree& a, const Tree& b) {
                  return a.number == b.number;
              }) == trees.end());
    }
}

TEST_CASE("the key draws the stage at which a tree starts, for every method") {
    const GreyMap map = sloped_map(16, 16);
    const Terrain ground = flat_ground();
    constexpr std::uint32_t kStages = 5;
    constexpr std::array<double, 2> kYears{static_cast<double>(kYearsPerStage), 20.0};
    for (const PlacementMethod method : kAllMethods) {
        CAPTURE(static_cast<int>(method));
        const bool dominates = method == PlacementMethod::Domination;
        PlacementOptions options = small_forest(method, map, 100.0);
        options.years = 0; // no seedlings
        const LargeVector<Tree> without = place_trees(options, ground).value().trees;
        for (PlacementSpecies& species : options.species) {
            species.stages = kStages;
            species.years_of_stage = 20.0F;
        }
        const double years = kYears[dominates ? 1 : 0];
        const auto stage_of = [years](const Tree& tree) {
            return static_cast<std::uint32_t>(tree.age / years);
        };
        const LargeVector<Tree> trees = place_trees(options, ground).value().trees;
        options.threads = 5;
        CHECK(same_trees(place_trees(options, ground).value().trees, trees));
        // Stages change nothing but the ages of the trees.
        REQUIRE(trees.size() == without.size());
        std::array<std::array<double, kStages>, 2> counts{};
        double together = 0.0; // pairs of consecutive trees in one stage
        for (std::size_t i = 0; i < trees.size(); ++i) {
            CHECK(trees[i].position == without[i].position);
            CHECK(trees[i].scale == without[i].scale);
            REQUIRE(stage_of(trees[i]) < kStages);
            counts[trees[i].species][stage_of(trees[i])] += 1.0;
            together += i > 0 && stage_of(trees[i]) == stage_of(trees[i - 1]) ? 1.0 : 0.0;
        }
        for (const std::array<double, kStages>& of_species : counts) {
            double total = 0.0;
            for (const double count : of_species) {
                total += count;
            }
            double square = 0.0;
            for (const double count : of_species) {
                square += (count - total / kStages) * (count - total / kStages) / (total / kStages);
            }
            CHECK(square < 18.47); // chi-squared with 4 degrees of freedom, significance 0.001
        }
        const auto pairs = static_cast<double>(trees.size() - 1);
        CHECK(std::abs(together / pairs - 0.2) < 4.0 * std::sqrt(0.16 / pairs));
        // With StageStart::First, no stage is drawn.
        options.key = 8;
        options.species[0].start = StageStart::First;
        options.species[1].start = StageStart::First;
        const LargeVector<Tree> first = place_trees(options, ground).value().trees;
        for (const Tree& tree : first) {
            REQUIRE(stage_of(tree) == 0);
        }
        if (!dominates) {
            options.stages_passed = 2;
            const LargeVector<Tree> third = place_trees(options, ground).value().trees;
            for (const Tree& tree : third) {
                REQUIRE(stage_of(tree) == 2);
            }
            options.key = 7;
            options.species[0].start = StageStart::Random;
            options.species[1].start = StageStart::Random;
            const LargeVector<Tree> later = place_trees(options, ground).value().trees;
            for (std::size_t i = 0; i < trees.size(); ++i) {
                REQUIRE(stage_of(later[i]) == std::min(stage_of(trees[i]) + 2, kStages - 1));
            }
        }
    }
}

TEST_CASE("plants of year 0 begin at their stage, and seedlings at the first stage") {
    const GreyMap none;
    PlacementOptions options = small_forest(PlacementMethod::Domination, none, 60.0);
    for (PlacementSpecies& species : options.species) {
        species.growth.maturity = 2;
        species.growth.seeds = 2.0F;
    }
    const LargeVector<Tree> plain = place_trees(options, flat_ground()).value().trees;
    for (PlacementSpecies& species : options.species) {
        species.stages = 3;
        species.years_of_stage = 12.5F;
    }
    const LargeVector<Tree> trees = place_trees(options, flat_ground()).value().trees;
    REQUIRE(trees.size() == plain.size());
    std::array<int, 3> ahead{};
    std::size_t seedlings = 0;
    for (std::size_t i = 0; i < trees.size(); ++i) {
        CHECK(trees[i].scale == plain[i].scale);
        const int years = trees[i].age - plain[i].age;
        if (trees[i].number >= options.count) {
            ++seedlings;
            REQUIRE(years == 0);
        } else {
            REQUIRE((years == 0 || years == 13 || years == 25));
            ++ahead[static_cast<std::size_t>(years / 12)];
        }
    }
    CHECK(seedlings > 100);
    CHECK(*std::min_element(ahead.begin(), ahead.end()) > 50);
    options.species[1].years_of_stage = 20'001.0F;
    CHECK(error_of(options).find("the stages of species 1 take 20001 years each") == 0);
    options.species[1].years_of_stage = 0.0F;
    CHECK(error_of(options).find("the stages of species 1 take 0 years each") == 0);
}

TEST_CASE("uniform places have the requested number and are evenly distributed") {
    const GreyMap none;
    PlacementOptions options = small_forest(PlacementMethod::Uniform, none, 100.0);
    options.count = 100'000;
    const LargeVector<Tree> trees = place_trees(options, flat_ground()).value().trees;
    REQUIRE(trees.size() == 100'000);
    std::array<double, 100> counts{};
    for (std::size_t i = 0; i < trees.size(); ++i) {
        REQUIRE(trees[i].number == i);
        const auto column = static_cast<std::size_t>((trees[i].position.x + 50.0F) / 10.0F);
        const auto row = static_cast<std::size_t>((trees[i].position.z + 50.0F) / 10.0F);
        counts[10 * row + column] += 1.0;
    }
    double chi_squared = 0.0;
    for (const double count : counts) {
        chi_squared += (count - 1000.0) * (count - 1000.0) / 1000.0;
    }
    CHECK(chi_squared > 54.0); // 99 degrees of freedom, significance 0.0001 on each side
    CHECK(chi_squared < 161.0);
}

TEST_CASE("uniform cells are a Poisson process: counts of squares vary as much as their mean") {
    const GreyMap none;
    PlacementOptions options = small_forest(PlacementMethod::UniformCells, none, 150.0);
    options.density = 2.0;
    const LargeVector<Tree> trees = place_trees(options, flat_ground()).value().trees;
    for (const int across : {75, 15}) { // squares smaller and larger than the method's cells
        std::vector<double> counts(static_cast<std::size_t>(across * across));
        for (const Tree& tree : trees) {
            const auto column =
                static_cast<int>((tree.position.x + 75.0F) / 150.0F * static_cast<float>(across));
            const auto row =
                static_cast<int>((tree.position.z + 75.0F) / 150.0F * static_cast<float>(across));
            counts[static_cast<std::size_t>(row * across + column)] += 1.0;
        }
        const auto total = static_cast<double>(counts.size());
        const double mean = static_cast<double>(trees.size()) / total;
        double variance = 0.0;
        for (const double count : counts) {
            variance += (count - mean) * (count - mean) / (total - 1.0);
        }
        CHECK(mean == Approx(2.0 * 150.0 * 150.0 / total).epsilon(0.02));
        CHECK(std::abs(variance / mean - 1.0) < 4.0 * std::sqrt(2.0 / total));
    }
}

TEST_CASE("a jittered grid has one tree per square") {
    const GreyMap none;
    PlacementOptions options = small_forest(PlacementMethod::Jittered, none, 60.0);
    options.spacing = 2.0;
    const LargeVector<Tree> trees = place_trees(options, flat_ground()).value().trees;
    REQUIRE(trees.size() == 900);
    std::vector<int> counts(900);
    for (const Tree& tree : trees) {
        const auto column = static_cast<int>(std::floor(tree.position.x / 2.0F)) + 15;
        const auto row = static_cast<int>(std::floor(tree.position.z / 2.0F)) + 15;
        ++counts[static_cast<std::size_t>(30 * row + column)];
    }
    CHECK(std::all_of(counts.begin(), counts.end(), [](int count) { return count == 1; }));
}

TEST_CASE("no two trees of a Poisson disk sample are nearer than its spacing, and there is no room "
          "left") {
    const GreyMap none;
    for (const PlacementMethod method :
         {PlacementMethod::PoissonDisk, PlacementMethod::PoissonCells}) {
        CAPTURE(static_cast<int>(method));
        for (const double spacing : {1.5, 3.7}) {
            PlacementOptions options = small_forest(method, none, 120.0);
            options.spacing = spacing;
            const LargeVector<Tree> trees = place_trees(options, flat_ground()).value().trees;
            const Distances distances = distances_of(trees, options.region, spacing);
            CHECK(distances.min_distance >= spacing);
            CHECK(distances.min_distance < 1.01 * spacing);
            CHECK(distances.empty_fraction < 0.01);
            const double per_square =
                static_cast<double>(trees.size()) * spacing * spacing / options.region.area();
            CHECK(per_square > 0.58);
            CHECK(per_square < 0.70);
        }
    }
}

TEST_CASE("Poisson distances hold far from the origin, where coordinates are coarse") {
    const GreyMap none;
    const Terrain ground = flat_ground();
    for (const PlacementMethod method :
         {PlacementMethod::PoissonDisk, PlacementMethod::PoissonCells}) {
        PlacementOptions options = small_forest(method, none, 60.0);
        options.spacing = 1.25;
        options.region.x = 9'800.0;
        options.region.z = -9'800.0;
        const LargeVector<Tree> trees = place_trees(options, ground).value().trees;
        CHECK(distances_of(trees, options.region, 1.25).min_distance >= 1.25);
    }
}

TEST_CASE("densities of a map are within 2 percent in cells of at least 10,000 expected plants") {
    // A map of 16 cells with greys from 0.25 to 1; a white cell has 50,000 plants. The map
    // with few pixels has pixels larger than the squares of error diffusion, the other map smaller.
    for (const std::uint32_t pixels : {4U, 1200U}) {
        std::vector<std::uint16_t> values;
        for (std::uint32_t row = 0; row < pixels; ++row) {
            for (std::uint32_t column = 0; column < pixels; ++column) {
                const std::uint32_t cell = row * 4 / pixels * 4 + column * 4 / pixels;
                // If a cell has many pixels, they are stripes whose mean is the grey.
                const double grey = 0.25 + 0.75 * cell / 15.0;
                const bool bright = (column & 1U) == 0;
                const double pixel = pixels == 4   ? grey
                                     : grey <= 0.5 ? (bright ? 2.0 * grey : 0.0)
                                                   : (bright ? 1.0 : 2.0 * grey - 1.0);
                values.push_back(static_cast<std::uint16_t>(std::lround(65535.0 * pixel)));
            }
        }
        const GreyMap map = grey_map(pixels, pixels, values);
        for (const PlacementMethod method :
             {PlacementMethod::DensityMap, PlacementMethod::DensityCells}) {
            CAPTURE(pixels, static_cast<int>(method));
            PlacementOptions options = small_forest(method, map, 200.0);
            options.density = 20.0;
            const LargeVector<Tree> trees = place_trees(options, flat_ground()).value().trees;
            std::array<double, 16> counts{};
            for (const Tree& tree : trees) {
                const auto column = static_cast<std::size_t>((tree.position.x + 100.0F) / 50.0F);
                const auto row = static_cast<std::size_t>((tree.position.z + 100.0F) / 50.0F);
                counts[4 * row + column] += 1.0;
            }
            // Error diffusion loses at most the error of the last row.
            if (method == PlacementMethod::DensityMap) {
                CHECK(std::abs(static_cast<double>(trees.size()) - 500'000.0) < 250.0);
            }
            for (std::size_t cell = 0; cell < 16; ++cell) {
                const double expected = 50'000.0 * (0.25 + 0.75 * static_cast<double>(cell) / 15.0);
                CAPTURE(cell, counts[cell], expected);
                CHECK(std::abs(counts[cell] / expected - 1.0) < 0.02);
            }
        }
    }
}

TEST_CASE("nothing grows where a density map is black or ends") {
    GreyMap map = grey_map(2, 1, {0, 65535});
    for (const PlacementMethod method :
         {PlacementMethod::DensityMap, PlacementMethod::DensityCells}) {
        PlacementOptions options = small_forest(method, map, 40.0);
        options.map_region = Region{-10.0, -10.0, 20.0, 20.0};
        const LargeVector<Tree> trees = place_trees(options, flat_ground()).value().trees;
        CHECK(std::abs(static_cast<double>(trees.size()) - 80.0) < 15.0);
        for (const Tree& tree : trees) {
            // A square of error diffusion may cross the border.
            REQUIRE(tree.position.x > -1.6F);
            REQUIRE(tree.position.x < 11.6F);
            REQUIRE(std::abs(tree.position.z) < 11.6F);
        }
        map.values[1] = 0;
        const Placement black = place_trees(options, flat_ground()).value();
        CHECK(black.trees.empty());
        CHECK(black.report.black_map);
        CHECK(placement_note(black.report) ==
              "there are no trees: the density map is black all over the region");
        map.values[1] = 65535;
    }
}

TEST_CASE("species grow only at their altitudes and slopes, and other species take their places") {
    const GreyMap none;
    NoiseOptions noise;
    noise.feature = 40.0;
    noise.height = 30.0;
    const Terrain ground = Terrain::noise({-100.0, -100.0, 200.0, 200.0}, noise).value();
    PlacementOptions options = small_forest(PlacementMethod::Uniform, none, 200.0);
    options.species[0].highest = 14.0F;
    options.species[1].lowest = 12.0F;
    options.species[1].steepest = 0.4F;
    const Placement placement = place_trees(options, ground).value();
    std::array<int, 2> counts{};
    for (const Tree& tree : placement.trees) {
        ++counts[tree.species];
        if (tree.species == 0) {
            REQUIRE(tree.position.y <= 14.0F);
        } else {
            REQUIRE(tree.position.y >= 12.0F);
            REQUIRE(ground.slope(tree.position.x, tree.position.z) <= 0.4F);
        }
    }
    CHECK(counts[0] > 1'000);
    CHECK(counts[1] > 1'000);
    CHECK(placement.report.places == options.count);
    CHECK(placement.report.refused > 0);
    CHECK(placement.trees.size() + placement.report.refused == options.count);
    CHECK_THAT(placement_note(placement.report),
               Catch::Matchers::EndsWith("of 12000 places have no tree: no species can live there, "
                                         "by its limits of altitude and slope"));
    // Numbers of trees do not depend on the limits of species.
    options.species = {{}};
    const LargeVector<Tree> all = place_trees(options, ground).value().trees;
    for (const Tree& tree : placement.trees) {
        REQUIRE(all[tree.number].position == tree.position);
        REQUIRE(all[tree.number].yaw == tree.yaw);
    }
    options.species[0].lowest = 1000.0F;
    const Placement nobody = place_trees(options, ground).value();
    CHECK(nobody.trees.empty());
    CHECK(placement_note(nobody.report) == "there are no trees: the altitude and slope limits of "
                                           "all species exclude all 12000 places");
}

TEST_CASE("a species with a share of 0 is not chosen where others can live") {
    const GreyMap none;
    PlacementOptions options = small_forest(PlacementMethod::Uniform, none, 100.0);
    options.species[0].share = 0.0;
    options.species.push_back(options.species[0]);
    const LargeVector<Tree> trees = place_trees(options, flat_ground()).value().trees;
    for (const Tree& tree : trees) {
        REQUIRE(tree.species == 1);
    }
}

TEST_CASE("too many trees are refused before memory is allocated") {
    const GreyMap map = grey_map(2, 2, {65535, 65535, 65535, 65535});
    PlacementOptions options = small_forest(PlacementMethod::Uniform, map, 100'000.0);
    options.count = 1'000'000'000;
    CHECK(error_of(options) == "about 1000000000 trees; one placement has at most 10000000");
    options.method = PlacementMethod::Domination;
    CHECK(error_of(options) == "about 1000000000 trees; one placement has at most 10000000");
    options.spacing = 3.0;
    options.density = 0.05;
    for (const PlacementMethod method :
         {PlacementMethod::Jittered, PlacementMethod::UniformCells, PlacementMethod::PoissonCells,
          PlacementMethod::PoissonDisk, PlacementMethod::DensityMap,
          PlacementMethod::DensityCells}) {
        options.method = method;
        CHECK_THAT(error_of(options),
                   Catch::Matchers::EndsWith("one placement has at most 10000000"));
    }
    options.density = 1.0;
    CHECK(error_of(options) == "a white density map would have 10000000000 trees; the maximum "
                               "for a density map is 1000000000");
}

TEST_CASE("the message about an invalid option names it") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const GreyMap map = grey_map(1, 1, {30000});
    const auto with = [&](PlacementMethod method, const auto& change) {
        PlacementOptions options = small_forest(method, map, 50.0);
        change(options);
        return error_of(options);
    };
    using Options = PlacementOptions;
    CHECK(with(PlacementMethod::Uniform, [](Options& o) { o.region.width = 0.0; }) ==
          "a ground of 0 by 50 m; both sides must be above 0");
    CHECK(with(PlacementMethod::Uniform, [](Options& o) { o.region.width = 0.1; }) ==
          "a region of 0.1 by 50 m is too small for trees; each side must be at least 0.25 m");
    CHECK(with(PlacementMethod::Uniform, [](Options& o) { o.species.clear(); }) ==
          "a placement of 0 species; it takes 1 to 65,536");
    CHECK(with(PlacementMethod::Uniform, [&](Options& o) { o.species[1].share = nan; }) ==
          "the share of species 1 is nan; it must be 0 or more");
    CHECK(with(PlacementMethod::Uniform, [](Options& o) {
              o.species[0].share = 0.0;
              o.species[1].share = 0.0;
          }) == "the shares of all species are 0");
    CHECK(with(PlacementMethod::Uniform, [](Options& o) { o.species[1].min_scale = 3.0F; }) ==
          "the scales of species 1 are from 3 to 2; they must be above 0 and in order");
    CHECK(with(PlacementMethod::Uniform, [](Options& o) {
              o.species[0].lowest = 5.0F;
              o.species[0].highest = 4.0F;
          }) == "species 0 has no valid range: altitude 5 to 4 m, slope up to inf");
    CHECK(with(PlacementMethod::PoissonDisk, [](Options& o) { o.spacing = 0.0; }) ==
          "the spacing of the placement is 0; it must be from 0.001 to 1000000");
    CHECK(with(PlacementMethod::PoissonCells, [&](Options& o) { o.spacing = nan; }) ==
          "the spacing of the placement is nan; it must be from 0.001 to 1000000");
    CHECK(with(PlacementMethod::UniformCells, [](Options& o) { o.density = -1.0; }) ==
          "the density of the placement is -1; it must be from 1e-12 to 1000000");
    CHECK(with(PlacementMethod::DensityMap, [](Options& o) { o.density_map = nullptr; }) ==
          "the placement needs a density map, and there is none");
    CHECK(with(PlacementMethod::DensityCells, [](Options& o) { o.map_region->depth = -1.0; }) ==
          "a ground of 50 by -1 m; both sides must be above 0");
    CHECK(with(PlacementMethod::Domination, [](Options& o) { o.years = 20'000; }) ==
          "20000 years; a forest grows for at most 10000");
    CHECK(with(PlacementMethod::Domination, [](Options& o) { o.species[1].growth.rate = 9.0F; }) ==
          "the growth rate of species 1 is 9; it must be from 0.0001 to 6");
}

TEST_CASE("forests of no trees and of one tree") {
    const GreyMap none;
    PlacementOptions options = small_forest(PlacementMethod::Uniform, none, 50.0);
    options.count = 0;
    const Placement empty = place_trees(options, flat_ground()).value();
    CHECK(empty.trees.empty());
    CHECK(placement_note(empty.report) ==
          "there are no trees: the method makes no place in the region");
    options.count = 1;
    const Placement one = place_trees(options, flat_ground()).value();
    CHECK(one.trees.size() == 1);
    CHECK(placement_note(one.report).empty());
    options.method = PlacementMethod::PoissonDisk;
    options.spacing = 1'000.0;
    CHECK(place_trees(options, flat_ground()).value().trees.size() == 1);
}
