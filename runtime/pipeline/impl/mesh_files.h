// SPDX-License-Identifier: MIT
// The mesh files of `#object`, with the pictures that their material files name, and the pictures
// of `#material`.
#pragma once

#include "grammar/base/outcome.h"
#include "runtime/meshing/looks.h"
#include "runtime/meshing/mesh.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/pipeline/impl/file_budget.h"
#include "runtime/pipeline/project.h"

#include <memory>
#include <string>
#include <vector>

namespace lsys {

struct MeshFiles {
    std::vector<UserMesh> meshes; // meshes of the symbols with a file, in the order of symbols
    std::vector<float> lengths;   // lengths along +Y, by index of the symbol; empty without meshes
    std::shared_ptr<const Looks> looks; // looks of the `#material`s; null if there are none
};

/// Reads the mesh files and the pictures of materials, whose paths are absolute or relative to
/// `grammar_file`. A missing or invalid picture of a material is left out with a warning at its
/// place. `budget` counts the memory.
[[nodiscard]] Outcome<MeshFiles> read_mesh_files(const std::string& grammar_file,
                                                 const Grammar& grammar,
                                                 const Project& project,
                                                 FileBudget& budget);

} // namespace lsys
