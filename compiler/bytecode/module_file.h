// Bytecode as bytes: the .lsb file. Little-endian, with magic, version, sizes and a checksum; the
// .cpp draws the layout. Reading checks everything, ends with verify(), and never trusts a size.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "grammar/base/result.h"

#include <string>
#include <string_view>

namespace lsys {

inline constexpr std::uint32_t kModuleFileVersion = 4;

[[nodiscard]] std::string write_module_file(const Bytecode& bytecode);
/// Refuses, each with its own message: a foreign file, a newer or older version, a truncated one, a
/// checksum that does not fit, and contents that do not verify. The message does not name the file.
[[nodiscard]] Result<Bytecode> read_module_file(std::string_view bytes);
/// Whether these bytes begin like a .lsb file.
[[nodiscard]] bool is_module_file(std::string_view bytes);
/// Makes head, size and checksum fit whatever contents follow, so that tests reach what lies behind
/// them.
void seal_module_file(std::string& bytes);

} // namespace lsys
