// SPDX-License-Identifier: MIT
// The pipeline as a library: files are read from memory, results are values.
#include "runtime/forest/tree_heights.h"
#include "runtime/pipeline/constant_text.h"
#include "runtime/pipeline/forest.h"
#include "runtime/pipeline/plant.h"
#include "runtime/turtle/plant_size.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <map>
#include <string>
#include <thread>
#include <utility>

using namespace lsys;

namespace {

/// A project that reads `files` from memory.
Project project_of(std::map<std::string, std::string> files) {
    Project project;
    project.threads = 1;
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

const char* const kTree = "#n = 3; #w : A; #p : A : * : F [ + A ] F A;";

} // namespace

TEST_CASE("the pipeline grows and meshes a plant from a file in memory") {
    const Project project = project_of({{"tree.lsys", kTree}});
    Outcome<Grammar> grammar = load_grammar("tree.lsys", {}, project);
    REQUIRE(grammar);
    PlantOptions options;
    options.file = "tree.lsys";
    Outcome<Plant> plant = grow_plant(options, grammar.value(), project);
    REQUIRE(plant);
    CHECK(plant.value().generations == 3);
    CHECK(plant.value().skeleton.segments.size() == 14);
    const Outcome<Mesh> mesh = mesh_plant(plant.value(), plant.value().skeleton, {}, project);
    REQUIRE(mesh);
    CHECK_FALSE(mesh.value().positions.empty());
}

TEST_CASE("the error of the pipeline has the reason if there is no plant") {
    Project project = project_of({{"tree.lsys", kTree}, {"bad.lsys", "#n = 3; #w : F"}});
    const Outcome<Grammar> missing = load_grammar("none.lsys", {}, project);
    REQUIRE_FALSE(missing);
    CHECK(missing.stop() == Stop::Failed);
    CHECK(missing.messages().all().at(0).text ==
          "cannot read `none.lsys`: no such file or directory");
    const Outcome<Grammar> bad = load_grammar("bad.lsys", {}, project);
    REQUIRE_FALSE(bad);
    CHECK(bad.stop() == Stop::Diagnosed);
    CHECK(bad.messages().has_errors());

    Outcome<Grammar> grammar = load_grammar("tree.lsys", {}, project);
    REQUIRE(grammar);
    project.limits.max_modules = 10;
    CHECK(grow_plant({}, grammar.value(), project).stop() == Stop::Limit);
    project.limits = {};
    const std::atomic<bool> cancelled{true};
    project.host.cancelled = &cancelled;
    CHECK(grow_plant({}, grammar.value(), project).stop() == Stop::Cancelled);
}

TEST_CASE("parsing, checking and compiling can be cancelled") {
    const auto repeated = [](const std::string& piece, int count) {
        std::string text;
        for (int i = 0; i < count; ++i) {
            text += piece;
        }
        return text;
    };
    std::string doubled = "#n = 1;\n#function f0(x) x + 1;\n"; // f16 expands to 65,536 additions
    for (int i = 1; i <= 16; ++i) {
        const std::string call = "f" + std::to_string(i - 1) + "(x)";
        doubled += "#function f" + std::to_string(i) + "(x) " + call + " + " + call + ";\n";
    }
    doubled += "#w : F(1);\n" + repeated("#p : A(x) : x > 1 : F(f16(x));\n", 30);
    const std::string cases[] = {
        "#n = 1; #w : F" + repeated("(1) F [ + F ]", 2'000'000) + ";",
        "#n = 1; #w : F(1" + repeated(" + 1", 2'000'000) + ");",
        "#n = 1; #w : A(1);\n" + repeated("#p : A(x) : x > 1 : F(x) B(x, x);\n", 500'000),
        "#n = 1; #w : A(1); #p : A(x) : x > 0" + repeated(" && x > 1", 200'000) + " : F(x);",
        doubled,
        repeated("#p : A : * : F;;\n", 500'000)};
    for (const std::string& text : cases) {
        CAPTURE(text.substr(0, 40));
        for (const int milliseconds : {0, 30, 200, 600}) {
            Project project = project_of({{"long.lsys", text}});
            std::atomic<bool> cancelled{false};
            project.host.cancelled = &cancelled;
            std::chrono::steady_clock::time_point begin;
            std::thread other([&] {
                std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
                begin = std::chrono::steady_clock::now();
                cancelled = true;
            });
            const Outcome<Grammar> grammar = load_grammar("long.lsys", {}, project);
            const auto end = std::chrono::steady_clock::now();
            other.join();
            CHECK((grammar.ok() || grammar.stop() != Stop::Cancelled ||
                   end - begin < std::chrono::seconds(2))); // about 0.1 s on an idle machine
            if (milliseconds == 0) {
                CHECK((!grammar.ok() && grammar.stop() == Stop::Cancelled));
            }
        }
    }
}

TEST_CASE("no method makes a mesh of a plant that is too large") {
    for (const char* const axiom : {"!(3e38) F(1)", "F(3e38) F(1)", "f(1e20) F(1)"}) {
        CAPTURE(axiom);
        const Project project =
            project_of({{"large.lsys", "#n = 0; #w : " + std::string(axiom) + ";"}});
        Outcome<Grammar> grammar = load_grammar("large.lsys", {}, project);
        REQUIRE(grammar);
        const Outcome<Plant> plant = grow_plant({}, grammar.value(), project);
        REQUIRE(plant);
        for (const MeshMethod method :
             {MeshMethod::Tubes, MeshMethod::Cylinders, MeshMethod::Boxes, MeshMethod::Solid}) {
            MeshOptions options;
            options.method = method;
            const Outcome<Mesh> mesh =
                mesh_plant(plant.value(), plant.value().skeleton, options, project);
            REQUIRE_FALSE(mesh);
            CHECK(mesh.messages().all().at(0).text ==
                  "the plant is too large for a mesh: its coordinates, lengths and radii are at "
                  "most 1e+15 m");
        }
    }
}

TEST_CASE("the error of the pipeline has the reason if there is no mesh") {
    Project project = project_of({{"tree.lsys", kTree}});
    Outcome<Grammar> grammar = load_grammar("tree.lsys", {}, project);
    REQUIRE(grammar);
    const Outcome<Plant> plant = grow_plant({}, grammar.value(), project);
    REQUIRE(plant);
    project.limits.max_bytes = 100;
    const Outcome<Mesh> mesh = mesh_plant(plant.value(), plant.value().skeleton, {}, project);
    REQUIRE_FALSE(mesh);
    CHECK(mesh.stop() == Stop::Limit);
    const auto message_of = [](const Messages& messages) {
        const Message& message = messages.all().at(0);
        return message.diagnostics.all().empty() ? message.text
                                                 : message.diagnostics.all()[0].message;
    };
    CHECK(message_of(mesh.messages()) == "the mesh does not fit into 100 B");

    Step missing(project);
    Outcome<void> ended = missing.end_too_large(Stop::OutOfMemory, "the mesh");
    CHECK(ended.stop() == Stop::OutOfMemory);
    CHECK(message_of(ended.messages()) == "the system has no memory for the mesh");

    Step heroes(project);
    ended = end_mesh_of_heroes(Stop::Limit, heroes);
    CHECK(ended.stop() == Stop::Limit);
    CHECK(message_of(ended.messages()) == "the mesh of the heroes does not fit into 100 B");
    Step many(project);
    ended = end_mesh_of_heroes(Stop::Failed, many);
    CHECK(ended.stop() == Stop::Failed);
    CHECK(message_of(ended.messages()) ==
          "the heroes have more than 4,294,967,295 vertices; ask for fewer --heroes, --sides or "
          "generations");
}

TEST_CASE("the pipeline grows a forest of one grammar and places its trees") {
    const Project project = project_of({{"tree.lsys", kTree}});
    const Outcome<LoadedScene> loaded = load_scene({"tree.lsys"}, {}, project);
    REQUIRE(loaded);
    Outcome<GrownForest> grown = grow_species(loaded.value(), project, {});
    REQUIRE(grown);
    REQUIRE(place_forest(loaded.value().scene, project, grown.value()));
    CHECK(grown.value().forest.trees.size() == 1000);
    CHECK(grown.value().forest.species.at(0).stages.at(0).cache.heroes == 10);
}

namespace {

const char* const kShrub = "#n = 4; #w : A; #p : A : ~ 0.6 : F(3) [ +(30) A ] [ &(50) A ] A;"
                           "#q : A : ~ 0.4 : F A;";

/// The forest of a scene with one species. `species`: lines of its table.
Outcome<GrownForest> forest_of(const std::string& grammar,
                               const std::string& species,
                               const SceneOverrides& overrides = {}) {
    const Project project =
        project_of({{"a.lsys", grammar},
                    {"a.toml", "[terrain]\nkind = \"flat\"\nsize = [40, 40]\n[placement]\nmethod = "
                               "\"jittered\"\nspacing = 2\n[[species]]\ngrammar = \"a.lsys\"\n" +
                                   species}});
    Outcome<LoadedScene> loaded = load_scene({"a.toml"}, overrides, project);
    REQUIRE(loaded);
    Outcome<GrownForest> grown = grow_species(loaded.value(), project, {});
    if (!grown) {
        return grown;
    }
    Outcome<void> placed = place_forest(loaded.value().scene, project, grown.value());
    if (!placed) {
        return {placed.stop(), placed.messages()};
    }
    return grown;
}

bool has_message(const Outcome<GrownForest>& outcome, const std::string& text) {
    const std::vector<Message>& all = outcome.messages().all();
    return std::any_of(all.begin(), all.end(), [&](const Message& message) {
        const std::vector<Diagnostic>& diagnostics = message.diagnostics.all();
        return std::any_of(diagnostics.begin(), diagnostics.end(),
                           [&](const Diagnostic& each) { return each.message == text; });
    });
}

/// Height of each tree, m, by its number.
std::map<std::uint32_t, double> heights_of(const GrownForest& grown) {
    std::map<std::uint32_t, double> heights;
    const InstanceCache& cache = grown.forest.species[0].stages.back().cache;
    const HeightTable table = make_height_table(cache);
    TreeMeasure measure(cache, table, grown.forest.key);
    for (const Tree& tree : grown.forest.trees) {
        heights[tree.number] =
            static_cast<double>(tree.scale) * measure.height_of(tree.number).value_or(0.0);
    }
    return heights;
}

} // namespace

TEST_CASE("heights of a species are uniformly distributed and the same in tiles") {
    const Outcome<GrownForest> whole = forest_of(kShrub, "height = [4, 9]\n");
    REQUIRE(whole);
    const std::map<std::uint32_t, double> heights = heights_of(whole.value());
    CHECK(heights.size() == 400);
    double sum = 0.0;
    for (const auto& [number, height] : heights) {
        CHECK(height > 4.0 - 1e-5);
        CHECK(height < 9.0 + 1e-5);
        sum += height;
    }
    // 400 uniform draws: the standard deviation of the mean is 5 / sqrt(12 * 400) = 0.07.
    CHECK(sum / 400.0 == Approx(6.5).margin(0.3));
    // A height uses the random number that a scale would use.
    const Outcome<GrownForest> scaled = forest_of(kShrub, "scale = [4, 9]\n");
    REQUIRE(scaled);
    for (const Tree& tree : scaled.value().forest.trees) {
        CHECK(heights.at(tree.number) == Approx(tree.scale).epsilon(1e-5));
    }
    SceneOverrides tile;
    tile.tile = ForestTile{0, 1, 20.0};
    const Outcome<GrownForest> part = forest_of(kShrub, "height = [4, 9]\n", tile);
    REQUIRE(part);
    CHECK(part.value().forest.trees.size() == 100);
    for (const Tree& tree : part.value().forest.trees) {
        const auto& all = whole.value().forest.trees;
        CHECK(std::any_of(all.begin(), all.end(), [&](const Tree& each) {
            return each.number == tree.number && each.scale == tree.scale;
        }));
    }
}

TEST_CASE("trees have the height of their grammar, times their scale") {
    const Outcome<GrownForest> grown =
        forest_of(std::string("#set height 20;") + kShrub, "scale = [0.5, 0.5]\n");
    REQUIRE(grown);
    for (const auto& [number, height] : heights_of(grown.value())) {
        CHECK(height == Approx(10.0).epsilon(1e-5));
    }
    // Painted trees have their own scale; at scale 1 a tree has the height of the grammar.
    const InstanceCache& cache = grown.value().forest.species[0].stages[0].cache;
    const HeightTable table = make_height_table(cache);
    CHECK(TreeMeasure(cache, table, 0).height_of(0).value_or(0.0) == Approx(20.0).epsilon(1e-5));
    // The height of the scene overrides that of the grammar.
    const Outcome<GrownForest> other =
        forest_of(std::string("#set height 20;") + kShrub, "height = [3, 3]\n");
    REQUIRE(other);
    for (const auto& [number, height] : heights_of(other.value())) {
        CHECK(height == Approx(3.0).epsilon(1e-5));
    }
}

TEST_CASE("species without height are not scaled") {
    const char* const flat = "#n = 2; #w : +(90) A; #p : A : * : F A;";
    const Outcome<GrownForest> scene = forest_of(flat, "height = [1, 2]\n");
    REQUIRE_FALSE(scene);
    CHECK(scene.stop() == Stop::Failed);
    const char* const message = "a: its plants are flat, so they cannot be given a height";
    CHECK(has_message(scene, message));
    const Outcome<GrownForest> grammar = forest_of(std::string("#set height 3;") + flat, "");
    REQUIRE_FALSE(grammar);
    CHECK(grammar.stop() == Stop::Diagnosed);
    CHECK(has_message(grammar, message));
    CHECK(forest_of(flat, ""));
}

TEST_CASE("heroes that share no branch have the widths of the pipe model") {
    const std::string piped = std::string("#set pipe 2 0.1;") + kShrub;
    const Outcome<GrownForest> shared = forest_of(piped, "");
    REQUIRE_FALSE(shared);
    CHECK(has_message(shared, "the pipe model cannot be used with instanced branches"));
    const Outcome<GrownForest> grown = forest_of(piped, "rho = 0\nheroes = 3\n");
    REQUIRE(grown);
    const Skeleton& heroes = grown.value().forest.species[0].stages[0].cache.skeleton;
    std::vector<double> sums(heroes.segments.size(), 0.0);
    for (std::size_t i = heroes.segments.size(); i-- > 0;) {
        const double width = 2.0 * static_cast<double>(heroes.segments[i].base_radius);
        CHECK(width * width == Approx(sums[i] == 0.0 ? 0.01 : sums[i]).epsilon(1e-5));
        if (heroes.segments[i].parent != kNoSegment) {
            sums[heroes.segments[i].parent] += width * width;
        }
    }
}

TEST_CASE("a plant gets the height of its grammar or of its options") {
    const Project project = project_of({{"a.lsys", "#n = 0; #set height 6; #w : F(2) F;"}});
    PlantOptions options;
    for (const float height : {6.0F, 15.0F}) {
        Outcome<Grammar> grammar = load_grammar("a.lsys", {}, project);
        REQUIRE(grammar);
        if (height != 6.0F) {
            options.height = height;
        }
        const Outcome<Plant> plant = grow_plant(options, grammar.value(), project);
        REQUIRE(plant);
        CHECK(height_of(plant.value().skeleton) == Approx(height));
    }
}

TEST_CASE("a constant is described by the comment after it, its value and its range") {
    const Project project =
        project_of({{"plant.lsys", "#n = 1;\n"
                                   "#param lean 0.5 {0, 2};   //  lean, 0: straight  \r\n"
                                   "#define a 3; #define b 4; // two statements\n"
                                   "#define c 1e-3;\n"
                                   "#define r {0, 1}; //\n"
                                   "#w : F(lean + a + b + c + r);\n"}});
    const Outcome<Grammar> grammar = load_grammar("plant.lsys", {}, project);
    REQUIRE(grammar);
    const auto text = [&](std::string_view name, bool is_replaced = false) {
        for (const Constant& constant : grammar.value().program->constants) {
            if (grammar.value().names.text(constant.name) == name) {
                return describe_constant(constant, grammar.value(), is_replaced);
            }
        }
        return std::string("?");
    };
    CHECK(text("lean") == "lean, 0: straight\n0.5 in the file; from 0 to 2");
    CHECK(text("a") == "3 in the file");
    CHECK(text("a", true) == "3 instead of the value in the file");
    CHECK(text("b") == "two statements\n4 in the file");
    CHECK(text("c") == "0.001 in the file");
    CHECK(text("r") == "random in each run");
}

TEST_CASE("a season sets the constant of grammars that have one") {
    const char* const kSeasonal = "#n = 1; #param season 0.5 {0, 1}; #w : F(1 + season);";
    const auto height_of = [](const std::string& grammar, const std::string& species,
                              const SceneOverrides& overrides) {
        const Outcome<GrownForest> grown = forest_of(grammar, species, overrides);
        REQUIRE(grown);
        return heights_of(grown.value()).begin()->second;
    };
    SceneOverrides autumn;
    autumn.season = 0.75F;
    CHECK(height_of(kSeasonal, "", {}) == Approx(1.5));
    CHECK(height_of(kSeasonal, "", autumn) == Approx(1.75));
    CHECK(height_of(kSeasonal, "define = { season = 0.25 }\n", autumn) == Approx(1.25));
    CHECK(height_of("#n = 1; #w : F(1);", "", autumn) == Approx(1.0));
}
