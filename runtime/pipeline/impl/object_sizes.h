// SPDX-License-Identifier: MIT
// Lengths and areas of objects, for SensingTurtle.
#pragma once

#include "grammar/base/outcome.h"
#include "runtime/pipeline/impl/file_budget.h"
#include "runtime/pipeline/project.h"
#include "runtime/turtle/sensing_turtle.h"

#include <filesystem>

namespace lsys {

/// Reads the files of `#object`; sets the members of SensingOptions about objects. `areas`: whether
/// the areas of LEAF and FLOWER are needed too.
[[nodiscard]] Outcome<SensingOptions> read_object_sizes(const std::filesystem::path& folder,
                                                        const Bytecode& bytecode,
                                                        bool areas,
                                                        const Project& project,
                                                        FileBudget& budget);

} // namespace lsys
