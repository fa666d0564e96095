// SPDX-License-Identifier: MIT
// Environments that the user moves, for example an obstacle that is dragged in a window.
#pragma once

#include "runtime/pipeline/grammar.h"

#include <vector>

namespace lsys {

/// Moves environments of the kinds Solid, Space and Map; the other kinds have no place. `at` of a
/// Solid, 0 otherwise, is then the displacement of its meshes, which read_environment_files() adds.
void move_environments(const std::vector<EnvironmentMove>& moves, Bytecode& bytecode);

} // namespace lsys
