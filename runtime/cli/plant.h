// From a compiled grammar to a skeleton: derives, draws, tells what went wrong on the way.
#pragma once

#include "runtime/cli/console.h"
#include "runtime/cli/file_budget.h"
#include "runtime/cli/grammar_file.h"
#include "runtime/cli/options.h"
#include "runtime/derive.h"
#include "runtime/mesh.h"
#include "runtime/skeleton.h"
#include "runtime/turtle.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lsys::lsc {

struct PlantRequest {
    std::string file; // the grammar's path: files of `#object` lie beside it
    std::optional<std::uint32_t> generations;
    std::optional<std::uint64_t> seed;
    std::uint32_t threads = 0;
    std::uint64_t max_modules = 0;
    std::uint64_t max_bytes = 0;
    bool stream = false;  // store no word
    bool origins = false; // of what is drawn
};

/// What a command that draws asks for.
template <typename Command>
[[nodiscard]] PlantRequest plant_request(const Command& command) {
    PlantRequest request;
    request.file = command.file;
    request.generations = command.grammar.generations;
    request.seed = command.seed;
    request.threads = command.threads;
    request.max_modules = command.grammar.max_modules;
    request.max_bytes = command.max_bytes;
    request.stream = command.stream;
    return request;
}

/// A plant and how long its making took.
struct Plant {
    Skeleton skeleton;
    std::vector<UserMesh> user_meshes; // of skeleton.mesh_files
    std::uint64_t modules = 0;
    std::uint32_t generations = 0;
    std::uint64_t seed = 0;
    double derive_seconds = 0.0; // with drawing, where no word is stored
    double draw_seconds = 0.0;
};

/// Shows the turtle's faults, and what ended it.
[[nodiscard]] Status tell_drawn(TurtleStatus status,
                                const std::array<TurtleFault, kTurtleFaultKinds>& faults,
                                std::uint64_t max_bytes,
                                const Grammar& grammar,
                                const Console& console);

/// Reads the mesh files of `#object`, which lie beside the grammar unless their path is absolute.
/// `lengths` are those of the symbols. Fine: all are there, but pictures may be missing. `budget`
/// counts what is read.
[[nodiscard]] Status read_user_meshes(const std::string& grammar_file,
                                      const Bytecode& bytecode,
                                      const Console& console,
                                      FileBudget& budget,
                                      std::vector<UserMesh>& meshes,
                                      std::vector<float>& lengths);

/// Folds what a derivation from the axiom can reach: grammar.bytecode becomes a program that
/// derives the same words faster, with codes of its own.
void fold_modules(const DeriveOptions& options, Grammar& grammar);

/// Fine: the plant is there.
[[nodiscard]] Status
grow_plant(const PlantRequest& request, Grammar& grammar, const Console& console, Plant& plant);

/// Meshes a skeleton of the plant, bent or not, and tells what does not fit.
[[nodiscard]] Status mesh_plant(const Plant& plant,
                                const Skeleton& skeleton,
                                const MeshOptions& options,
                                const Grammar& grammar,
                                const Console& console,
                                Mesh& mesh);

} // namespace lsys::lsc
