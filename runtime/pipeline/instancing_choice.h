// SPDX-License-Identifier: MIT
// Chooses heroes, rho and cache cap for a wanted share of different trees in limited memory
// (`--variety`, `--memory`).
#pragma once

#include "grammar/base/outcome.h"
#include "runtime/pipeline/forest.h"
#include "runtime/pipeline/project.h"

namespace lsys {

/// Max number of heroes per species that choose_instancing() tries; a scene may set more.
inline constexpr std::uint32_t kMaxChosenHeroes = 256;

/// Sets heroes, rho and cache cap of each species to reach `scene.goal`, if the goal is set. Keeps
/// values that the scene or command line sets. Tries combinations per species. With a goal of
/// variety, chooses the combination with the least memory for which the share of different trees
/// (count_different_trees()) among the placed trees reaches the goal; otherwise, the combination
/// with the most different trees in an equal part of the memory. Memory means skeletons and
/// instance records. The result depends only on scene, grammars and key. If no combination reaches
/// the goal, fails and names the nearest goals that can be reached.
[[nodiscard]] Outcome<void> choose_instancing(LoadedScene& loaded, const Project& project);

} // namespace lsys
