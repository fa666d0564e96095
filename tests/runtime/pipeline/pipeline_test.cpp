// The pipeline as a library: files come from memory, results are values.
#include "runtime/pipeline/forest.h"
#include "runtime/pipeline/plant.h"

#include <catch2/catch.hpp>

#include <atomic>
#include <map>
#include <string>
#include <utility>

using namespace lsys;

namespace {

/// A project whose files are those of `files`.
Project project_of(std::map<std::string, std::string> files) {
    Project project;
    project.threads = 1;
    project.host.read_file = [files](const std::string& path,
                                     const ReadLimit& /*limit*/) -> Result<std::string> {
        const auto at = files.find(path);
        return at != files.end() ? Result<std::string>(at->second)
                                 : Error{"no such file or directory"};
    };
    project.host.read_named_file = project.host.read_file;
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

TEST_CASE("the pipeline says why there is no plant") {
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

TEST_CASE("the pipeline says why there is no mesh") {
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
