// Origin: where a module of a word comes from. A module has its origin from the axiom or the
// production that wrote it, and keeps it until it is rewritten. Made with a word where it is asked
// for (DeriveOptions::origins), handed on by the turtle to what it draws.
#pragma once

#include "compiler/bytecode/bytecode.h"

#include <cstdint>
#include <string>
#include <vector>

namespace lsys {

struct Origin {
    /// In Bytecode::template_codes: the module of the axiom or of a successor that it was written
    /// as. kNone: not known, it was there when a saved derivation went on.
    std::uint32_t place = kNone;
    /// The age of the first word that holds it; of an unknown origin the age of the saved word.
    std::uint32_t generation = 0;

    friend bool operator==(const Origin&, const Origin&) = default;
};

/// Origins in words: "from p2 at tree.lsys:7:14, generation 3", without the place where the program
/// has none; "origin unknown, in the saved state of generation 2".
class OriginPrinter {
public:
    /// `bytecode` outlives the printer.
    explicit OriginPrinter(const Bytecode& bytecode) : bytecode_(bytecode) {}

    void append(const Origin& origin, std::string& text);

private:
    const Bytecode& bytecode_;
    std::vector<std::string> places_; // by place, those met so far; empty: not met
};

} // namespace lsys
