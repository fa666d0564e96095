// The mesh files of `#object`, with the pictures that their material files name.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "grammar/base/outcome.h"
#include "runtime/meshing/mesh.h"
#include "runtime/pipeline/impl/file_budget.h"
#include "runtime/pipeline/project.h"

#include <string>
#include <vector>

namespace lsys {

struct MeshFiles {
    std::vector<UserMesh> meshes; // of the MeshFile symbols, in their order
    std::vector<float> lengths;   // along +Y, by symbol; empty where there are no meshes
};

/// Reads the mesh files, which lie beside `grammar_file` unless their path is absolute. Meshes
/// whose/// picture is missing or cannot be shown have none, which is a warning at its place.
/// `budget` counts the memory of all that is read.
[[nodiscard]] Outcome<MeshFiles> read_mesh_files(const std::string& grammar_file,
                                                 const Bytecode& bytecode,
                                                 const Project& project,
                                                 FileBudget& budget);

} // namespace lsys
