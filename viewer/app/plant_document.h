// PlantDocument: a grammar and the plant it makes, from the file to triangles. What there is to say
// on the way is said on the console that is handed in, so that a window can show it.
#pragma once

#include "runtime/program/console.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/pipeline/plant.h"
#include "runtime/meshing/mesh.h"
#include "viewer/app/options.h"

#include <string>
#include <vector>

namespace lsys::view {

struct PlantDocument {
    Grammar grammar;
    Plant plant;
    Mesh mesh; // of the plant at rest
    double load_seconds = 0.0;
    double mesh_seconds = 0.0;
};

/// Reads, compiles, derives, draws and meshes. Fine: all of it is there. Else what was made until
/// then is.
[[nodiscard]] ExitStatus make_plant_document(const ViewOptions& options,
                                              const Console& console,
                                              PlantDocument& document);

/// The files that the document was made of, as far as they are known: the grammar, what it
/// includes, the meshes of its `#object`.
[[nodiscard]] std::vector<std::string> files_of(const ViewOptions& options,
                                                const PlantDocument& document);

} // namespace lsys::view
