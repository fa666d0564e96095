#include "runtime/export/export_forest.h"

#include "grammar/base/contract.h"
#include "runtime/export/impl/forest_formats.h"
#include "runtime/export/impl/formats.h"
#include "runtime/export/impl/pictures.h"

#include <new>
#include <stdexcept>

namespace lsys {

namespace {

ForestExportStatus write(const ForestScene& scene,
                         ExportFormat format,
                         ForestForm form,
                         const ForestExportInfo& info,
                         const ByteSink& sink) {
    LSYS_CHECK(traits_of(format).write_forest != nullptr, static_cast<int>(format));
    const ForestPlan plan(scene, info.cell, info.threads);
    if (plan.branches() == 0 && (scene.ground == nullptr || triangle_count(*scene.ground) == 0)) {
        return ForestExportStatus::Nothing;
    }
    PieceWriter out(sink);
    const ForestExportStatus status =
        traits_of(format).write_forest({scene, plan, form, info}, out);
    if (status == ForestExportStatus::Ok && !out.finish()) {
        return ForestExportStatus::Stopped;
    }
    return status;
}

} // namespace

ForestExportStatus export_forest(const ForestScene& scene,
                                 ExportFormat format,
                                 ForestForm form,
                                 const ForestExportInfo& info,
                                 const ByteSink& sink) {
    try {
        return write(scene, format, form, info, sink);
    } catch (const std::bad_alloc&) {
        return ForestExportStatus::OutOfMemory;
    } catch (const std::length_error&) {
        return ForestExportStatus::OutOfMemory;
    }
}

ForestExportStatus make_forest_picture_files(const ForestScene& scene,
                                             const ForestExportInfo& info,
                                             std::vector<PictureFile>& files) {
    try {
        const ForestMaterials materials =
            find_forest_materials(scene, ForestPlan(scene, 0.0F, info.threads));
        ExportInfo pictures;
        pictures.textures = info.textures;
        pictures.picture_prefix = info.picture_prefix;
        pictures.threads = info.threads;
        const ExportStatus status =
            make_picture_files(materials.samples, ExportFormat::Usda, pictures, files);
        return status == ExportStatus::Ok ? ForestExportStatus::Ok
                                          : ForestExportStatus::OutOfMemory;
    } catch (const std::bad_alloc&) {
        return ForestExportStatus::OutOfMemory;
    } catch (const std::length_error&) {
        return ForestExportStatus::OutOfMemory;
    }
}

} // namespace lsys
