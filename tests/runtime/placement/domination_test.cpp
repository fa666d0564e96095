// SPDX-License-Identifier: MIT
#include "runtime/placement/domination.h"
#include "tests/runtime/placement/placements.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

using namespace lsys;
using namespace lsys::test;

namespace {

const Terrain& ground() {
    static const Terrain terrain = Terrain::flat({0.0, 0.0, 1.0, 1.0}).value();
    return terrain;
}

PlacementOptions stand(std::uint64_t count, double side) {
    PlacementOptions options;
    options.key = 1;
    options.method = PlacementMethod::Domination;
    options.region = {0.0, 0.0, side, side};
    options.species.resize(1);
    options.count = count;
    options.threads = 2;
    return options;
}

Domination grown(const PlacementOptions& options, std::uint32_t years) {
    Domination forest = Domination::begin(options, ground()).value();
    while (forest.year() < years) {
        REQUIRE(forest.step());
    }
    return forest;
}

bool circles_overlap(const ForestPlant& a, const ForestPlant& b) {
    const double reach = static_cast<double>(a.radius) + static_cast<double>(b.radius);
    return std::hypot(static_cast<double>(a.place.x - b.place.x),
                      static_cast<double>(a.place.y - b.place.y)) < reach;
}

/// Slope of log(mean mass) against log(density) while a stand thins from half of its initial plants
/// to 300 plants. Mass is the cube of the radius.
double thinning_slope(const PlacementOptions& options) {
    Domination forest = Domination::begin(options, ground()).value();
    double n = 0.0;
    double sum_x = 0.0;
    double sum_y = 0.0;
    double sum_xx = 0.0;
    double sum_xy = 0.0;
    while (forest.plants().size() >= 300 && forest.year() < 400) {
        const auto count = static_cast<double>(forest.plants().size());
        if (count <= 0.5 * static_cast<double>(options.count)) {
            double mass = 0.0;
            for (const ForestPlant& plant : forest.plants()) {
                mass += std::pow(static_cast<double>(plant.radius), 3.0);
            }
            const double x = std::log(count / options.region.area());
            const double y = std::log(mass / count);
            n += 1.0;
            sum_x += x;
            sum_y += y;
            sum_xx += x * x;
            sum_xy += x * y;
        }
        REQUIRE(forest.step());
    }
    REQUIRE(n > 20.0);
    return (n * sum_xy - sum_x * sum_y) / (n * sum_xx - sum_x * sum_x);
}

} // namespace

