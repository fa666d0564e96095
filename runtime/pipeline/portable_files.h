// SPDX-License-Identifier: MIT
// Names of the source files in compiled grammars.
#pragma once

#include "compiler/bytecode/bytecode.h"

namespace lsys {

/// Removes the folders of this machine from the source files of a grammar that is written into a
/// file: an absolute path becomes relative to the folder of the grammar, or loses its folder if it
/// lies elsewhere. The first file is the grammar; relative paths stay as they are.
void remove_machine_paths(Bytecode& bytecode);

} // namespace lsys
