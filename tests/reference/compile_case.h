// SPDX-License-Identifier: MIT
// Compiles a random grammar to bytecode in memory.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "tests/reference/generate.h"

#include <optional>
#include <string>

namespace lsys::reference {

// Compiles a case. Appends the messages of the compiler to `messages`.
std::optional<Bytecode> compile_case(const Case& test_case, std::string& messages);

} // namespace lsys::reference
