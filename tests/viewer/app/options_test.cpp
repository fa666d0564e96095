// SPDX-License-Identifier: MIT
// The command line of lsview.
#include "viewer/app/options.h"

#include <catch2/catch.hpp>

using namespace lsys;
using namespace lsys::view;

namespace {

template <typename Result>
Result parsed(const std::vector<std::string>& arguments) {
    const ParsedOptions options = parse_options(arguments);
    REQUIRE(std::holds_alternative<Result>(options));
    return std::get<Result>(options);
}

} // namespace

TEST_CASE("the help of lsview names options as they are written") {
    const std::string help = parsed<PrintText>({"--help"}).text;
    CHECK(help.find("--no-shadows ") != std::string::npos);
    CHECK(help.find("--no-ground ") != std::string::npos);
    CHECK(help.find('{') == std::string::npos);
    CHECK(help.find("\n\n\n") == std::string::npos);
    const std::size_t placement = help.find("\nPlacement:\n");
    REQUIRE(placement != std::string::npos);
    CHECK(help.find("--key K") > placement);
    CHECK(help.find("--key K") < help.find("\n\n", placement + 1));
    CHECK(help.find("m/s2 (9.81 on Earth)") != std::string::npos);
}

TEST_CASE("the option --version --verbose of lsview adds how it was built") {
    CHECK_FALSE(parsed<PrintText>({"--version"}).with_build);
    CHECK(parsed<PrintText>({"--version", "--verbose"}).with_build);
    CHECK(parsed<PrintText>({"-v", "--version"}).with_build);
}

TEST_CASE("lsview has limits of time and output") {
    const auto limits = parsed<ViewOptions>(
        {"a.lsys", "--max-time", "2.5", "--max-output", "1M", "--screenshot", "a.png"});
    CHECK(limits.run.max_seconds == 2.5);
    CHECK(limits.run.max_output == std::uint64_t{1} << 20U);
    CHECK(parsed<ViewOptions>({"a.lsys", "--untrusted"}).run.max_seconds == 60.0);
    CHECK(parsed<UsageError>({"a.lsys", "--max-output", "1M"}).message ==
          "--max-output belongs to pictures");
}

TEST_CASE("without a file options of plants, forests and pictures are refused") {
    CHECK(parsed<ViewOptions>({}).file.empty());
    CHECK(parsed<ViewOptions>({"--samples", "1", "--size", "640x480"}).samples == 1);
    CHECK(parsed<UsageError>({"--screenshot", "a.png"}).message == "--screenshot needs a FILE");
    for (const char* const option :
         {"--seed=3", "-n3", "--count=10", "--season=0.5", "--height=3"}) {
        CAPTURE(option);
        CHECK(parsed<UsageError>({option}).message == "options of a plant or forest need a FILE");
    }
}

TEST_CASE("the name of a picture may not be empty, and a folder of shaders must exist") {
    CHECK(parsed<UsageError>({"tree.lsys", "--screenshot", ""}).message ==
          "--screenshot: the name of the file is empty");
    CHECK(parsed<UsageError>({"tree.lsys", "--shaders", "/nowhere/at/all"}).message ==
          "--shaders: there is no folder `/nowhere/at/all`");
}

TEST_CASE("options switch shadows and the ground off") {
    const ViewOptions usual = parsed<ViewOptions>({"tree.lsys"});
    CHECK(usual.shadows);
    CHECK(usual.ground);
    CHECK_FALSE(usual.is_forest);
    const ViewOptions bare = parsed<ViewOptions>({"tree.lsys", "--no-shadows", "--no-ground"});
    CHECK_FALSE(bare.shadows);
    CHECK_FALSE(bare.ground);
}

TEST_CASE("opening another file drops the options about the files of the command line") {
    ViewOptions options = parsed<ViewOptions>({"a.l", "b.l", "-D", "a=1", "--set", "angle=3", "-n",
                                               "3", "-s", "3", "--dialect", "l3d", "--heroes", "3",
                                               "--camera", "fov 30", "--air", "5", "--no-shadows"});
    use_other_file(options, "wood.toml");
    ViewOptions fresh = parsed<ViewOptions>({"wood.toml", "--no-shadows"});
    CHECK(options.file == fresh.file);
    CHECK(options.files == fresh.files);
    CHECK(options.is_forest);
    CHECK(options.grammar == fresh.grammar);
    CHECK(options.overrides == fresh.overrides);
    CHECK(options.seed == fresh.seed);
    CHECK(options.camera.empty());
    CHECK_FALSE(options.visibility);
    CHECK_FALSE(options.shadows);
    use_other_file(options, "tree.lsys");
    CHECK_FALSE(options.is_forest);
}

