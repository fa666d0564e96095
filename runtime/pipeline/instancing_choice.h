// The choice of heroes, rho and cache cap for a wanted share of different trees in a limited memory
// (`--variety`, `--memory`).
#pragma once

#include "grammar/base/outcome.h"
#include "runtime/pipeline/forest.h"
#include "runtime/pipeline/project.h"

namespace lsys {

/// Max heroes of a species that choose_instancing() tries; a scene may set more.
inline constexpr std::uint32_t kMaxChosenHeroes = 256;

/// Sets heroes, rho and cache cap of each species for `scene.goal`, if that is set. Keeps values
/// that the scene or command line sets. Tries combinations for each species: with a goal of variety
/// it takes the one of least memory whose placed trees reach that share of different ones, counted
/// by count_different_trees(); else the one with most different trees in an equal part of the
/// memory. Memory is that of skeletons and instance records. Depends on scene, grammars and key
/// alone. If no combination reaches the goal, fails and names the nearest goals that can be
/// reached.
[[nodiscard]] Outcome<void> choose_instancing(LoadedScene& loaded, const Project& project);

} // namespace lsys
