// SPDX-License-Identifier: MIT
// PlantDocument: a grammar and its plant, with all data from the file to the triangles.
#pragma once

#include "grammar/base/outcome.h"
#include "runtime/meshing/mesh.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/pipeline/plant.h"
#include "viewer/app/options.h"

#include <memory>

namespace lsys::view {

struct PlantDocument {
    Grammar grammar;
    Plant plant;
    Mesh mesh;                 // at rest
    double height = 0.0;       // m, height of the skeleton at rest
    double load_seconds = 0.0; // time to read and compile the grammar
    double mesh_seconds = 0.0; // time to make the mesh
};

/// Reads and compiles a grammar, derives the word, draws the skeleton and makes the mesh.
[[nodiscard]] Outcome<std::shared_ptr<const PlantDocument>>
make_plant_document(const ViewOptions& options, const Project& project);

} // namespace lsys::view
