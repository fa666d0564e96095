#include "viewer/app/plant_document.h"

#include <chrono>

namespace lsys::view {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

} // namespace

lsc::Status make_plant_document(const ViewOptions& options,
                                const lsc::Console& console,
                                PlantDocument& document) {
    Clock::time_point start = Clock::now();
    lsc::Status status =
        lsc::load_grammar(options.file, options.grammar, console, document.grammar);
    if (status != lsc::Status::Fine) {
        return status;
    }
    document.load_seconds = seconds_since(start);
    lsc::PlantRequest request;
    request.file = options.file;
    request.generations = options.grammar.generations;
    request.seed = options.seed;
    request.threads = options.threads;
    request.max_modules = options.grammar.max_modules;
    request.max_bytes = options.max_bytes;
    status = lsc::grow_plant(request, document.grammar, console, document.plant);
    if (status != lsc::Status::Fine) {
        return status;
    }
    start = Clock::now();
    MeshOptions mesh = options.mesh;
    mesh.threads = options.threads;
    mesh.max_bytes = options.max_bytes;
    status = lsc::mesh_plant(document.plant, document.plant.skeleton, mesh, document.grammar,
                             console, document.mesh);
    document.mesh_seconds = seconds_since(start);
    return status;
}

} // namespace lsys::view
