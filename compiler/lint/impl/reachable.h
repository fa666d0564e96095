// Which modules can occur in a word of the program and which productions can be used, as far as
// names, counts and contexts tell; conditions are taken to hold unless they are the constant 0.
// What is not reachable here never occurs.
#pragma once

#include "compiler/program/program.h"

#include <cstdint>
#include <vector>

namespace lsys {

struct Reachable {
    /// By symbol: the first generation it can occur in, or kNone. In sequential rewriting a lower
    /// bound does not exist, and it is 0.
    std::vector<std::uint32_t> generation;
    /// By production: whether it can be used.
    std::vector<bool> usable;

    [[nodiscard]] bool occurs(SymbolId symbol) const {
        return generation[static_cast<std::size_t>(symbol)] != kNone;
    }
};

[[nodiscard]] Reachable find_reachable(const Program& program);

} // namespace lsys
