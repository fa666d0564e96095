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

/// Reads the files of all environments, by index in Bytecode::environments. `folder`: the folder of
/// the grammar. Reports, at the name of the file, files that are missing or cannot be read, meshes
/// without faces, and shapes of markers that are not closed; no value after such an error.
[[nodiscard]] std::optional<std::vector<EnvironmentFiles>>
read_environment_files(const std::filesystem::path& folder,
                       const Grammar& grammar,
                       const Project& project,
                       FileBudget& budget,
                       Diagnostics& diagnostics);

} // namespace lsys
