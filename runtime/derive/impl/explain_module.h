// SPDX-License-Identifier: MIT
// Explains the decision about one module in one pass, as docs/language.md sections 5 and 6 describe
// it: which productions match, which of them is chosen, and the successor.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "runtime/derive/impl/traced_word.h"
#include "runtime/derive/trace.h"

#include <cstdint>
#include <vector>

namespace lsys {

/// The input of a pass; `word` is the word that it rewrites. `neighbours` is the word whose modules
/// are contexts: `word`, or for a sweep the word that it wrote.
struct TracedPass {
    const Bytecode& bytecode;
    const TraceInputs& inputs;
    const TracedWord& word;
    const TracedWord& neighbours;
    const DerivationPass& facts;
};

/// The productions that a pass tries, in file order.
[[nodiscard]] std::vector<std::uint32_t> productions_of_pass(const Bytecode& bytecode,
                                                             const DerivationPass& facts);

/// Explains the module at `position`. `fate` is Copied, Rewritten or Failed.
[[nodiscard]] ModuleTrace explain_module(const TracedPass& pass,
                                         const std::vector<std::uint32_t>& productions,
                                         std::uint64_t position);

} // namespace lsys
