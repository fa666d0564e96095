// SPDX-License-Identifier: MIT
// Growth of forests, with moments between two years.
#include "runtime/pipeline/forest_growth.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <string>
#include <utility>

using namespace lsys;

namespace {

Project wood_project(const std::string& scene) {
    const std::map<std::string, std::string> files = {
        {"wood.toml", scene},
        {"bush.lsys", "#n = 3; #w : A; #p : A : * : F [ + A ] F A;"},
        {"shy.lsys", "#n = 3; #sense light shadow; #w : ?light(1,0,0,0);"
                     "#p : ?light(q,x,y,z) : q > 0.5 : F [ +(60) F ] ?light(0,0,0,0);"}};
    Project project;
    project.threads = 2;
    project.host.read_file = [files](const std::string& path,
                                     const ReadLimit& /*limit*/) -> Result<std::string> {
        const auto at = files.find(path);
        return at != files.end() ? Result<std::string>(at->second)
                                 : Error{"no such file or directory"};
    };
    project.host.read_referenced_file = project.host.read_file;
    project.host.file_exists = [files](const std::string& path) { return files.contains(path); };
    return project;
}

const char* const kWood =
    "key = 3\n[terrain]\nsize = 40\n[placement]\nmethod = \"domination\"\ncount = 300\n"
    "years = 30\n[[species]]\nname = \"bush\"\ngrammar = \"bush.lsys\"\nstages = [1, 2, 3]\n"
    "years_of_stage = 10\n[species.growth]\nmaturity = 5\nseeds = 0.5\nseed_distance = 9\n";

/// Plants that sense their surroundings, with one painted and one erased.
const char* const kShyWood =
    "key = 3\n[terrain]\nsize = 40\n[placement]\nmethod = \"domination\"\ncount = 300\n"
    "years = 30\n[[species]]\nname = \"shy\"\ngrammar = \"shy.lsys\"\nstages = [1, 2, 3]\n"
    "surroundings = \"sensed\"\nyears_of_stage = 10\n[species.growth]\nmaturity = 5\nseeds = 0.5\n"
    "seed_distance = 9\n[painted]\ntrees = [[\"shy\", 20, 20, 0, 1]]\nerased = [7]\n";

struct GrowingWood {
    Project project;
    LoadedScene loaded;
    GrownForest grown;

    explicit GrowingWood(const std::string& scene) : project(wood_project(scene)) {
        Outcome<LoadedScene> read = load_scene({"wood.toml"}, {}, project);
        REQUIRE(read);
        loaded = std::move(read.value());
        Outcome<GrownForest> made = grow_species(loaded, project, {});
        REQUIRE(made);
        grown = std::move(made.value());
    }

    LargeVector<Tree> placed(std::uint32_t years) {
        Scene scene = loaded.scene;
        scene.placement.years = years;
        REQUIRE(place_forest(scene, project, grown));
        return grown.forest.trees;
    }
    ForestGrowth begin() {
        Outcome<ForestGrowth> begun = ForestGrowth::begin(loaded.scene, grown, project);
        REQUIRE(begun);
        return std::move(begun.value());
    }
};

/// Height of a tree, m: 2 m more with each stage of ten years.
float stage_height(const Tree& tree) {
    return 1.0F + 2.0F * static_cast<float>(std::min(tree.age / 10, 2));
}

bool is_same_wood(const LargeVector<Tree>& a, const LargeVector<Tree>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Tree)) == 0;
}

} // namespace

TEST_CASE("at a whole year, a growing forest equals the forest placed with that number of years") {
    GrowingWood wood(GENERATE(kWood, kShyWood));
    ForestGrowth growth = wood.begin();
    CHECK(growth.last_year() == 30);
    LargeVector<Tree> trees;
    for (const std::uint32_t year : {0U, 1U, 2U, 9U, 10U, 30U, 4U}) { // back from 30 to 4
        INFO("year " << year);
        REQUIRE(growth.trees({year, 0.0}, stage_height, wood.project, trees));
        CHECK(is_same_wood(trees, wood.placed(year)));
        if (year < 30) { // going back from a later moment gives the same trees
            REQUIRE(growth.trees({year, 0.5}, stage_height, wood.project, trees));
            REQUIRE(growth.trees({year, 0.0}, stage_height, wood.project, trees));
            CHECK(is_same_wood(trees, wood.placed(year)));
        }
    }
}

