#include "viewer/app/plant_document.h"

#include "runtime/cli/stopwatch.h"

#include <chrono>
#include <filesystem>

namespace lsys::view {

lsc::Status make_plant_document(const ViewOptions& options,
                                const lsc::Console& console,
                                PlantDocument& document) {
    lsc::Clock::time_point start = lsc::Clock::now();
    lsc::GrammarOptions grammar = options.grammar;
    grammar.max_bytes = options.max_bytes;
    lsc::Status status = lsc::load_grammar(options.file, grammar, console, document.grammar);
    if (status != lsc::Status::Fine) {
        return status;
    }
    document.load_seconds = lsc::seconds_since(start);
    if (console.interrupted()) {
        return lsc::Status::Interrupted;
    }
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
    if (console.interrupted()) {
        return lsc::Status::Interrupted;
    }
    start = lsc::Clock::now();
    MeshOptions mesh = options.mesh;
    mesh.threads = options.threads;
    mesh.max_bytes = options.max_bytes;
    status = lsc::mesh_plant(document.plant, document.plant.skeleton, mesh, document.grammar,
                             console, document.mesh);
    document.mesh_seconds = lsc::seconds_since(start);
    return status;
}

std::vector<std::string> files_of(const ViewOptions& options, const PlantDocument& document) {
    std::vector<std::string> files = {options.file};
    const std::vector<std::string>& included = document.grammar.included;
    files.insert(files.end(), included.begin(), included.end());
    if (document.grammar.bytecode) {
        const std::filesystem::path folder = std::filesystem::path(options.file).parent_path();
        for (const BytecodeSymbol& symbol : document.grammar.bytecode->symbols) {
            if (symbol.turtle == TurtleOperation::MeshFile) {
                files.push_back((folder / symbol.mesh_file).string());
            }
        }
    }
    for (const UserMesh& mesh : document.plant.user_meshes) {
        files.insert(files.end(), mesh.files.begin(), mesh.files.end());
    }
    return files;
}

} // namespace lsys::view
