// SPDX-License-Identifier: MIT
#include "viewer/app/plant_document.h"

#include "runtime/pipeline/step.h"
#include "runtime/pipeline/stopwatch.h"
#include "runtime/turtle/plant_size.h"

#include <fmt/format.h>

#include <utility>

namespace lsys::view {

namespace {

/// Adds a note if the plant has neither triangles nor lines, so that the picture is empty.
void report_nothing_to_draw(const PlantDocument& document,
                            const ViewOptions& options,
                            Messages& messages) {
    if (!document.mesh.indices.empty() || measure(document.plant.skeleton).length > 0.0) {
        return;
    }
    const std::uint32_t generations =
        options.grammar.generations.value_or(document.grammar.bytecode.generations.value_or(0));
    messages.add_info(fmt::format("the plant has nothing to draw after {} generation{}",
                                  generations, generations == 1 ? "" : "s"));
    messages.add_help("`-n N` sets the number of generations; `lsc dump` prints the word");
}

} // namespace

Outcome<std::shared_ptr<const PlantDocument>> make_plant_document(const ViewOptions& options,
                                                                  const Project& project) {
    Step step(project);
    const auto document = std::make_shared<PlantDocument>();
    const Stopwatch loading;
    if (!step.take(load_grammar(options.file, options.grammar, project), document->grammar)) {
        return step.end();
    }
    document->load_seconds = loading.seconds();
    if (project.is_cancelled()) {
        return step.end(Stop::Cancelled);
    }
    PlantOptions plant;
    plant.file = options.file;
    plant.generations = options.grammar.generations;
    plant.seed = options.seed;
    plant.height = options.plant_height;
    plant.senses = true;
    if (!step.take(grow_plant(plant, document->grammar, project), document->plant)) {
        return step.end();
    }
    if (project.is_cancelled()) {
        return step.end(Stop::Cancelled);
    }
    document->height = height_of(document->plant.skeleton);
    const Stopwatch meshing;
    if (!step.take(mesh_plant(document->plant, document->plant.skeleton, options.mesh, project),
                   document->mesh)) {
        return step.end();
    }
    document->mesh_seconds = meshing.seconds();
    report_nothing_to_draw(*document, options, step.messages);
    return step.done<std::shared_ptr<const PlantDocument>>(document);
}

} // namespace lsys::view
