// SPDX-License-Identifier: MIT
// Scene files: the value and default of each key, and messages about mistakes. Files named by a
// scene are not opened.
#include "grammar/base/source.h"
#include "runtime/scene/scene.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

using lsys::parse_scene;
using lsys::PlacementMethod;
using lsys::Scene;
using lsys::SceneSpecies;

namespace {

struct Parsed {
    std::optional<Scene> scene;
    std::string messages; // `line:column-column: text [code]`, then labels and help
};

Parsed parsed(std::string text) {
    lsys::SourceMap sources;
    const lsys::FileId file = sources.add("a.toml", std::move(text));
    lsys::Diagnostics diagnostics;
    Parsed all{parse_scene(file, sources, diagnostics), {}};
    for (const lsys::Diagnostic& one : diagnostics.all()) {
        const lsys::LineColumn begin = sources.file(file).line_column(one.span.begin);
        const lsys::LineColumn end = sources.file(file).line_column(one.span.end);
        all.messages += std::to_string(begin.line) + ":" + std::to_string(begin.column) + "-" +
                        std::to_string(end.column) + ": " + one.message + " [" +
                        std::string(lsys::info(one.code).name) + "]\n";
        if (!one.label.empty()) {
            all.messages += "  label: " + one.label + "\n";
        }
        for (const lsys::Label& label : one.labels) {
            all.messages += "  " + label.text + ": " + std::string(sources.text(label.span)) + "\n";
        }
        for (const std::string& note : one.notes) {
            all.messages += "  note: " + note + "\n";
        }
        for (const std::string& help : one.help) {
            all.messages += "  help: " + help + "\n";
        }
        for (const lsys::Fix& fix : one.fixes) {
            all.messages += "  fix: " + fix.edits.at(0).replacement + "\n";
        }
    }
    CHECK(all.scene.has_value() == all.messages.empty());
    return all;
}

Scene scene_of(std::string text) {
    Parsed all = parsed(std::move(text));
    INFO(all.messages);
    REQUIRE(all.scene);
    return std::move(*all.scene);
}

/// Appends a species to a scene.
std::string with_species(const std::string& text) {
    return text + "\n[[species]]\ngrammar = \"a.lsys\"\n";
}

constexpr const char* kEveryKey = R"(
key = 9_223_372_036_854_775_807
[terrain]
kind = "noise"
origin = [-50, 20]
size = [300, 200.5]
octaves = 3
lacunarity = 2.5
gain = 0.25
feature = 80
height = 12
base = -4
seed = 7
[placement]
method = "domination"
count = 10_000_000
years = 250
[[species]]
name = "Kiefer"
grammar = "pine.lsys"
stages = [2, 4, 9]
years_of_stage = 12.5
define = { angle = 30, "leaf size" = -0.5 }
heroes = 4
rho = 1
seed = 11
cache_cap = 20
tolerance = 0.05
share = 3
scale = [0.5, 1.5]
altitude = [-inf, 900]
slope = 45
[species.growth]
rate = 0.3
greatest_radius = 4
shade_tolerance = 0.2
vigour_spread = 0.1
lifespan = 200
maturity = 15
seeds = 2
seed_distance = 33
)";

} // namespace

TEST_CASE("a species may select a dialect and a system of its file") {
    const Scene scene =
        scene_of("[[species]]\ngrammar = \"a.l\"\nsystem = \"Dragon\"\n"
                 "dialect = \"fractint\"\n"
                 "[[species]]\ngrammar = \"a.l\"\nsystem = \"Tree\"\nname = \"t\"\n");
    CHECK(scene.species[0].name == "Dragon");
    CHECK(scene.species[0].system.text == "Dragon");
    CHECK(scene.species[0].dialect.text == "fractint");
    CHECK(scene.species[1].name == "t");
    CHECK(scene.species[1].system.text == "Tree");
    CHECK(parsed("[[species]]\ngrammar = \"a.l\"\nsystem = 3\n").messages.starts_with("3:10-"));
}

TEST_CASE("a species may sense its surroundings") {
    const Scene scene = scene_of("[[species]]\ngrammar = \"a.lsys\"\nsurroundings = \"sensed\"\n"
                                 "[[species]]\ngrammar = \"b.lsys\"\nsurroundings = \"ignored\"\n"
                                 "[[species]]\ngrammar = \"c.lsys\"\n");
    CHECK(scene.species[0].senses_surroundings);
    CHECK_FALSE(scene.species[1].senses_surroundings);
    CHECK_FALSE(scene.species[2].senses_surroundings);
    CHECK(parsed("[[species]]\ngrammar = \"a.lsys\"\nsurroundings = true\n")
              .messages.starts_with("3:16-"));
}

