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
    std::vector<UserMesh> meshes; // in the order of the MeshFile symbols
    std::vector<float> lengths;   // extent along +Y, by symbol; empty if there are no meshes
};

/// Reads the mesh files, whose paths are relative to `grammar_file` or absolute. A picture that is
/// missing or cannot be shown is left out with a warning at its place. `budget` counts the memory.
[[nodiscard]] Outcome<MeshFiles> read_mesh_files(const std::string& grammar_file,
                                                 const Bytecode& bytecode,
                                                 const Project& project,
                                                 FileBudget& budget);

} // namespace lsys
