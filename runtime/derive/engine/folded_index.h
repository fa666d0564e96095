// SPDX-License-Identifier: MIT
// FoldedIndex: finds the folded modules of a program by symbol and arguments.
#pragma once

#include "compiler/bytecode/bytecode.h"

#include <cstdint>
#include <unordered_map>

namespace lsys {

class FoldedIndex {
public:
    /// `bytecode` must outlive the index. Modules folded later are added by add().
    explicit FoldedIndex(const Bytecode& bytecode);

    /// The code of the module with these arguments, one per parameter of the symbol, compared bit
    /// by bit; kNone if it is not folded.
    [[nodiscard]] Code find(SymbolId symbol, const float* arguments) const;
    /// Adds a folded module.
    void add(Code code);

private:
    [[nodiscard]] std::uint64_t hash(SymbolId symbol, const float* arguments) const;
    [[nodiscard]] const float* constants_of(Code code) const;

    const Bytecode& bytecode_;
    std::unordered_multimap<std::uint64_t, Code> codes_; // by hash()
};

} // namespace lsys
