// SPDX-License-Identifier: MIT
// A random grammar as bytecode, compiled in memory.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "tests/reference/generate.h"

#include <optional>
#include <string>

namespace lsys::reference {

// Appends the compiler's messages to `messages`.
std::optional<Bytecode> compile_case(const Case& test_case, std::string& messages);

} // namespace lsys::reference