TEST_CASE("a scene of one grammar has all defaults") {
    const Scene scene = scene_of("[[species]]\ngrammar = \"trees/pine.lsys\"\n");
    CHECK(scene.terrain.kind == lsys::TerrainKind::Flat);
    CHECK(scene.terrain.region.width == 100.0);
    CHECK(scene.terrain.region.depth == 100.0);
    CHECK(scene.placement.key == 0);
    CHECK(scene.placement.method == PlacementMethod::Uniform);
    CHECK(scene.placement.count == 1000);
    CHECK(scene.placement.region.area() == 10'000.0);
    REQUIRE(scene.species.size() == 1);
    REQUIRE(scene.placement.species.size() == 1);
    const SceneSpecies& pine = scene.species[0];
    CHECK(pine.name == "pine");
    CHECK(pine.grammar.path == "trees/pine.lsys");
    CHECK(pine.dialect.text.empty());
    CHECK(pine.system.text.empty());
    CHECK(pine.rho == 0.6F);
    CHECK(pine.cache.heroes == 10);
    CHECK(pine.cache.seed == 0);
    CHECK(pine.cache.cap == 0);
    CHECK(pine.stages.empty());
    CHECK(scene.placement.species[0].share == 1.0);
    CHECK(std::isinf(scene.placement.species[0].steepest));
}

TEST_CASE("every key sets its option") {
    const Scene scene = scene_of(kEveryKey);

    CHECK(scene.placement.key == 9'223'372'036'854'775'807U);
    CHECK(scene.terrain.kind == lsys::TerrainKind::Noise);
    CHECK(scene.terrain.region.x == -50.0);
    CHECK(scene.terrain.region.z == 20.0);
    CHECK(scene.terrain.region.width == 300.0);
    CHECK(scene.terrain.region.depth == 200.5);
    const lsys::NoiseOptions& noise = scene.terrain.noise;
    CHECK(noise.octaves == 3);
    CHECK(noise.lacunarity == 2.5);
    CHECK(noise.gain == 0.25);
    CHECK(noise.feature == 80.0);
    CHECK(noise.height == 12.0);
    CHECK(noise.base == -4.0);
    CHECK(noise.seed == 7);
    CHECK(scene.placement.method == PlacementMethod::Domination);
    CHECK(scene.placement.count == 10'000'000);
    CHECK(scene.placement.years == 250);
    CHECK(scene.placement.region.z == 20.0);
    const SceneSpecies& pine = scene.species.at(0);
    CHECK(pine.name == "Kiefer");
    CHECK(pine.stages == std::vector<std::uint32_t>{2, 4, 9});
    CHECK(pine.years_of_stage == 12.5F);
    REQUIRE(pine.definitions.size() == 2);
    CHECK(pine.definitions[0].name == "angle");
    CHECK(pine.definitions[0].value == 30.0F);
    CHECK(pine.definitions[1].name == "leaf size");
    CHECK(pine.definitions[1].value == -0.5F);
    CHECK(pine.cache.heroes == 4);
    CHECK(pine.rho == 1.0F);
    CHECK(pine.cache.seed == 11);
    CHECK(pine.cache.cap == 20);
    CHECK(pine.cache.tolerance == 0.05F);
    const lsys::PlacementSpecies& placed = scene.placement.species.at(0);
    CHECK(placed.share == 3.0);
    CHECK(placed.min_scale == 0.5F);
    CHECK(placed.max_scale == 1.5F);
    CHECK(placed.lowest == -std::numeric_limits<float>::infinity());
    CHECK(placed.highest == 900.0F);
    CHECK(placed.steepest == Approx(1.0F));
    CHECK(placed.growth.rate == 0.3F);
    CHECK(placed.growth.max_radius == 4.0F);
    CHECK(placed.growth.tolerance == 0.2F);
    CHECK(placed.growth.vigour_spread == 0.1F);
    CHECK(placed.growth.lifespan == 200);
    CHECK(placed.growth.maturity == 15);
    CHECK(placed.growth.seeds == 2.0F);
    CHECK(placed.growth.seed_distance == 33.0F);
}

TEST_CASE("a map is a PNG, or raw samples of a stated size") {
    Scene scene = scene_of(with_species("[terrain]\nkind = \"height-map\"\nmap = \"h.png\"\n"
                                        "lowest = -3\nhighest = 40\nfilter = \"bilinear\"\n"
                                        "size = 64"));
    CHECK(scene.terrain.map.path == "h.png");
    CHECK(scene.terrain.map_columns == 0);
    CHECK(scene.terrain.height_map.lowest == -3.0);
    CHECK(scene.terrain.height_map.highest == 40.0);
    CHECK(scene.terrain.height_map.filter == lsys::HeightFilter::Bilinear);
    CHECK(scene.terrain.region.depth == 64.0);
    scene = scene_of(with_species("[terrain]\nkind = \"height-map\"\nmap = \"h.raw\"\n"
                                  "map_size = [640, 480]"));
    CHECK(scene.terrain.map_columns == 640);
    CHECK(scene.terrain.map_rows == 480);
    scene = scene_of(with_species("[placement]\nmethod = \"density-cells\"\nmap = \"d.png\"\n"
                                  "density = 0.25"));
    CHECK(scene.density_map.path == "d.png");
    CHECK(scene.placement.density == 0.25);
    REQUIRE(scene.placement.map_region);
    CHECK(scene.placement.map_region->width == 100.0);
}

TEST_CASE("the ground has a picture with a relief and a size") {
    Scene scene = scene_of(with_species("[terrain]\norigin = [7, -3]\ncolour = \"a.png\""));
    CHECK(scene.terrain.colour.path == "a.png");
    CHECK(scene.terrain.normals.path.empty());
    CHECK(scene.terrain.tile_width == 4.0);
    CHECK(scene.terrain.tile_depth == 4.0);
    CHECK(scene.terrain.tile_x == 7.0);
    CHECK(scene.terrain.tile_z == -3.0);
    scene = scene_of(with_species("[terrain]\ncolour = \"a.png\"\nnormals = \"b.png\"\n"
                                  "tile = [2.5, 8]"));
    CHECK(scene.terrain.normals.path == "b.png");
    CHECK(scene.terrain.tile_width == 2.5);
    CHECK(scene.terrain.tile_depth == 8.0);
    CHECK(parsed(with_species("[terrain]\nnormals = \"b.png\"\ntile = 2"))
              .messages.find("the ground has no `colour`") != std::string::npos);
    CHECK(parsed(with_species("[terrain]\ncolour = \"a.png\"\ntile = 0"))
              .messages.find("3:8-9: `tile`") == 0);
}

TEST_CASE("the sun has a place or a time") {
    const auto light_of = [](const std::string& keys) {
        return scene_of(with_species("[light]\n" + keys)).light;
    };
    CHECK(light_of("") == lsys::SceneLight{});
    const lsys::SceneLight placed = light_of("sun = [225, -3.5]\nturbidity = 6");
    CHECK(placed.sun == lsys::SunPlace{225.0, -3.5});
    CHECK(placed.turbidity == 6.0);
    CHECK(light_of("day = 172\nhour = 18.5\nlatitude = 52").sun == lsys::sun_at(172.0, 18.5, 52.0));
    const auto messages_of = [](const std::string& keys) {
        return parsed(with_species("[light]\n" + keys)).messages;
    };
    CHECK(messages_of("sun = [0, 91]").find("the elevation of the sun must be from -90 to 90") !=
          std::string::npos);
    CHECK(messages_of("sun = 45").find("2:7-9: `sun`") == 0);
    CHECK(messages_of("hour = 12\nlatitude = 0").find("the time of the light has no `day`") !=
          std::string::npos);
    CHECK(messages_of("sun = [0, 1]\nhour = 12").find("3:1-5: ") == 0);
    CHECK(messages_of("day = 1\nhour = 25\nlatitude = 0").find("3:8-10: `hour`") == 0);
    CHECK(messages_of("turbidity = 1").find("2:13-14: `turbidity`") == 0);
    CHECK(parsed(with_species("[terrain]\nhour = 12")).messages.find("[light]") !=
          std::string::npos);
}

TEST_CASE("a season is that of every species") {
    CHECK_FALSE(scene_of(with_species("")).species[0].season);
    CHECK(scene_of(with_species("season = 0.25")).species[0].season == 0.25F);
    CHECK(parsed(with_species("season = 1.5")).messages.find("1:10-13: `season`") == 0);
}

TEST_CASE("the sun of equinox, solstice and both hemispheres") {
    const auto is_near = [](const lsys::SunPlace& sun, double azimuth, double elevation) {
        return std::abs(sun.azimuth - azimuth) < 0.5 && std::abs(sun.elevation - elevation) < 0.5;
    };
    CHECK(is_near(lsys::sun_at(81.0, 12.0, 52.0), 180.0, 38.0));   // equinox, noon
    CHECK(is_near(lsys::sun_at(81.0, 6.0, 52.0), 90.0, 0.0));      // sunrise in the east
    CHECK(is_near(lsys::sun_at(81.0, 18.0, -20.0), 270.0, 0.0));   // sunset in the west
    CHECK(is_near(lsys::sun_at(172.0, 12.0, 52.0), 180.0, 61.45)); // June solstice
    CHECK(is_near(lsys::sun_at(355.0, 12.0, 52.0), 180.0, 14.55)); // December solstice
    CHECK(is_near(lsys::sun_at(355.0, 12.0, -34.0), 0.0, 79.45));  // sun in the north at noon
    CHECK(lsys::sun_at(172.0, 0.0, 70.0).elevation > 3.0);         // midnight sun
    // Published values for 40 degrees north on 21 June (ASHRAE Handbook, Fundamentals).
    CHECK(is_near(lsys::sun_at(172.0, 16.0, 40.0), 180.0 + 90.7, 37.4));
    CHECK(is_near(lsys::sun_at(172.0, 15.0, 40.0), 180.0 + 80.2, 48.8));
    CHECK(is_near(lsys::sun_at(172.0, 10.0, 40.0), 180.0 - 65.8, 59.8));
    CHECK(is_near(lsys::sun_at(172.0, 12.0, 40.0), 180.0, 73.5));
}

TEST_CASE("every method has its keys and refuses others") {
    const std::vector<std::pair<std::string, std::vector<std::string>>> methods{
        {"uniform", {"count = 2"}},
        {"poisson-disk", {"spacing = 2"}},
        {"density-map", {"density = 2", "map = \"a.png\""}},
        {"domination", {"count = 2", "years = 2"}},
        {"jittered", {"spacing = 2"}},
        {"uniform-cells", {"density = 2"}},
        {"poisson-cells", {"spacing = 2"}},
        {"density-cells", {"density = 2", "map = \"a.png\""}},
    };
    const std::vector<std::string> all{"count = 2", "spacing = 2", "density = 2", "map = \"a.png\"",
                                       "years = 2"};
    for (std::size_t i = 0; i < methods.size(); ++i) {
        const auto& [name, keys] = methods[i];
        INFO(name);
        std::string text = "[placement]\nmethod = \"" + name + "\"\n";
        for (const std::string& key : keys) {
            text += key + "\n";
        }
        const Scene scene = scene_of(with_species(text));
        CHECK(static_cast<std::size_t>(scene.placement.method) == i);
        for (const std::string& key : all) {
            if (text.find("\n" + key) == std::string::npos) {
                const Parsed wrong = parsed(with_species(text + key));
                INFO(key);
                CHECK(wrong.messages.find("[conflicting-scene-keys]\n  this decides: \"" + name) !=
                      std::string::npos);
            }
        }
    }
}

TEST_CASE("places are correct after tabs, wide characters and a byte order mark") {
    CHECK(parsed("\xEF\xBB\xBF# \xC3\xA9\n[[species]]\r\n\t\tgrammar = \"\xF0\x9F\x8C\xB2\" # "
                 "\xC3\xA9\r\n\tname = \"\xC3\xBC\"\t\r\n\trho = 2 # \xC3\xA9\r\n")
              .messages == "5:8-9: `rho` is 2; it must be from 0 to 1 [bad-scene-value]\n");
    CHECK(parsed(with_species("terrain = { \"\xC3\xA9\xC3\xA9\" = 1, kind = 2 }")).messages ==
          "1:13-17: `[terrain]` has no key `\xC3\xA9\xC3\xA9` [unknown-scene-key]\n"
          "  help: the keys are `kind`, `origin`, `size`, `octaves`, `lacunarity`, `gain`, "
          "`feature`, `height`, `seed`, `map`, `map_size`, `lowest`, `highest`, `filter`, `base`, "
          "`colour`, `normals`, `tile`\n"
          "1:30-31: `kind` must be a text [bad-scene-value]\n"
          "  label: this is a whole number\n");
}

TEST_CASE("a file that is not TOML gives one message") {
    const std::vector<std::pair<std::string, std::string>> cases{
        {"key = ", "1:7-7: the file ends within a key-value pair [scene-syntax]\n"},
        {"\tkey = [1, 2", "1:13-13: the file ends within an array [scene-syntax]\n"},
        {"key = \"\xC3\xA9", "1:9-9: the file ends within a string [scene-syntax]\n"},
        {"key = 5 5", "1:9-9: expected a comment or whitespace, saw `5` [scene-syntax]\n"
                      "  note: while reading a key-value pair\n"},
        {"[terrain]\nkind = flat\n", "2:9-9: expected `false`, saw `fl` [scene-syntax]\n"
                                     "  note: while reading a boolean\n"
                                     "  help: put a text in quotes: `kind = \"flat\"`\n"},
        {"[terrain]\n[terrain]\n",
         "2:1-1: cannot redefine existing table `terrain` [scene-syntax]\n"
         "  note: while reading a table header\n"
         "  help: a table may appear only once; each species begins with `[[species]]`\n"},
        {"key = 1\nkey = 2\n", "2:7-7: cannot redefine existing integer `key` [scene-syntax]\n"
                               "  note: while reading a key-value pair\n"
                               "  help: a key may appear only once in its table\n"},
        {"\n[=x]\n", "2:2-2: expected bare key starting character or string delimiter, saw `=` "
                     "[scene-syntax]\n"
                     "  note: while reading a key\n"},
        {"k\xC3\xA9y = 1", "1:2-2: expected `=`, saw `\xC3\xA9` [scene-syntax]\n"
                           "  note: while reading a key-value pair\n"},
        {"key = \"\xFF\"", "1:7-7: encountered invalid utf-8 sequence [scene-syntax]\n"},
    };
    for (const auto& [text, messages] : cases) {
        CHECK(parsed(text).messages == messages);
    }
    CHECK(parsed(std::string(100'000, '[')).messages.find("[scene-syntax]") != std::string::npos);
    CHECK(parsed("key = " + std::string(100'000, '[')).messages.find("[scene-syntax]") !=
          std::string::npos);
}

TEST_CASE("a key of very many parts is an error and does not exhaust the stack") {
    const std::string message = "a key of more than 16 parts [scene-syntax]\n";
    const auto repeated = [](std::string_view part, int count) {
        std::string text;
        for (int i = 0; i < count; ++i) {
            text += part;
        }
        return text;
    };
    for (const int parts : {16, 1'000, 1'000'000}) {
        CHECK(parsed(repeated("a.", parts) + "a = 1").messages == "1:1-34: " + message);
        CHECK(parsed("x = 1\n[" + repeated("a.", parts) + "a]").messages == "2:2-35: " + message);
        CHECK(parsed(" \t[[ " + repeated("a.", parts) + "a]]").messages == "1:6-39: " + message);
        CHECK(parsed("x = { y.z = 1.5, " + repeated("a.", parts) + "a = 1 }").messages ==
              "1:18-51: " + message);
        CHECK(parsed(repeated("'a\\' . ", parts) + "a = 1").messages.ends_with(message));
        CHECK(parsed(repeated("\"\\\"\".", parts) + "a = 1").messages.ends_with(message));
    }
    const std::string dots = repeated("a.", 40) + "a";
    const std::string fine = "# " + dots + "\n[[species]]\ngrammar = \"" + dots + "\\\"" + dots +
                             "\"\nsystem = '" + dots + "'\nshare = 1 # " + dots + "\n";
    CHECK(parsed(fine).scene.has_value());
    const std::string multiline_strings = "[[species]]\ngrammar = \"\"\"\n" + dots +
                                          "\"\n\\\"\"\"" + dots + "\"\"\"\"\"\nsystem = '''\n''" +
                                          dots + "\\''''\nshare = 1\n";
    CHECK(parsed(multiline_strings).messages.find("more than") == std::string::npos);
    const std::string longest = repeated("a.", 15) + "a = ";
    CHECK(parsed(repeated(longest + "{ ", 250) + "a = 1" + repeated(" }", 250))
              .messages.find("[unknown-scene-key]") != std::string::npos);
    CHECK(parsed(repeated("a.", 15) + "a = 1").messages.find("more than") == std::string::npos);
}

TEST_CASE("stages set the first stage of plants with every method") {
    const std::string species = "[[species]]\ngrammar = \"a\"\nstages = [1, 2, 4]\n";
    Scene scene = scene_of(species);
    CHECK(scene.placement.species[0].stages == 3);
    CHECK(scene.placement.species[0].start == lsys::StageStart::Random);
    CHECK(lsys::years_of_stage(scene, 0) == lsys::kYearsPerStage);
    CHECK(lsys::last_year(scene) == 2);
    scene = scene_of(species + "starting_stage = \"first\"\n");
    CHECK(scene.placement.species[0].start == lsys::StageStart::First);
    const std::string wood = "[placement]\nmethod = \"domination\"\nyears = 60\n";
    scene = scene_of(wood + species + "years_of_stage = 5\n");
    CHECK(scene.placement.species[0].start == lsys::StageStart::First);
    CHECK(scene.placement.species[0].years_of_stage == 5.0F);
    CHECK(lsys::last_year(scene) == 60);
    scene = scene_of(wood + species + "years_of_stage = 5\nstarting_stage = \"random\"\n");
    CHECK(scene.placement.species[0].start == lsys::StageStart::Random);
    scene = scene_of("[[species]]\ngrammar = \"a\"\n");
    CHECK(scene.placement.species[0].stages == 1);
    CHECK(lsys::years_of_stage(scene, 0) == 0.0F);
    CHECK(lsys::last_year(scene) == 0);
    CHECK(parsed(species + "years_of_stage = 5\nstarting_stage = \"last\"\n").messages ==
          "4:1-15: `years_of_stage` has no effect here: only with the method `domination` do "
          "plants have an age [conflicting-scene-keys]\n"
          "5:18-24: there is no starting_stage `last` [bad-scene-value]\n"
          "  help: `starting_stage` is one of `first`, `random`\n");
    CHECK(parsed("[[species]]\ngrammar = \"a\"\nstarting_stage = \"first\"\n").messages ==
          "3:1-15: `starting_stage` has no effect here: the species has no `stages` "
          "[conflicting-scene-keys]\n");
}

TEST_CASE("missing required keys are reported") {
    CHECK(parsed("").messages ==
          "1:1-1: the scene has no `[[species]]` [missing-scene-key]\n"
          "  help: add one: `[[species]]`, and below it `grammar = \"pine.lsys\"`\n");
    CHECK(parsed("[terrain]\nkind = \"height-map\"\n[placement]\nmethod = \"density-map\"\n"
                 "[[species]]\nheroes = 3\n")
              .messages ==
          "1:1-10: the terrain is a height map and has no `map` [missing-scene-key]\n"
          "  help: name a picture beside the scene: `map = \"heights.png\"`\n"
          "3:1-12: the method is `density-map` and has no `map` [missing-scene-key]\n"
          "  help: name a picture beside the scene: `map = \"density.png\"`\n"
          "5:1-12: the species has no `grammar` [missing-scene-key]\n"
          "  help: name a grammar beside the scene: `grammar = \"pine.lsys\"`\n");
    CHECK(parsed(with_species("[terrain]\nkind = \"height-map\"\nmap = \"h.raw\"")).messages ==
          "1:1-10: the terrain has a map of raw samples and has no `map_size` "
          "[missing-scene-key]\n"
          "  help: say how many columns and rows it has: `map_size = [1024, 1024]`\n");
    CHECK(parsed("[placement]\nmethod = \"domination\"\n[[species]]\ngrammar = \"a\"\n"
                 "stages = [1, 2]\n")
              .messages == "3:1-12: the species has `stages` and has no `years_of_stage` "
                           "[missing-scene-key]\n"
                           "  help: say how many years a plant needs for each: "
                           "`years_of_stage = 10`\n");
}

TEST_CASE("messages about values out of range have the range") {
    const std::vector<std::pair<std::string, std::string>> cases{
        {"key = -1", "`key` is -1; it must be 0 or more"},
        {"[terrain]\nsize = 0", "`size` is 0; it must be from 0.25 to 2,000,000 m"},
        {"[terrain]\nsize = [9, -9]",
         "the second number of `size` is -9; it must be from 0.25 to 2,000,000 m"},
        {"[terrain]\nsize = nan", "`size` is nan; it must be from 0.25 to 2,000,000 m"},
        {"[terrain]\norigin = [999999, 0]", ""},
        {"[terrain]\norigin = [999999, 0]\nsize = 2",
         "the ground reaches farther than 1000 km from the origin, where places are no longer "
         "exact"},
        {"[terrain]\nkind = \"noise\"\noctaves = 17", "`octaves` is 17; it must be from 1 to 16"},
        {"[terrain]\nkind = \"noise\"\ngain = inf", "`gain` is inf; it must be from 0 to 1"},
        {"[placement]\ncount = 1_000_000_000",
         "`count` is 1,000,000,000; it must be from 1 to 10,000,000"},
        {"[placement]\nmethod = \"poisson-disk\"\nspacing = 0.01",
         "about 70,000,000 trees; one placement has at most 10,000,000"},
        {"[placement]\nmethod = \"jittered\"\nspacing = -5",
         "`spacing` is -5; it must be from 0.001 to 1,000,000 m"},
        {"[placement]\nmethod = \"domination\"\nyears = 10001",
         "`years` is 10,001; it must be from 0 to 10,000"},
        {"[[species]]\ngrammar = \"b\"\nheroes = 0", "`heroes` is 0; it must be from 1 to 100,000"},
        {"[[species]]\ngrammar = \"b\"\nrho = 1.001", "`rho` is 1.001; it must be from 0 to 1"},
        {"[[species]]\ngrammar = \"b\"\nrho = -1e-9", "`rho` is -1e-09; it must be from 0 to 1"},
        {"[[species]]\ngrammar = \"b\"\nrho = nan", "`rho` is nan; it must be from 0 to 1"},
        {"[[species]]\ngrammar = \"b\"\nscale = [2, 1]",
         "`scale` begins at 2 and ends below it, at 1"},
        {"[[species]]\ngrammar = \"b\"\nheight = [9, 8]",
         "`height` begins at 9 and ends below it, at 8"},
        {"[[species]]\ngrammar = \"b\"\nheight = [0, 8]",
         "the first number of `height` is 0; it must be from 1e-06 to 1,000,000 m"},
        {"[[species]]\ngrammar = \"b\"\naltitude = [nan, 1]",
         "the first number of `altitude` is nan; it must be a number"},
        {"[[species]]\ngrammar = \"b\"\ndefine = { a = inf }", "`a` is inf; it must be from "},
        {"[[species]]\ngrammar = \"\"", "`grammar` is empty"},
        {"[[species]]\ngrammar = \"b\\u0000\"", "`grammar` holds a control character"},
        {"[[species]]\ngrammar = \"b\"\nslope = 90", ""},
        {"[[species]]\ngrammar = \"b\"\ncache_cap = 4294967296",
         "`cache_cap` is 4,294,967,296; it must be from 0 to 4,294,967,295"},
        {"[placement]\nmethod = \"domination\"\n[[species]]\ngrammar = \"b\"\n[species.growth]\n"
         "rate = 7",
         "plants grow by 7 m a year, more than their greatest radius of 6 m"},
        {"[placement]\nmethod = \"domination\"\n[[species]]\ngrammar = \"b\"\nyears_of_stage = 5\n"
         "stages = [3, 3]",
         "stages must ascend: 3 is not above 3"},
    };
    for (const auto& [text, message] : cases) {
        const Parsed result = parsed(with_species(text));
        INFO(text << "\n" << result.messages);
        CHECK(result.messages.empty() == message.empty());
        CHECK(result.messages.find(message) != std::string::npos);
        CHECK(
            (message.empty() || result.messages.find("[bad-scene-value]\n") != std::string::npos));
    }
    CHECK(parsed("[[species]]\ngrammar = \"a\"\nshare = 0\n").messages ==
          "3:9-10: the shares of all species are 0, so no tree has a species "
          "[bad-scene-value]\n");
}

TEST_CASE("all mistakes of a scene are reported once, in the order of the text") {
    CHECK(parsed(R"([[species]]
heroes = "ten"
grammar = "pine.lsys"
[terain]
[terrain]
octave = 3
kind = "nois"
lowest = 3
[[species]]
grammar = "a/pine.lsys"
years = 3
turtle = "abop"
stages = [1]
growth = {}
[placement]
count = 5
spacing = 5
)")
              .messages ==
          "2:10-15: `heroes` must be a whole number [bad-scene-value]\n"
          "  label: this is a text\n"
          "4:2-8: a scene has no key `terain` [unknown-scene-key]\n"
          "  help: did you mean `terrain`?\n"
          "6:1-7: `[terrain]` has no key `octave` [unknown-scene-key]\n"
          "  help: did you mean `octaves`?\n"
          "  fix: octaves\n"
          "7:8-14: there is no kind `nois` [bad-scene-value]\n"
          "  help: did you mean `noise`?\n"
          "  fix: \"noise\"\n"
          "10:11-24: two species have the name `pine` [conflicting-scene-keys]\n"
          "  the other: \"pine.lsys\"\n"
          "  help: give one of them another `name`\n"
          "11:1-6: `[[species]]` has no key `years` [unknown-scene-key]\n"
          "  help: it belongs in `[placement]`\n"
          "12:1-7: `[[species]]` has no key `turtle` [unknown-scene-key]\n"
          "  help: a grammar names its turtle itself: `#set turtle abop;`\n"
          "14:1-7: `growth` has no effect here: only with the method `domination` do plants grow "
          "[conflicting-scene-keys]\n"
          "17:1-8: `spacing` has no effect here: the method `uniform` reads `count` "
          "[conflicting-scene-keys]\n");
}

TEST_CASE("tables and arrays of tables are not confused") {
    CHECK(parsed("[species]\ngrammar = \"a\"\n").messages ==
          "1:1-10: `species` must be a list of tables [bad-scene-value]\n"
          "  label: this is a table\n"
          "  help: each species begins with `[[species]]`, in two pairs of brackets\n");
    CHECK(parsed(with_species("terrain = \"flat\"\nplacement = 2020-02-02")).messages ==
          "1:11-17: `terrain` must be a table [bad-scene-value]\n"
          "  label: this is a text\n"
          "2:13-23: `placement` must be a table [bad-scene-value]\n"
          "  label: this is a date or time\n");
}

TEST_CASE("damaged scenes are repaired or reported at the damaged place") {
    const std::vector<std::string> pieces{
        "[",    "]",        "{",    "}",      "\"",      "=",  ".",  "nan",
        "-inf", "\xC3\xA9", "\xFF", "\t",     "\r\n",    "\n", "[[", "'''",
        "0x",   "#",        "1e9",  "\"\"\"", "species", "[=", ",",  "\xC2\xA0"};
    std::uint32_t state = 1;
    const auto draw = [&](std::size_t count) {
        state = state * 1664525U + 1013904223U;
        return static_cast<std::size_t>(state >> 8U) % count;
    };
    std::size_t refused = 0;
    for (int i = 0; i < 3000; ++i) {
        std::string text = kEveryKey;
        for (std::size_t wounds = 1 + draw(3); wounds > 0; --wounds) {
            const std::size_t at = draw(text.size());
            if (draw(2) == 0) {
                text.insert(at, pieces[draw(pieces.size())]);
            } else {
                text.erase(at, 1 + draw(12));
            }
        }
        lsys::SourceMap sources;
        const lsys::FileId file = sources.add("a.toml", text);
        lsys::Diagnostics diagnostics;
        const bool fine = parse_scene(file, sources, diagnostics).has_value();
        refused += fine ? 0U : 1U;
        std::uint32_t last = 0;
        bool in_order = fine != diagnostics.has_errors();
        for (const lsys::Diagnostic& one : diagnostics.all()) {
            in_order = in_order && one.span.file == file && last <= one.span.begin &&
                       one.span.begin <= one.span.end && one.span.end <= text.size();
            last = one.span.begin;
        }
        INFO(text);
        CHECK(in_order);
    }
    CHECK(refused > 1500);
    CHECK(refused < 3000);
}

TEST_CASE("painted and erased trees") {
    const Scene scene =
        scene_of("[[species]]\ngrammar = \"a.lsys\"\nname = \"a\"\n"
                 "[[species]]\ngrammar = \"b.lsys\"\nname = \"b\"\n"
                 "[painted]\ntrees = [[\"b\", 1, 2.5, 180, 0.5]]\nerased = [9, 4]\n");
    REQUIRE(scene.painting.trees.size() == 1);
    CHECK(scene.painting.trees[0].species == 1);
    CHECK(scene.painting.trees[0].x == 1.0F);
    CHECK(scene.painting.trees[0].z == 2.5F);
    CHECK(scene.painting.trees[0].yaw == Approx(3.14159265F));
    CHECK(scene.painting.trees[0].scale == 0.5F);
    CHECK(scene.painting.erased == std::vector<std::uint32_t>{4, 9});
}

TEST_CASE("a species has heights or scales") {
    const Scene scene = scene_of("[[species]]\ngrammar = \"a.lsys\"\nheight = [4, 9.5]\n");
    CHECK(scene.placement.species.at(0).min_height == 4.0F);
    CHECK(scene.placement.species.at(0).max_height == 9.5F);
    CHECK(scene.placement.species.at(0).min_scale == 1.0F);
    CHECK(scene_of(with_species("")).placement.species.at(0).max_height == 0.0F);
    CHECK(parsed("[[species]]\ngrammar = \"a.lsys\"\nheight = [4, 9]\nscale = [1, 2]\n").messages ==
          "4:1-6: `scale` has no effect here: `height` says how high the trees are "
          "[conflicting-scene-keys]\n  this decides: [4, 9]\n");
}

TEST_CASE("mistakes in paintings are reported at their place") {
    const std::string species = "[[species]]\ngrammar = \"a.lsys\"\nname = \"pine\"\n[painted]\n";
    CHECK(parsed(species + "trees = 3\n").messages.find("5:9-10: `trees` must be a list") == 0);
    CHECK(parsed(species + "trees = [[\"pin\", 1, 2, 3, 1]]\n")
              .messages.find("5:11-16: there is no species `pin` [bad-scene-value]\n  help: did "
                             "you mean `pine`?") == 0);
    CHECK(parsed(species + "trees = [[\"pine\", 1, 2, 3]]\n")
              .messages.find("5:10-27: a painted tree is a list") == 0);
    CHECK(parsed(species + "trees = [[\"pine\", 1, 2, 3, 0]]\n")
              .messages.find("5:28-29: the scale of a painted tree is 0") == 0);
    CHECK(parsed(species + "erased = [-1]\n")
              .messages.find("5:11-13: the number of an erased tree is -1") == 0);
    CHECK(parsed(species + "erazed = []\n").messages.find("`[painted]` has no key `erazed`") !=
          std::string::npos);
}
