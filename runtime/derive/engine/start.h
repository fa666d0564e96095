// SPDX-License-Identifier: MIT
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

/// The axiom that a derivation with this seed begins with (docs/language.md section 6.3).
[[nodiscard]] const BytecodeAxiom& chosen_axiom(const Bytecode& bytecode, std::uint64_t seed);

/// Evaluates the parameters that chosen_axiom() stores. Returns the first error.
[[nodiscard]] std::optional<RuntimeError> axiom_parameters(const Bytecode& bytecode,
                                                           std::uint64_t seed,
                                                           const std::vector<float>& globals,
                                                           std::vector<float>& parameters);

/// Copies the axiom's codes to `out`, at the width of C.
template <typename C>
void copy_axiom_codes(const Bytecode& bytecode, const BytecodeAxiom& axiom, C* out) {
    for (std::uint32_t i = 0; i < axiom.word.codes.count; ++i) {
        out[i] = static_cast<C>(bytecode.template_codes[axiom.word.codes.first + i]);
    }
}

} // namespace lsys
