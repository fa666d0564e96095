// SPDX-License-Identifier: MIT
// The statistics of `lsc export --stats`.
#pragma once

#include "runtime/meshing/mesh.h"
#include "runtime/output/plant_files.h"
#include "runtime/pipeline/plant.h"

#include <string>

namespace lsys::lsc {

/// The statistics as a table. `mesh`: the mesh of the last file.
[[nodiscard]] std::string
export_stats_text(const Plant& plant, const Mesh& mesh, const ExportTiming& timing);
/// The statistics as a JSON object in one line.
[[nodiscard]] std::string
export_stats_json(const Plant& plant, const Mesh& mesh, const ExportTiming& timing);

} // namespace lsys::lsc
