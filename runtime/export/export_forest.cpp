// SPDX-License-Identifier: MIT
#include "runtime/export/export_forest.h"

#include "grammar/base/contract.h"
#include "runtime/export/impl/export_outcome.h"
#include "runtime/export/impl/forest_formats.h"
#include "runtime/export/impl/formats.h"

namespace lsys {

Outcome<void> export_forest(const ForestScene& scene,
                            ExportFormat format,
                            ForestForm form,
                            const ForestExportInfo& info,
                            const ByteSink& sink) {
    LSYS_CHECK(traits_of(format).write_forest != nullptr, static_cast<int>(format));
    return run_within_memory("the file", [&] {
        const ForestPlan plan(scene, info.cell, info.threads);
        const bool has_ground = scene.ground != nullptr && triangle_count(*scene.ground) > 0;
        if (plan.branch_count() == 0 && !has_ground) {
            return nothing_to_draw(ExportSubject::Forest);
        }
        PieceWriter out(sink);
        return traits_of(format).write_forest({scene, plan, form, info}, out);
    });
}

Outcome<std::vector<PictureFile>> make_forest_picture_files(const ForestScene& scene,
                                                            ExportFormat format,
                                                            const ForestExportInfo& info) {
    return run_within_memory("the pictures", [&] {
        ExportInfo pictures;
        pictures.textures = info.textures;
        pictures.picture_prefix = info.picture_prefix;
        pictures.threads = info.threads;
        const ForestPlan plan(scene, 0.0F, info.threads);
        return make_picture_files(find_forest_materials(scene, plan).samples, format, pictures);
    });
}

} // namespace lsys
