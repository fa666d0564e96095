// PlantDocument: a grammar and the plant it makes, from the file to triangles. What there is to say
// on the way is said on the console that is handed in, so that a window can show it.
#pragma once

#include "runtime/cli/console.h"
#include "runtime/cli/grammar_file.h"
#include "runtime/cli/plant.h"
#include "runtime/mesh.h"
#include "viewer/app/options.h"

namespace lsys::view {

struct PlantDocument {
    lsc::Grammar grammar;
    lsc::Plant plant;
    Mesh mesh; // of the plant at rest
    double load_seconds = 0.0;
    double mesh_seconds = 0.0;
};

/// Reads, compiles, derives, draws and meshes. Fine: all of it is there.
[[nodiscard]] lsc::Status make_plant_document(const ViewOptions& options,
                                              const lsc::Console& console,
                                              PlantDocument& document);

} // namespace lsys::view
