// SPDX-License-Identifier: MIT
// Exports the plant that is shown, with the writers of `lsc export`, on a thread of its own.
#pragma once

#include "runtime/meshing/mesh.h"
#include "viewer/app/latest_request_worker.h"
#include "viewer/app/options.h"
#include "viewer/app/plant_document.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace lsys::view {

/// Choices of the user.
struct ExportSettings {
    std::string file;       // its extension chooses the format
    std::string preset;     // a name in runtime/output/presets.def; empty: none
    std::uint32_t lods = 0; // 0: one level, or as many as the preset has
};

/// The input of the exporting thread.
struct ExportRequest {
    std::shared_ptr<const PlantDocument> document;
    ViewOptions options; // options with which the document was made
    ExportSettings settings;
    std::vector<std::string> inputs; // paths of the files of the document, which stay as they are
    // Fields for LatestRequestWorker.
    SteadyClock::time_point changed_at;
    bool is_repeat = false;
};

/// Writes the plant at rest, with the mesh options of the document. All files appear, or none.
/// Returns "Wrote oak.glb", or the lines of an error and its help.
[[nodiscard]] std::string export_plant(const ExportRequest& request,
                                       const std::atomic<bool>& cancelled);

using PlantExporter = LatestRequestWorker<ExportRequest, std::string>;

/// The reason why no plant can be written to `file`: a problem of its path, or an extension of no
/// known format. Empty if a plant can be written.
[[nodiscard]] std::string problem_of_export(const std::string& file);

/// Names of the presets for plants.
[[nodiscard]] std::vector<std::string> export_presets();

} // namespace lsys::view
