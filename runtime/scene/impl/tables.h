// The tables of a scene file, each read by a function of its own. They go on after a mistake, with
// the default, so that all mistakes are found at once.
#pragma once

#include "grammar/base/diagnostic.h"
#include "runtime/scene/impl/document.h"
#include "runtime/scene/scene.h"

namespace lsys {

/// `table`: of `[terrain]`, nullptr where there is none.
void read_terrain_table(const SceneValue* table, Scene& scene, Diagnostics& diagnostics);
/// The terrain has been read. `table`: of `[placement]`, nullptr where there is none.
void read_placement_table(const SceneValue* table, Scene& scene, Diagnostics& diagnostics);
/// The placement has been read. `root`: the file, which holds the list of species.
void read_species_list(const SceneValue& root, Scene& scene, Diagnostics& diagnostics);

/// The species have been read. `table`: of `[painted]`, nullptr where there is none.
void read_painting_table(const SceneValue* table, Scene& scene, Diagnostics& diagnostics);

} // namespace lsys
