// SPDX-License-Identifier: MIT
// The files of the heroes' meshes and pictures, which tiles share. A file has the meshes that one
// level of the quadtree draws and no coarser level draws, so that a client that refines a view
// needs only few more files.
#pragma once

#include "runtime/export/tile_document.h"
#include "runtime/pipeline/hero_levels.h"
#include "runtime/tiles/impl/level_plan.h"
#include "runtime/tiles/tiles.h"

#include <string>
#include <vector>

namespace lsys {

/// The options with which all parts of tiles are exported.
[[nodiscard]] ExportInfo tile_part_info(const std::string& name, const std::string& generator);
/// Makes the pictures of a mesh, as PNG files. Throws std::bad_alloc.
[[nodiscard]] std::vector<PictureFile> tile_pictures(const Mesh& mesh);

struct ModelFiles {
    /// By hero and level of detail: the document, whose buffer and pictures are in `files`. The
    /// member `json` is null if no tile shows the level of detail, or if it draws nothing.
    std::vector<std::vector<MeshDocument>> models;
    std::vector<TileFile> files;
};

/// Makes the files of the levels of detail that `plan` uses. `names`: names of the heroes' meshes.
/// Throws std::bad_alloc.
[[nodiscard]] ModelFiles make_model_files(const std::vector<Hero>& heroes,
                                          const std::vector<std::string>& names,
                                          const LevelPlan& plan,
                                          const std::string& generator);

} // namespace lsys
