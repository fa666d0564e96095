// SPDX-License-Identifier: MIT
// The meshes and pictures that `#sense` statements name.
#pragma once

#include "grammar/base/outcome.h"
#include "runtime/environment/environment.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/pipeline/impl/file_budget.h"
#include "runtime/pipeline/project.h"

#include <filesystem>
#include <vector>

namespace lsys {

/// Reads all of them, by index in Bytecode::environments. `folder`: of the grammar. Errors at the
/// name of a file that is missing, cannot be read, has no face or, for a shape of markers, is open.
[[nodiscard]] Outcome<std::vector<EnvironmentFiles>>
read_environment_files(const std::filesystem::path& folder,
                       const Grammar& grammar,
                       const Project& project,
                       FileBudget& budget);

} // namespace lsys
