// SPDX-License-Identifier: MIT
// Levels of detail of a plant in one glTF file: the extension MSFT_lod. The writer of single meshes
// writes each level as a file in memory, and the files are joined.
#pragma once

#include "grammar/base/outcome.h"

namespace lsys {

struct ExportJob;
class PieceWriter;

/// Writes the mesh of the job and ExportInfo::coarser, which is not null. Equal pictures, samplers,
/// textures and materials are written once. Memory: the size of the file.
Outcome<void> write_gltf_levels(const ExportJob& job, bool binary, PieceWriter& out);

} // namespace lsys
