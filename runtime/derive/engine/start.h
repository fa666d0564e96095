// The start of a derivation: drawn constants and the axiom.
#pragma once

#include "runtime/derive/derive.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace lsys {

/// Draws the globals in source order and checks the bounds of each #param. Returns the first error.
[[nodiscard]] std::optional<RuntimeError>
draw_globals(const Bytecode& bytecode, std::uint64_t seed, std::vector<float>& globals);

/// Evaluates the parameters that the axiom stores. Returns the first error.
[[nodiscard]] std::optional<RuntimeError> axiom_parameters(const Bytecode& bytecode,
                                                           std::uint64_t seed,
                                                           const std::vector<float>& globals,
                                                           std::vector<float>& parameters);

/// Copies the axiom's codes to `out`, at the width of C.
template <typename C>
void copy_axiom_codes(const Bytecode& bytecode, C* out) {
    for (std::uint32_t i = 0; i < bytecode.axiom.codes.count; ++i) {
        out[i] = static_cast<C>(bytecode.template_codes[bytecode.axiom.codes.first + i]);
    }
}

} // namespace lsys
