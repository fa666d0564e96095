// SPDX-License-Identifier: MIT
// The stage of a derivation that applies a production.
#pragma once

#include "grammar/base/counted_enum.h"

namespace lsys {

/// The point of a derivation at which a production is applied.
LSYS_COUNTED_ENUM(Stage,
                  Rewrite,   // in a generation
                  Decompose, // to the axiom and after each generation, until nothing matches
                  Interpret, // when the word is drawn, which does not change it
                  Down,      // in a sweep from right to left over each complete word
                  Up         // in a sweep from left to right over each complete word, after Down
);
/// The keyword of the productions of a stage; empty for Rewrite.
[[nodiscard]] constexpr const char* keyword_of(Stage stage) {
    switch (stage) {
    case Stage::Rewrite:
        break;
    case Stage::Decompose:
        return "#decompose";
    case Stage::Interpret:
        return "#interpret";
    case Stage::Down:
        return "#down";
    case Stage::Up:
        return "#up";
    }
    return "";
}

} // namespace lsys
