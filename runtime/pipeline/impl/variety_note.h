// The note on a forest of which few trees differ.
#pragma once

#include "runtime/pipeline/forest.h"
#include "runtime/pipeline/step.h"

namespace lsys {

/// Notes each species of which fewer than half of the trees differ, and fewer than 1,000, at the
/// axiom of its grammar, with what would make them more. Silent where the scene asks for it: for one
/// hero, for a written rho of 0, whose trees are whole heroes, and for a goal, whose choice is
/// reported; and where another note says that the plants are alike.
void note_variety(const Scene& scene, const GrownForest& grown, Step& step);

} // namespace lsys
