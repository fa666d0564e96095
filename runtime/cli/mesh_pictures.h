// The picture that a mesh of a file shows: from the OBJ over its file of materials to the PNG.
#pragma once

#include "runtime/cli/console.h"
#include "runtime/cli/file_budget.h"
#include "runtime/mesh.h"

#include <string>

namespace lsys::lsc {

/// Finds and reads the picture of `mesh`, which was read from `text`, the file `path`. What is
/// missing or cannot be shown is a warning at its place, and the mesh has no picture; what does not
/// fit into `budget` is an error there. Fine, unless warnings are errors. `budget` counts pictures
/// that are read, not `text` and `mesh`.
[[nodiscard]] Status read_mesh_picture(const std::string& path,
                                       const std::string& text,
                                       const Console& console,
                                       FileBudget& budget,
                                       UserMesh& mesh);

} // namespace lsys::lsc
