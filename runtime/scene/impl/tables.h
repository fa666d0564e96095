// SPDX-License-Identifier: MIT
// Readers of the tables of a scene file. After a mistake a reader continues with the default value,
// so that all mistakes are found at once. `table` is nullptr if the file lacks the table.
#pragma once

#include "grammar/base/diagnostic.h"
#include "runtime/scene/impl/document.h"
#include "runtime/scene/impl/table_reader.h"
#include "runtime/scene/scene.h"

namespace lsys {

/// Reads `[terrain]`.
void read_terrain_table(const SceneValue* table, Scene& scene, Diagnostics& diagnostics);
/// Reads `[placement]`. Precondition: the terrain has been read.
void read_placement_table(const SceneValue* table, Scene& scene, Diagnostics& diagnostics);
/// Reads the list of species of the file `root`. Precondition: the placement has been read.
void read_species_list(const SceneValue& root, Scene& scene, Diagnostics& diagnostics);

/// Reads `[light]`.
void read_light_table(const SceneValue* table, Scene& scene, Diagnostics& diagnostics);

/// Reads `[painted]`. Precondition: the species have been read.
void read_painting_table(const SceneValue* table, Scene& scene, Diagnostics& diagnostics);

} // namespace lsys