TEST_CASE("the sun has a place or a time, and a season is for plants and forests") {
    CHECK(parsed<ViewOptions>({"tree.lsys", "--sun", "225,-3.5"}).light.sun ==
          SunPlace{225.0, -3.5});
    CHECK(parsed<ViewOptions>({"wood.toml", "--sun", "172,18.5,52", "--turbidity", "6"}).light ==
          SceneLight{sun_at(172.0, 18.5, 52.0), 6.0});
    for (const char* const wrong :
         {"225", "0,91", "400,10", "0,12,52", "172,25,52", "1,2,3,4", "a,b", "0,", "nan,1"}) {
        CAPTURE(wrong);
        CHECK(parsed<UsageError>({"tree.lsys", "--sun", wrong}).message.find("--sun") !=
              std::string::npos);
    }
    const ViewOptions plant = parsed<ViewOptions>({"tree.lsys", "--season", "0.5"});
    CHECK_FALSE(plant.is_forest);
    REQUIRE(plant.grammar.definitions.size() == 1);
    CHECK(plant.grammar.definitions[0].name == "season");
    const ViewOptions forest = parsed<ViewOptions>({"wood.toml", "--season", "0.5"});
    CHECK(forest.overrides.season == 0.5F);
    CHECK(forest.grammar.definitions.empty());
}

TEST_CASE("pictures of plants and of forests show senses") {
    CHECK(parsed<ViewOptions>({"tree.lsys", "--senses", "light"}).senses.light);
    const ViewOptions forest = parsed<ViewOptions>({"wood.toml", "--senses", "light,markers"});
    CHECK(forest.senses == SenseLook{false, true, true, false});
    CHECK(parsed<ViewOptions>({"wood.toml"}).senses.obstacles);
    const ViewOptions sensed = parsed<ViewOptions>({"a.lsys", "--surroundings", "sensed"});
    CHECK(sensed.is_forest);
    CHECK(sensed.overrides.senses_surroundings == true);
}

TEST_CASE("the option --air is for forests") {
    CHECK(parsed<ViewOptions>({"wood.toml", "--air", "2.5"}).visibility == 2.5F);
    CHECK(parsed<ViewOptions>({"tree.lsys", "--count", "9", "--air", "2.5"}).visibility == 2.5F);
    CHECK(parsed<UsageError>({"tree.lsys", "--air", "2.5"}).message ==
          "--air sets the haze of a forest, and this is a plant");
    for (const char* const wrong : {"0", "-1", "nan", "inf", "thick", "2000000"}) {
        CAPTURE(wrong);
        CHECK(parsed<UsageError>({"wood.toml", "--air", wrong}).message.find("--air") !=
              std::string::npos);
    }
}

TEST_CASE("the option --quality sets looks and cost of pictures") {
    CHECK(parsed<ViewOptions>({"a.lsys"}).quality == Quality::Auto);
    CHECK(parsed<ViewOptions>({"a.lsys", "--quality", "low"}).quality == Quality::Low);
    CHECK(parsed<ViewOptions>({"a.lsys", "--quality", "high"}).quality == Quality::High);
    CHECK(parsed<UsageError>({"a.lsys", "--quality", "best"}).message.find("--quality") !=
          std::string::npos);
}

TEST_CASE("the option --culling says where trees are chosen") {
    CHECK(parsed<ViewOptions>({"wood.toml"}).culling == Culling::Auto);
    CHECK(parsed<ViewOptions>({"wood.toml", "--culling", "cpu"}).culling == Culling::Cpu);
    CHECK(parsed<ViewOptions>({"wood.toml", "--culling", "gpu"}).culling == Culling::Gpu);
    CHECK(parsed<UsageError>({"wood.toml", "--culling", "both"}).message.find("--culling") !=
          std::string::npos);
}

TEST_CASE("an option of forests shows a grammar as a forest") {
    CHECK(parsed<ViewOptions>({"tree.lsys", "--heroes", "3"}).is_forest);
    CHECK(parsed<ViewOptions>({"wood.toml"}).is_forest);
    CHECK_FALSE(parsed<ViewOptions>({"tree.lsys", "-s", "3", "-D", "a=1"}).is_forest);
}

TEST_CASE("plants and the trees of a forest have an option for height") {
    CHECK(parsed<ViewOptions>({"tree.lsys", "--height", "12.5"}).plant_height == 12.5F);
    CHECK_FALSE(parsed<ViewOptions>({"tree.lsys"}).plant_height);
    const auto forest = parsed<ViewOptions>({"wood.toml", "--height", "3"});
    CHECK_FALSE(forest.plant_height);
    CHECK(forest.overrides.height == lsys::HeightRange{3.0F, 3.0F});
    CHECK_FALSE(parsed<UsageError>({"tree.lsys", "--height", "0"}).message.empty());
}

TEST_CASE("pictures are PNG with any extension of the name") {
    const UsageError usage = parsed<UsageError>({"tree.lsys", "--screenshot", "a/tree.jpg"});
    CHECK(usage.message == "`a/tree.jpg`: pictures are written as png");
    CHECK(usage.help == "name it `a/tree.png`");
    for (const char* name : {"tree.png", "tree.PNG", "tree", "-"}) {
        CHECK(parsed<ViewOptions>({"tree.lsys", "--screenshot", name}).screenshot == name);
    }
}