TEST_CASE("a stand of one age thins itself with a slope of -1.5") {
    for (const std::uint64_t key : {1U, 2U, 3U}) {
        for (const float max_radius : {6.0F, 25.0F}) {
            for (const float tolerance : {0.1F, 0.5F}) {
                CAPTURE(key, max_radius, tolerance);
                PlacementOptions options = stand(40'000, 200.0);
                options.key = key;
                options.species[0].growth.seeds = 0.0F;
                options.species[0].growth.max_radius = max_radius;
                options.species[0].growth.tolerance = tolerance;
                CHECK(std::abs(thinning_slope(options) + 1.5) < 0.15);
            }
        }
    }
}

TEST_CASE("in every year, plants whose circle overlaps that of a stronger plant are dominated") {
    PlacementOptions options = stand(2'500, 40.0);
    options.species.resize(2);
    options.species[1].growth.rate = 0.3F;
    options.species[1].growth.tolerance = 0.9F;
    options.species[0].growth.maturity = 3;
    options.species[0].growth.seeds = 3.0F;
    Domination forest = Domination::begin(options, ground()).value();
    for (int year = 0; year < 40; ++year) {
        const LargeVector<ForestPlant>& plants = forest.plants();
        REQUIRE(plants.size() > 20);
        for (std::size_t i = 0; i < plants.size(); ++i) {
            bool dominated = false;
            for (std::size_t j = 0; j < plants.size() && !dominated; ++j) {
                const float strength = plants[i].radius * plants[i].vigour;
                const float other_strength = plants[j].radius * plants[j].vigour;
                const bool stronger =
                    other_strength > strength || (other_strength == strength && j < i);
                dominated = j != i && stronger && circles_overlap(plants[i], plants[j]);
            }
            // A plant may still be marked as dominated if the dominating plant died in the year
            // that has just passed.
            REQUIRE((plants[i].dominated == dominated || (year > 0 && !dominated)));
        }
        REQUIRE(forest.step());
    }
    // No two circles of living dominant plants overlap.
    for (std::size_t i = 0; i < forest.plants().size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const ForestPlant& a = forest.plants()[i];
            const ForestPlant& b = forest.plants()[j];
            REQUIRE((a.dominated || b.dominated || !circles_overlap(a, b)));
        }
    }
}

TEST_CASE("circles of very different sizes find each other") {
    PlacementOptions options = stand(3'000, 50.0);
    options.species.resize(2);
    options.species[0].growth.rate = 0.01F;
    options.species[0].growth.tolerance = 1.0F; // shade does not kill it
    options.species[1].share = 0.005;
    options.species[1].growth.rate = 3.0F;
    options.species[1].growth.max_radius = 9.0F;
    const Domination forest = grown(options, 6);
    std::size_t small_dominated = 0;
    std::size_t small_under = 0;
    for (const ForestPlant& plant : forest.plants()) {
        if (plant.species == 0) {
            small_dominated += plant.dominated ? 1U : 0U;
            small_under +=
                std::any_of(forest.plants().begin(), forest.plants().end(),
                            [&](const ForestPlant& other) {
                                return other.species == 1 && circles_overlap(plant, other);
                            })
                    ? 1U
                    : 0U;
        }
    }
    CHECK(small_under > 500);
    CHECK(small_dominated >= small_under);
}

TEST_CASE("each year, plants keep number, place and species, get a year older and do not shrink") {
    PlacementOptions options = stand(2'000, 60.0);
    options.species[0].growth.maturity = 5;
    Domination forest = Domination::begin(options, ground()).value();
    std::map<std::uint32_t, ForestPlant> last;
    std::uint32_t next_number = 2'000;
    for (int year = 0; year < 30; ++year) {
        std::uint32_t newest = next_number;
        for (const ForestPlant& plant : forest.plants()) {
            const auto before = last.find(plant.number);
            if (before == last.end()) {
                REQUIRE(plant.age == 1);
                REQUIRE((year == 0 || plant.number >= next_number));
                newest = std::max(newest, plant.number + 1);
                continue;
            }
            REQUIRE(plant.place == before->second.place);
            REQUIRE(plant.species == before->second.species);
            REQUIRE(plant.vigour == before->second.vigour);
            REQUIRE(plant.age == before->second.age + 1);
            REQUIRE(plant.radius > before->second.radius);
        }
        REQUIRE(std::is_sorted(
            forest.plants().begin(), forest.plants().end(),
            [](const ForestPlant& a, const ForestPlant& b) { return a.number < b.number; }));
        last.clear();
        for (const ForestPlant& plant : forest.plants()) {
            last[plant.number] = plant;
        }
        next_number = newest;
        REQUIRE(forest.step());
    }
    CHECK(next_number > 2'000); // seedlings have sprouted
}

TEST_CASE("trees of a year have the age and size of their plants and look the same every year") {
    PlacementOptions options = stand(2'000, 60.0);
    options.species[0].min_scale = 0.8F;
    options.species[0].max_scale = 1.2F;
    Domination forest = grown(options, 10);
    const LargeVector<Tree> young = forest.trees();
    for (int year = 0; year < 10; ++year) {
        REQUIRE(forest.step());
    }
    const LargeVector<Tree> old = forest.trees();
    REQUIRE(old.size() == forest.plants().size());
    std::map<std::uint32_t, Tree> by_number;
    for (const Tree& tree : young) {
        by_number[tree.number] = tree;
    }
    int followed = 0;
    for (std::size_t i = 0; i < old.size(); ++i) {
        const ForestPlant& plant = forest.plants()[i];
        REQUIRE(old[i].number == plant.number);
        REQUIRE(old[i].age == plant.age);
        REQUIRE(old[i].position == glm::vec3(plant.place.x, 0.0F, plant.place.y));
        REQUIRE(old[i].scale > 0.0F);
        REQUIRE(old[i].scale <= 1.2F);
        const auto before = by_number.find(plant.number);
        if (before != by_number.end()) {
            ++followed;
            REQUIRE(before->second.yaw == old[i].yaw);
            REQUIRE(before->second.position == old[i].position);
            REQUIRE(before->second.age + 10 == old[i].age);
        }
    }
    CHECK(followed > 100);
    // The size of a plant that was never dominated depends on its vigour alone.
    const Domination alone = grown(stand(1, 60.0), 25);
    REQUIRE(alone.plants().size() >= 1);
    CHECK(alone.trees()[0].scale < 1.0F);
    CHECK(alone.trees()[0].scale >= 0.7F);
    // place_trees() gives the same trees.
    options.years = 20;
    CHECK(same_trees(place_trees(options, ground()).value().trees, old));
}

TEST_CASE("species that do not tolerate shade die of it sooner") {
    const auto survivors = [](float tolerance) {
        PlacementOptions options = stand(10'000, 100.0);
        options.species[0].growth.seeds = 0.0F;
        options.species[0].growth.tolerance = tolerance;
        return grown(options, 10).plants().size();
    };
    const std::size_t none = survivors(0.0F);
    const std::size_t some = survivors(0.6F);
    const std::size_t all = survivors(1.0F);
    CHECK(some > none + none / 5);
    CHECK(all == 10'000);
}

TEST_CASE("plants die of age, and seeds keep a forest alive") {
    PlacementOptions options = stand(500, 60.0);
    SpeciesGrowth& growth = options.species[0].growth;
    growth.lifespan = 50;
    growth.maturity = 10;
    growth.seeds = 0.0F;
    const Domination before = grown(options, 38); // plants are 39 years old
    CHECK(before.plants().size() > 20);
    CHECK(grown(options, 60).plants().empty());
    growth.seeds = 2.0F;
    growth.seed_distance = 15.0F;
    const Domination after = grown(options, 150);
    CHECK(after.plants().size() > 100);
    for (const ForestPlant& plant : after.plants()) {
        REQUIRE(plant.age <= 60);
        REQUIRE(options.region.contains(plant.place.x, plant.place.y));
    }
}

TEST_CASE("seeds fall within their distance and only where the species can live") {
    // A slope that rises to the east from 0 to 100 m over 100 m.
    const Terrain slope =
        Terrain::height_map({0.0, 0.0, 100.0, 100.0}, grey_map(2, 2, {0, 65535, 0, 65535}),
                            {0.0, 100.0, HeightFilter::Bilinear})
            .value();
    PlacementOptions options = stand(1, 100.0);
    options.species[0].highest = 60.0F;
    options.species[0].growth.maturity = 2;
    options.species[0].growth.seeds = 40.0F;
    options.species[0].growth.seed_distance = 30.0F;
    std::size_t seedlings = 0;
    for (std::uint64_t key = 0; key < 20; ++key) {
        options.key = key;
        Domination forest = Domination::begin(options, slope).value();
        if (forest.plants().empty()) { // the only plant sprouted above its limit of altitude
            CHECK(forest.report().refused == 1);
            continue;
        }
        for (int year = 0; year < 3; ++year) {
            REQUIRE(forest.step());
        }
        const glm::vec2 parent = forest.plants()[0].place;
        for (const ForestPlant& plant : forest.plants()) {
            REQUIRE(plant.place.x <= 60.01F);
            if (plant.age <= 2 && forest.year() == 3) { // seedlings of the first plant only
                REQUIRE(std::hypot(plant.place.x - parent.x, plant.place.y - parent.y) <= 30.01F);
                ++seedlings;
            }
        }
    }
    CHECK(seedlings > 200);
}

TEST_CASE("a forest that would get too large stops unchanged") {
    PlacementOptions options = stand(60'000, 1'000.0);
    options.species[0].growth.maturity = 1;
    options.species[0].growth.seeds = 200.0F;
    Domination forest = Domination::begin(options, ground()).value();
    const auto step = forest.step();
    REQUIRE_FALSE(step);
    CHECK_THAT(step.error().message,
               Catch::Matchers::StartsWith("in year 1 there are 60000 plants and "));
    CHECK(forest.year() == 0);
    CHECK(forest.plants().size() == 60'000);
    options.years = 2;
    CHECK_FALSE(place_trees(options, ground()));
}

TEST_CASE("plants without neighbours have the size of their age up to the end of their life") {
    PlacementOptions options = stand(200, 20'000.0);
    SpeciesGrowth& growth = options.species[0].growth;
    growth.lifespan = 250;
    growth.seeds = 0.0F;
    growth.vigour_spread = 0.0F;
    growth.max_radius = 100.0F; // still growing at the end
    std::map<std::uint32_t, float> scales;
    for (const Tree& tree : grown(options, 0).trees()) {
        scales[tree.number] = tree.scale;
    }
    const LargeVector<Tree> trees = grown(options, 297).trees();
    REQUIRE(trees.size() > 1); // life ends after 200 to 300 years
    for (const Tree& tree : trees) {
        CHECK(tree.scale == scales.at(tree.number));
    }
}
