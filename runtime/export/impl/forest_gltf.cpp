// Forests as glTF 2.0: EXT_mesh_gpu_instancing (Khronos, vendor extension; a node for each pair of
// an instance and a cell of the ground), or a node for each branch instance. The instances of a
// species share arrays of vertices.
#include "runtime/base/size_text.h"
#include "runtime/export/impl/export_outcome.h"
#include "runtime/export/impl/forest_document.h"
#include "runtime/export/impl/forest_formats.h"
#include "runtime/export/impl/formats.h"
#include "runtime/export/impl/gltf_parts.h"

#include <algorithm>

namespace lsys {

ForestDocument::ForestDocument(const ForestScene& scene,
                               const ForestPlan& plan,
                               ForestForm form,
                               const ForestExportInfo& info)
    : scene_(scene), plan_(plan), form_(form), info_(info),
      materials_(find_forest_materials(scene, plan)) {
    ExportInfo pictures;
    pictures.textures = info.textures;
    pictures_ = find_pictures(materials_.samples, ExportPictures::Inside, pictures);
    images_ = encode_pictures(pictures_.list, info.threads);
    if (scene.ground != nullptr && triangle_count(*scene.ground) > 0) {
        ground_block_ = 0;
        add_block(*scene.ground, materials_.of_ground);
    }
    for (std::size_t k = 0; k < plan.kinds().size(); ++k) {
        const ForestKind& kind = plan.kinds()[k];
        const auto uses = std::span(plan.uses()).subspan(kind.first, kind.cache->instances.size());
        const bool used = std::any_of(uses.begin(), uses.end(), [](auto n) { return n > 0; });
        block_of_kind_.push_back(used ? blocks_.size() : kNoBlock);
        if (used) {
            add_block(kind.meshes->mesh, materials_.of_kinds[k]);
        }
    }
    std::uint32_t meshes = ground_block_ == kNoBlock ? 0 : 1;
    for (const std::uint64_t uses : plan.uses()) {
        mesh_of_instance_.push_back(uses > 0 ? meshes++ : 0);
    }
    std::size_t view = 0;
    std::size_t accessor = 0;
    for (ForestBlock& block : blocks_) {
        block.offset = bytes_;
        block.first_view = view;
        block.first_accessor = accessor;
        bytes_ += block.data.bytes;
        view += block.data.views.size();
        accessor += block.attributes();
    }
    for_each_mesh([&](const ForestBlock& block, std::span<const MeshPart> parts) {
        accessor += parts.size();
        for (const MeshPart& part : parts) {
            const std::pair key((*block.materials)[part.material], block.coloured[part.material]);
            material_numbers_.emplace(key, material_numbers_.size());
        }
    });
    first_group_accessor_ = accessor;
    transforms_view_ = view;
    transforms_offset_ = bytes_;
    if (instanced() && plan.branches() > 0) {
        ++view;
        bytes_ += kInstanceBytes * plan.branches();
    }
    first_image_view_ = view;
    for (std::string& image : images_) {
        image.resize((image.size() + 3) / 4 * 4, '\0');
        bytes_ += image.size();
    }
}

void ForestDocument::add_block(const Mesh& mesh, const std::vector<std::uint32_t>& materials) {
    ForestBlock& block = blocks_.emplace_back();
    block.mesh = &mesh;
    block.materials = &materials;
    block.data = plan_gltf_data(mesh, nullptr, nullptr, {});
    block.coloured.resize(mesh.materials.size());
    for (std::size_t p = 0; p < mesh.parts.size(); ++p) {
        const std::uint32_t material = mesh.parts[p].material;
        block.coloured[material] = block.coloured[material] || block.data.coloured[p];
    }
    for (const glm::vec3& position : mesh.positions) {
        block.bounds.add(position);
    }
}

void ForestDocument::put_data(const GltfSink& write) const {
    for (const ForestBlock& block : blocks_) {
        write_gltf_data(*block.mesh, nullptr, nullptr, block.data,
                        [&write](std::span<const std::byte> bytes) { write(bytes); });
    }
    if (instanced()) {
        write_transforms(plan_, info_, write);
    }
    for (const std::string& image : images_) {
        write(std::as_bytes(std::span(image)));
    }
}

namespace {

Outcome<void> write(const ForestExportJob& job, bool binary, PieceWriter& out) {
    if (job.form == ForestForm::Expanded && job.plan.branches() > kMaxForestNodes) {
        return {Stop::Limit, messages_of(plant_limit_diagnostic(
                                 "the expanded forest",
                                 fmt::format("{} branches", grouped_digits(kMaxForestNodes)),
                                 "without --expand, branches are instances"))};
    }
    const ForestDocument document(job.scene, job.plan, job.form, job.info);
    if (document.data_bytes() > kMaxGltfBytes) {
        return too_large_for_format(ExportSubject::Forest);
    }
    const GltfFile file{binary, [&document](JsonWriter& json) { document.put_members(json); },
                        document.data_bytes(),
                        [&document](const GltfSink& write) { document.put_data(write); }};
    return put_gltf_file(file, out) ? finish(out) : too_large_for_format(ExportSubject::Forest);
}

} // namespace

Outcome<void> write_forest_gltf(const ForestExportJob& job, PieceWriter& out) {
    return write(job, false, out);
}

Outcome<void> write_forest_glb(const ForestExportJob& job, PieceWriter& out) {
    return write(job, true, out);
}

} // namespace lsys
