// Stages of a derivation, to which productions belong.
#pragma once

#include "grammar/base/counted_enum.h"

namespace lsys {

/// When a production is applied.
LSYS_COUNTED_ENUM(Stage,
                  Rewrite,   // in a generation
                  Decompose, // after a generation, and to the axiom, again and again
                  Interpret  // when the word is drawn; the word stays what it is
);
/// `#decompose`, `#interpret`; empty for Rewrite.
[[nodiscard]] constexpr const char* keyword_of(Stage stage) {
    return stage == Stage::Decompose ? "#decompose" : stage == Stage::Interpret ? "#interpret" : "";
}

} // namespace lsys
