// Levels of detail of a plant in one glTF file: the extension MSFT_lod. Each level is written as a
// file of its own by the writer of one mesh, and the files are joined.
#pragma once

#include "grammar/base/outcome.h"

namespace lsys {

struct ExportJob;
class PieceWriter;

/// Writes the mesh of the job and ExportInfo::coarser, which is not null. Equal pictures, samplers,
/// textures and materials are written once. Memory: the size of the file.
Outcome<void> write_gltf_levels(const ExportJob& job, bool binary, PieceWriter& out);

} // namespace lsys
