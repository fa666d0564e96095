// SPDX-License-Identifier: MIT
// The files that a grammar names, which no output may replace.
#pragma once

#include "compiler/bytecode/bytecode.h"

#include <string>
#include <vector>

namespace lsys {

/// Paths of the source files of a grammar, and of the meshes, maps and pictures that it
/// names. `file`:
/// path of the grammar, to whose folder the names are relative.
[[nodiscard]] std::vector<std::string> named_files(const Bytecode& bytecode,
                                                   const std::string& file);

} // namespace lsys
