// SPDX-License-Identifier: MIT
// The note for a forest in which few trees differ from each other.
#pragma once

#include "runtime/pipeline/forest.h"
#include "runtime/pipeline/step.h"

namespace lsys {

/// Adds a note at the axiom of each species in which fewer than 1,000 trees, and fewer than half of
/// all, differ from each other. The note names options that give more different trees. No note if
/// the scene requests few different trees: one hero, or a rho of 0 (trees are then whole heroes).
/// No note for a scene with a goal, for which choose_instancing() reports its choice, or if
/// AxiomPlace::is_noted.
void note_variety(const Scene& scene, const GrownForest& grown, Step& step);

} // namespace lsys
