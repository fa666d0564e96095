// Forests as glTF 2.0: EXT_mesh_gpu_instancing (Khronos, vendor extension; a node for each pair of
// an instance and a cell of the ground), or a node for each branch instance. The instances of a
// species share arrays of vertices. The document is written twice: into nothing, to know its size,
// which a GLB says first, and into the file.
#include "runtime/export/impl/base64.h"
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
    block.data = plan_gltf_data(mesh, nullptr, {});
    block.coloured.resize(mesh.materials.size());
    for (std::size_t p = 0; p < mesh.parts.size(); ++p) {
        const std::uint32_t material = mesh.parts[p].material;
        block.coloured[material] = block.coloured[material] || block.data.coloured[p];
    }
    for (const glm::vec3& position : mesh.positions) {
        block.bounds.add(position);
    }
}

void ForestDocument::put_data(const std::function<bool(std::span<const std::byte>)>& write) const {
    for (const ForestBlock& block : blocks_) {
        write_gltf_data(*block.mesh, nullptr, block.data,
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

ForestExportStatus write(const ForestExportJob& job, bool binary, PieceWriter& out) {
    const auto& [scene, plan, form, info] = job;
    if (form == ForestForm::Expanded && plan.branches() > kMostForestNodes) {
        return ForestExportStatus::TooManyNodes;
    }
    ForestDocument document(scene, plan, form, info);
    if (document.data_bytes() > kMostGltfBytes) {
        return ForestExportStatus::TooLarge;
    }
    if (!binary) {
        document.put(out);
        out.put(R"(,"uri":"data:application/octet-stream;base64,)");
        Base64Writer base64(out);
        document.put_data([&](std::span<const std::byte> bytes) {
            base64.put(bytes);
            return !out.stopped();
        });
        base64.finish();
        out.put("\"}]}\n");
        return ForestExportStatus::Ok;
    }
    constexpr std::string_view kEnd = "}]}";
    std::uint64_t json_bytes = kEnd.size();
    const ByteSink count = [&json_bytes](std::string_view bytes) {
        json_bytes += bytes.size();
        return true;
    };
    PieceWriter counter(count);
    document.put(counter);
    if (!counter.finish()) {
        return ForestExportStatus::Stopped;
    }
    const std::uint64_t padding = (4 - json_bytes % 4) % 4;
    if (!put_glb_header(json_bytes + padding, document.data_bytes(), out)) {
        return ForestExportStatus::TooLarge;
    }
    document.put(out);
    out.put(kEnd);
    out.put(std::string_view("   ").substr(0, padding));
    put_glb_data_header(document.data_bytes(), out);
    document.put_data([&out](std::span<const std::byte> bytes) {
        out.put_bytes(bytes);
        return !out.stopped();
    });
    return ForestExportStatus::Ok;
}

} // namespace

ForestExportStatus write_forest_gltf(const ForestExportJob& job, PieceWriter& out) {
    return write(job, false, out);
}

ForestExportStatus write_forest_glb(const ForestExportJob& job, PieceWriter& out) {
    return write(job, true, out);
}

} // namespace lsys
