// The statistics of `lsc export --stats`.
#pragma once

#include "runtime/meshing/mesh.h"
#include "runtime/pipeline/plant.h"

#include <cstdint>
#include <string>

namespace lsys::lsc {

/// Times and bytes of all files of an export.
struct ExportTiming {
    double physics_seconds = 0.0;
    double mesh_seconds = 0.0;
    double write_seconds = 0.0;
    std::uint64_t bytes = 0;
};

/// The statistics as a table. `mesh`: the mesh of the last file.
[[nodiscard]] std::string
export_stats_text(const Plant& plant, const Mesh& mesh, const ExportTiming& timing);
/// The statistics as a JSON object in one line.
[[nodiscard]] std::string
export_stats_json(const Plant& plant, const Mesh& mesh, const ExportTiming& timing);

} // namespace lsys::lsc
