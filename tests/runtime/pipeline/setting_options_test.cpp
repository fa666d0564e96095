// SPDX-License-Identifier: MIT
#include "compiler/bytecode/module_file.h"
#include "runtime/pipeline/forest.h"
#include "runtime/pipeline/setting_options.h"
#include "runtime/pipeline/value_edits.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <map>
#include <string>
#include <vector>

namespace lsys {

namespace {

Project setting_project(std::map<std::string, std::string> files) {
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

FileLoader no_files() {
    return [](const std::string& path) -> Result<std::string> { return Error{path}; };
}

/// The .lsb of a text, with settings from options; empty: it has errors.
std::string compiled_with(const std::string& text, const std::vector<SettingText>& settings) {
    GrammarOptions options;
    options.settings = settings;
    const Outcome<Grammar> grammar =
        load_grammar("a.lsys", options, setting_project({{"a.lsys", text}}));
    return grammar ? write_module_file(grammar.value().bytecode) : std::string();
}

/// For each key of the table, a value that differs from the default.
std::vector<SettingText> one_of_each() {
    std::vector<SettingText> settings{
        {"tropism", "0.5 -1 0 0.2"}, {"seed", "18446744073709551615"}, {"names", "letters"}};
#define LSYS_CHOICE(type, field, initial, effect, group)                                           \
    for (const type value : enumerators_of<type>()) {                                              \
        if (value != type::initial) {                                                              \
            settings.push_back({#field, std::string(name_of(value))});                             \
        }                                                                                          \
    }
#define LSYS_NUMBER(field, initial, effect, group, min, wanted)                                    \
    settings.push_back({#field, "3.25"});
#define LSYS_COUNT(field, initial, effect, group, min, max, wanted, misfit)                        \
    settings.push_back({#field, "7"});
#include "compiler/bytecode/settings.def"
    return settings;
}

} // namespace

TEST_CASE("a setting given by an option compiles to the same bytes as one in the file") {
    const std::string plain = "#n = 3;\n#define a 2;\n#w : FF;\n#f : F : ~ 1 : F + F;\n";
    const std::string plain_bytes = compiled_with(plain, {});
    REQUIRE_FALSE(plain_bytes.empty());
    for (const SettingText& setting : one_of_each()) {
        CAPTURE(setting.key, setting.values);
        const Result<std::string> written =
            with_values("a.lsys", plain, {{}, {}, {setting}}, no_files());
        REQUIRE(written);
        // Replace the statement by a comment, so that all other statements keep their places.
        std::string commented = written.value();
        commented.replace(commented.find("#set"), 2, "//");
        const std::string by_option = compiled_with(commented, {setting});
        REQUIRE_FALSE(by_option.empty());
        CHECK(by_option == compiled_with(written.value(), {}));
        // An option overrides the value of the file.
        const Result<std::string> again =
            with_values("a.lsys", written.value(), {{}, {}, {setting}}, no_files());
        REQUIRE(again);
        CHECK(again.value() == written.value());
        CHECK(compiled_with(written.value(), {setting}) == by_option);
    }
}

TEST_CASE("an option replaces the setting of a file, and may use its constants") {
    const std::string text = "#n = 1;\n#set angle 20;\n#w : F + F;\n#define a 12.5;\n";
    GrammarOptions options;
    options.settings = {{"angle", "(2 * a)"}};
    const Outcome<Grammar> grammar =
        load_grammar("a.lsys", options, setting_project({{"a.lsys", text}}));
    REQUIRE(grammar);
    CHECK(grammar.value().bytecode.settings.angle == 25.0F);
    CHECK(grammar.value().program->settings.angle == 25.0F);
}

TEST_CASE(
    "options can change only those settings of a compiled grammar that do not affect its code") {
    const std::string text = "#n = 1;\n#set angle 20;\n#w : F + F;\n";
    const Project project = setting_project({{"a.lsb", compiled_with(text, {})}});
    for (const SettingText& setting : one_of_each()) {
        CAPTURE(setting.key, setting.values);
        GrammarOptions options;
        options.settings = {setting};
        const Outcome<Grammar> grammar = load_grammar("a.lsb", options, project);
        const bool is_mode = setting.key == "turtle" || setting.key == "names" ||
                             setting.key == "rewriting" || setting.key == "choice" ||
                             setting.key == "weights" || setting.key == "random";
        CHECK(static_cast<bool>(grammar) == !is_mode);
        if (grammar) {
            CHECK(write_module_file(grammar.value().bytecode) == compiled_with(text, {setting}));
        } else {
            CHECK(grammar.stop() == Stop::Failed);
        }
    }
}

TEST_CASE("settings given by options apply to all species of a scene") {
    const Project project =
        setting_project({{"a.lsys", "#n = 1; #w : F;"}, {"b.lsys", "#n = 1; #w : F;"}});
    SceneOverrides overrides;
    overrides.grammar.settings = {{"width", "0.25"}};
    Outcome<LoadedScene> scene = load_scene({"a.lsys", "b.lsys"}, overrides, project);
    REQUIRE(scene);
    overrides.grammar.settings = {{"width", "0.5"}};
    REQUIRE(apply(overrides, scene.value().scene));
    for (const SceneSpecies& species : scene.value().scene.species) {
        REQUIRE(species.settings.size() == 1);
        CHECK(species.settings[0] == std::pair<std::string, std::string>("width", "0.5"));
    }
    overrides.grammar.settings = {{"width", "-1"}};
    REQUIRE(apply(overrides, scene.value().scene));
    const Outcome<GrownForest> grown = grow_species(scene.value(), project, {});
    REQUIRE_FALSE(grown);
    CHECK(grown.stop() == Stop::Diagnosed);
    overrides.grammar.settings = {{"seed", "1"}};
    CHECK(load_scene({"a.lsys"}, overrides, project).stop() == Stop::Failed);
}

TEST_CASE("options are split at the first equals sign") {
    REQUIRE(parse_setting(" tropism = 0 -1 0 0.2 "));
    CHECK(parse_setting(" tropism = 0 -1 0 0.2 ").value() == SettingText{"tropism", "0 -1 0 0.2"});
    CHECK(parse_setting("a==1").value() == SettingText{"a", "=1"});
    CHECK_FALSE(parse_setting("angle"));
    CHECK_FALSE(parse_setting("=1"));
    CHECK_FALSE(parse_setting("a b=1"));
}

} // namespace lsys
