// SPDX-License-Identifier: MIT
// The passes of a generation over a word: sections 5 and 13.5 of the language reference.

#pragma once

#include "tests/reference/system.h"

#include <optional>

namespace lsys::reference {

// Draw numbers that are reserved for each rule or pass; see PassInput::first_draw.
constexpr std::uint64_t kDrawsOfARule = 4096;

// Input of a pass, which rewrites `word` of age `age` once. A generation is one pass, or several in
// sequential rewriting, #decompose and #interpret.
struct PassInput {
    const System& system;
    const Word& word;
    std::uint32_t age = 0; // of `word`
    // Number of the first draw. Sequential rewriting: 4096 times the index of the rule; #decompose:
    // 2^32 + 4096 times the index of the pass, #interpret: 2^31 more; sweeps: kFirstDownDraw,
    // kFirstUpDraw.
    std::uint64_t first_draw = 0;
    std::optional<std::size_t> only_rule; // the only rule of this pass; empty: all rules
    Stage stage = Stage::Rewrite;
};

// Rewrites the word once. Like all functions here, counts in `derivation` the productions applied.
Word run_pass(const PassInput& pass, Derivation& derivation);

// The word of an age after its decomposition.
Word decomposed(const System& system, const Word& word, std::uint32_t age, Derivation& derivation);

// The word that is drawn in place of `word`. Module::source of each module is the index of the
// module of `word` in whose place it is drawn.
Word interpreted(const System& system, const Word& word, std::uint32_t age, Derivation& derivation);

// Visits all modules of the word once, in the direction of Stage::Down or Stage::Up.
void sweep(
    const System& system, Stage stage, Word& word, std::uint32_t age, Derivation& derivation);

} // namespace lsys::reference