TEST_CASE("between two years trees grow, sprout from nothing and shrink to nothing") {
    GrowingWood wood(kWood);
    ForestGrowth growth = wood.begin();
    std::size_t kept = 0;
    std::size_t new_stages = 0;
    std::size_t born = 0;
    std::size_t dead = 0;
    for (std::uint32_t year = 8; year < 14; ++year) {
        const LargeVector<Tree> before = wood.placed(year);
        const LargeVector<Tree> after = wood.placed(year + 1);
        const auto find = [](const LargeVector<Tree>& trees, std::uint32_t number) {
            const auto at = std::find_if(trees.begin(), trees.end(), [number](const Tree& tree) {
                return tree.number == number;
            });
            return at == trees.end() ? nullptr : &*at;
        };
        for (const double part : {1e-6, 0.25, 1.0 - 1e-6}) {
            LargeVector<Tree> between;
            REQUIRE(growth.trees({year, part}, stage_height, wood.project, between));
            CHECK(std::is_sorted(between.begin(), between.end(),
                                 [](const Tree& a, const Tree& b) { return a.number < b.number; }));
            const double ease = part * part * (3.0 - 2.0 * part);
            for (const Tree& tree : between) {
                const Tree* const old = find(before, tree.number);
                const Tree* const next = find(after, tree.number);
                const double height = static_cast<double>(tree.scale * stage_height(tree));
                if (old != nullptr && next != nullptr) {
                    const auto low = static_cast<double>(old->scale * stage_height(*old));
                    const auto high = static_cast<double>(next->scale * stage_height(*next));
                    CHECK(height == Approx(low + part * (high - low)).epsilon(1e-4));
                    CHECK(tree.age == old->age);
                    CHECK(tree.position == old->position);
                    ++kept;
                    new_stages += stage_height(*old) != stage_height(*next) ? 1U : 0U;
                } else if (next != nullptr) {
                    CHECK(static_cast<double>(tree.scale) ==
                          Approx(ease * static_cast<double>(next->scale)).epsilon(1e-4));
                    ++born;
                } else {
                    REQUIRE(old != nullptr);
                    CHECK(static_cast<double>(tree.scale) ==
                          Approx((1.0 - ease) * static_cast<double>(old->scale))
                              .epsilon(1e-4)
                              .margin(1e-9));
                    ++dead;
                }
            }
            CHECK(between.size() >= std::max(before.size(), after.size()));
        }
    }
    CHECK(kept > 0);
    CHECK(new_stages > 0);
    CHECK(born > 0);
    CHECK(dead > 0);
}

TEST_CASE("trees with stages pass through them, each from its first stage") {
    GrowingWood wood("key = 5\n[terrain]\nsize = 40\n[placement]\ncount = 300\n[[species]]\n"
                     "grammar = \"bush.lsys\"\nstages = [0, 1, 2, 3]\n");
    wood.placed(0);
    const LargeVector<Tree> start = wood.grown.forest.trees;
    const Forest& forest = wood.grown.forest;
    ForestGrowth growth = wood.begin();
    REQUIRE(growth.last_year() == 3);
    const auto height_of = [&](const Tree& tree) {
        return 1.0F + static_cast<float>(forest.stage_of(tree));
    };
    LargeVector<Tree> trees;
    std::array<std::size_t, 4> counts{};
    for (const Tree& tree : start) {
        ++counts[forest.stage_of(tree)];
    }
    CHECK(*std::min_element(counts.begin(), counts.end()) > 50);
    for (const std::uint32_t year : {0U, 1U, 3U, 2U}) {
        INFO("year " << year);
        REQUIRE(growth.trees({year, 0.0}, height_of, wood.project, trees));
        REQUIRE(trees.size() == start.size());
        for (std::size_t i = 0; i < trees.size(); ++i) {
            REQUIRE(forest.stage_of(trees[i]) == std::min(forest.stage_of(start[i]) + year, 3U));
            REQUIRE(trees[i].scale == start[i].scale);
        }
        Scene later = wood.loaded.scene; // --years gives the same trees
        later.placement.stages_passed = year;
        REQUIRE(place_forest(later, wood.project, wood.grown));
        CHECK(is_same_wood(trees, wood.grown.forest.trees));
    }
    REQUIRE(growth.trees({1, 0.5}, height_of, wood.project, trees));
    for (std::size_t i = 0; i < trees.size(); ++i) {
        const std::uint32_t stage = forest.stage_of(start[i]);
        const auto low = static_cast<float>(std::min(stage + 1, 3U)) + 1.0F;
        const auto high = static_cast<float>(std::min(stage + 2, 3U)) + 1.0F;
        CHECK(trees[i].scale * height_of(trees[i]) == Approx(0.5F * (low + high)));
    }
}

TEST_CASE("a forest of trees without stages that is not placed by domination does not grow") {
    const GrowingWood wood(
        "[terrain]\nsize = 40\n[placement]\ncount = 9\n[[species]]\ngrammar = \"bush.lsys\"\n");
    const Outcome<ForestGrowth> begun =
        ForestGrowth::begin(wood.loaded.scene, wood.grown, wood.project);
    REQUIRE_FALSE(begun);
    CHECK(begun.stop() == Stop::Failed);
    CHECK(begun.messages().all().at(0).text.find("domination") != std::string::npos);
}
