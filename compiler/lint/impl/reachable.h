// SPDX-License-Identifier: MIT
// The modules that can occur in a word and the productions that can be used, decided from names,
// numbers of parameters and contexts. Conditions count as true unless they are the constant 0, so
// modules that are not reachable here never occur.
#pragma once

#include "compiler/program/program.h"

#include <cstdint>
#include <vector>

namespace lsys {

struct Reachable {
    /// Per symbol: the first generation in which it can occur, or kNone if it never occurs. 0 with
    /// sequential rewriting, #decompose or #interpret, where the first generation is not known.
    std::vector<std::uint32_t> generation;
    /// Per production: whether it can be used.
    std::vector<bool> usable;

    [[nodiscard]] bool occurs(SymbolId symbol) const {
        return generation[static_cast<std::size_t>(symbol)] != kNone;
    }
};

/// Finds the symbols that can occur and the productions that can be used.
[[nodiscard]] Reachable find_reachable(const Program& program);

} // namespace lsys
