// A random grammar as bytecode, compiled in memory.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "tests/reference/generate.h"

#include <optional>
#include <string>

namespace lsys::reference {

// `messages` gets what the compiler says.
std::optional<Bytecode> compile_case(const Case& made, std::string& messages);

} // namespace lsys::reference
