// Gives modules with constant arguments codes of their own, in order of first appearance, as long
// as the width of a code does not grow for it.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "compiler/program/program.h"

#include <cstdint>
#include <string>
#include <unordered_map>

namespace lsys {

class ModuleFolder {
public:
    ModuleFolder(const Program& program, Bytecode& bytecode);

    /// The code for a module of `symbol` whose arguments begin at
    /// Program::arguments[first_argument]: a folded one if all are finite constants and there is
    /// room, else the symbol itself.
    [[nodiscard]] Code code(SymbolId symbol, std::size_t first_argument);

private:
    const Program& program_;
    Bytecode& bytecode_;
    std::uint64_t capacity_;                      // codes
    std::unordered_map<std::string, Code> codes_; // by the bytes of symbol and constants
    std::string key_;
    std::string last_key_; // long axioms repeat one module
    Code last_code_ = 0;
};

} // namespace lsys
