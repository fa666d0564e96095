// The note on a forest in which few trees differ from each other.
#pragma once

#include "runtime/pipeline/forest.h"
#include "runtime/pipeline/step.h"

namespace lsys {

/// Notes each species with fewer than 1,000 different trees and fewer than half of all, at the
/// axiom of its grammar, with options for more of them. No note if the scene asks for few: one
/// hero, or a rho of 0 (trees are then whole heroes). None for a scene with a goal, which reports
/// its choice, and none if another note says that the plants are alike.
void note_variety(const Scene& scene, const GrownForest& grown, Step& step);

} // namespace lsys
