// The choice of heroes, rho and cache cap for a wanted share of different trees in a limited memory
// (`--variety`, `--memory`).
#pragma once

#include "grammar/base/outcome.h"
#include "runtime/pipeline/forest.h"
#include "runtime/pipeline/project.h"

namespace lsys {

/// The most heroes of a species that choose_instancing() tries, unless a scene writes more.
inline constexpr std::uint32_t kMaxChosenHeroes = 256;

/// Sets heroes, rho and cache cap of each species for `scene.goal`, if that is set; values that a
/// scene or command line has written stay. For each species it takes, of all combinations that it
/// tries, the one of least memory in which the share of its placed trees is different, counted as
/// count_different_trees() does. Memory is that of skeletons and instance records. Without a share
/// it takes the one with most different trees within an equal part of the memory. Depends on scene,
/// grammars and key alone. Fails where no combination does, and names the nearest ones.
[[nodiscard]] Outcome<void> choose_instancing(LoadedScene& loaded, const Project& project);

} // namespace lsys
