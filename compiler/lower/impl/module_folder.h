// SPDX-License-Identifier: MIT
// Assigns codes to modules with constant arguments, in order of first appearance and as long as the
// width of a code does not grow.
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
    /// Program::arguments[first_argument]: a folded module if all arguments are finite constants,
    /// neither sensing nor a sweep changes them, and a code is free; else the symbol.
    [[nodiscard]] Code code(SymbolId symbol, std::size_t first_argument);

private:
    const Program& program_;
    Bytecode& bytecode_;
    std::vector<bool> changes_; // by symbol: whether answers or sweeps change its parameters
    std::uint64_t capacity_;    // max number of codes
    std::unordered_map<std::string, Code> codes_; // keys are the bytes of symbol and constants
    std::string key_;                             // scratch of code()
    std::string last_key_; // key of the last module: a cache, since long axioms repeat one module
    Code last_code_ = 0;
};

} // namespace lsys
