// SPDX-License-Identifier: MIT
#include "tests/support/sample_plants.h"

#include "runtime/program/host.h"

#include <stdexcept>
#include <utility>

namespace lsys::test {

namespace {

Project sample_project() {
    Project project;
    project.threads = 1;
    project.host = make_file_host(nullptr);
    return project;
}

} // namespace

lsys::Plant sample_plant(const std::string& name,
                         const std::vector<lsys::Definition>& definitions) {
    const Project project = sample_project();
    PlantOptions options;
    const std::string last = name.substr(name.rfind('/') + 1);
    options.file = std::string(LSYS_SOURCE_DIR) + "/samples/" + name + "/" + last + ".lsys";
    GrammarOptions grammar_options;
    grammar_options.definitions = definitions;
    Outcome<Grammar> grammar = load_grammar(options.file, grammar_options, project);
    if (!grammar) {
        throw std::runtime_error("a sample does not compile: " + name);
    }
    Outcome<lsys::Plant> plant = grow_plant(options, grammar.value(), project);
    if (!plant) {
        throw std::runtime_error("a sample does not grow: " + name);
    }
    return std::move(plant.value());
}

} // namespace lsys::test
