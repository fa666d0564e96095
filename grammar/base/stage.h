// SPDX-License-Identifier: MIT
// The stage of a derivation that applies a production.
#pragma once

#include "grammar/base/counted_enum.h"

namespace lsys {

/// The point of a derivation at which a production is applied.
LSYS_COUNTED_ENUM(Stage,
                  Rewrite,   // in a generation
                  Decompose, // to the axiom and after each generation, until nothing matches
                  Interpret  // when the word is drawn, which does not change it
);
/// The keyword of the productions of a stage: `#decompose` or `#interpret`; empty for Rewrite.
[[nodiscard]] constexpr const char* keyword_of(Stage stage) {
    return stage == Stage::Decompose ? "#decompose" : stage == Stage::Interpret ? "#interpret" : "";
}

} // namespace lsys
