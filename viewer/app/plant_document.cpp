#include "viewer/app/plant_document.h"

#include "runtime/pipeline/step.h"
#include "runtime/pipeline/stopwatch.h"
#include "runtime/turtle/plant_size.h"

#include <utility>

namespace lsys::view {

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
    return step.done<std::shared_ptr<const PlantDocument>>(document);
}

} // namespace lsys::view
