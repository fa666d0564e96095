// SPDX-License-Identifier: MIT
// The meshes and pictures that `#sense` statements name.
#pragma once

#include "grammar/base/diagnostic.h"
#include "runtime/environment/environment.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/pipeline/impl/file_budget.h"
#include "runtime/pipeline/project.h"

#include <filesystem>
#include <optional>
#include <vector>

namespace lsys {

/// Reads all of them, by index in Bytecode::environments. `folder`: of the grammar. Errors at the
/// name of a file that is missing, cannot be read, has no face or, for a shape of markers, is open;
/// no value after an error.
[[nodiscard]] std::optional<std::vector<EnvironmentFiles>>
read_environment_files(const std::filesystem::path& folder,
                       const Grammar& grammar,
                       const Project& project,
                       FileBudget& budget,
                       Diagnostics& diagnostics);

} // namespace lsys
