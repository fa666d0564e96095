// SPDX-License-Identifier: MIT
// Environments that the user moves, for example an obstacle that is dragged in a window.
#pragma once

#include "runtime/pipeline/grammar.h"

#include <vector>

namespace lsys {

/// Moves environments of the kinds Solid, Space and Map; other kinds have no place. For a Solid,
/// stores the displacement in `at`; read_environment_files() adds it to the meshes.
void move_environments(const std::vector<EnvironmentMove>& moves, Bytecode& bytecode);

} // namespace lsys
