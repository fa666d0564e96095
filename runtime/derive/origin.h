// SPDX-License-Identifier: MIT
// Origin: the place in the program that wrote a module of a word. A module keeps its origin until
// it is rewritten. Derivations keep origins on request (DeriveOptions::origins); the turtle gives
// each segment, object and polygon the origin of the module that drew it.
#pragma once

#include "compiler/bytecode/bytecode.h"

#include <cstdint>
#include <string>
#include <vector>

namespace lsys {

/// Bit of Origin::generation of a followed module (Derivation::follow()): `place` is the index of a
/// module in the word that was followed, and all modules written for that module keep this index.
inline constexpr std::uint32_t kFollowed = 1U << 31;

struct Origin {
    /// Index in Bytecode::template_codes of the module of the axiom or successor. kNone: unknown,
    /// because the module was in the word of a saved state.
    std::uint32_t place = kNone;
    /// The age of the first word with the module; for an unknown origin, the age of the saved word.
    std::uint32_t generation = 0;

    friend bool operator==(const Origin&, const Origin&) = default;
};

/// Prints origins: "from p2 at tree.lsys:7:14, generation 3", without " at ..." if the program has
/// no sites; "origin unknown, in the saved state of generation 2".
class OriginPrinter {
public:
    /// Precondition: `bytecode` outlives the printer.
    explicit OriginPrinter(const Bytecode& bytecode) : bytecode_(bytecode) {}

    void append(const Origin& origin, std::string& text);

private:
    const Bytecode& bytecode_;
    std::vector<std::string> places_; // texts by place; empty: not printed yet
};

} // namespace lsys
