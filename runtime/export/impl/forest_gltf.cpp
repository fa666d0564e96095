// Forests as glTF 2.0: EXT_mesh_gpu_instancing (Khronos, vendor extension; a node for each pair of
// an instance and a cell of the ground), or a node for each branch instance. The instances of a
// species share arrays, of which each primitive has a slice: many readers copy, upload and bound
// whole accessors.
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
        ground_surface_ = 0;
        const PartList all{0, scene.ground->parts.size(), 0};
        add_surface(*scene.ground, materials_.of_ground, std::span(&all, 1));
    }
    for (std::size_t k = 0; k < plan.kinds().size(); ++k) {
        const ForestKind& kind = plan.kinds()[k];
        const auto uses = std::span(plan.uses()).subspan(kind.first, kind.cache->instances.size());
        const bool used = std::any_of(uses.begin(), uses.end(), [](auto n) { return n > 0; });
        surface_of_kind_.push_back(used ? surfaces_.size() : kNoSurface);
        if (used) {
            add_surface(kind.meshes->mesh, materials_.of_kinds[k], nested_lists(kind, plan));
        }
    }
    std::uint32_t meshes = ground_surface_ == kNoSurface ? 0 : 1;
    for (const std::uint64_t uses : plan.uses()) {
        mesh_of_instance_.push_back(uses > 0 ? meshes++ : 0);
    }
    for (ForestSurface& surface : surfaces_) {
        add_views(surface);
    }
    std::size_t accessor = 0;
    for_each_mesh([&](const ForestSurface& surface, std::span<const MeshPart> parts) {
        for (const MeshPart& part : parts) {
            const ForestBlock& block = surface.blocks[part.material];
            accessor += block.attributes.size() + 1;
            const std::pair key((*surface.materials)[part.material], block.coloured);
            material_numbers_.emplace(key, material_numbers_.size());
        }
    });
    first_group_accessor_ = accessor;
    transforms_view_ = view_count_;
    transforms_offset_ = bytes_;
    if (instanced() && plan.branches() > 0) {
        ++view_count_;
        bytes_ += kInstanceBytes * plan.branches();
    }
    first_image_view_ = view_count_;
    for (std::string& image : images_) {
        image.resize((image.size() + 3) / 4 * 4, '\0');
        bytes_ += image.size();
    }
}

void ForestDocument::add_surface(const Mesh& mesh,
                                 const std::vector<std::uint32_t>& materials,
                                 std::span<const PartList> lists) {
    ForestSurface& surface = surfaces_.emplace_back();
    surface.mesh = &mesh;
    surface.materials = &materials;
    surface.sliced = slice_mesh(mesh, lists);
    surface.blocks.resize(mesh.materials.size());
    for (const MeshPart& part : mesh.parts) {
        ForestBlock& block = surface.blocks[part.material];
        block.coloured = block.coloured || has_vertex_colours(mesh, part);
    }
}

void ForestDocument::add_views(ForestSurface& surface) {
    const Mesh& mesh = *surface.mesh;
    for (std::size_t material = 0; material < surface.blocks.size(); ++material) {
        const SliceBlock& from = surface.sliced.blocks[material];
        ForestBlock& to = surface.blocks[material];
        to.first_view = view_count_;
        if (from.vertex_count == 0) {
            continue;
        }
        const auto place = [this](ForestView& view) {
            view.offset = bytes_;
            view.bytes = view.item_bytes();
            bytes_ += (view.bytes + 3) / 4 * 4;
            view_count_ += view.count > 0 ? 1 : 0;
        };
        const auto add = [&](GltfArray array) {
            to.attributes.push_back(
                {.array = array, .type = item_of(array, to.form), .count = from.vertex_count});
            place(to.attributes.back());
        };
        add(GltfArray::Positions);
        add(GltfArray::Normals);
        if (is_complete(mesh, mesh.texture_coordinates)) {
            add(GltfArray::TextureCoordinates);
        }
        // Only normal maps need tangents.
        if (is_complete(mesh, mesh.tangents) &&
            pictures_.of_materials[(*surface.materials)[material]].relief) {
            add(GltfArray::Tangents);
        }
        if (to.coloured) {
            add(GltfArray::Colours);
        }
        to.wide_indices = {.array = GltfArray::Indices,
                           .type = {kGltfInteger, "SCALAR", false, 4},
                           .count = from.wide_indices};
        place(to.wide_indices);
        to.narrow_indices = {.array = GltfArray::Indices,
                             .type = {kGltfShort, "SCALAR", false, 2},
                             .count = from.narrow_indices};
        place(to.narrow_indices);
    }
}

namespace {

constexpr std::size_t kChunk = 16384; // indices

/// Writes the indices of the parts of one material whose slices are wide, or of the others.
template <typename Index>
void write_indices(const ForestSurface& surface, std::size_t material, const GltfBytes& write) {
    const bool wide = sizeof(Index) == sizeof(std::uint32_t);
    std::vector<Index> chunk;
    std::uint64_t count = 0;
    for (const std::size_t p : surface.sliced.order) {
        const MeshPart& part = surface.mesh->parts[p];
        if (part.material != material || surface.sliced.slices[p].is_wide() != wide) {
            continue;
        }
        const std::uint64_t end = part.first_index + part.index_count;
        for (std::uint64_t first = part.first_index; first < end; first += kChunk) {
            const auto from = surface.sliced.indices.begin();
            chunk.assign(from + static_cast<std::ptrdiff_t>(first),
                         from + static_cast<std::ptrdiff_t>(std::min(first + kChunk, end)));
            write(std::as_bytes(std::span<const Index>(chunk)));
        }
        count += part.index_count;
    }
    chunk.assign(count * sizeof(Index) % 4 / sizeof(Index), 0);
    write(std::as_bytes(std::span<const Index>(chunk)));
}

} // namespace

void ForestDocument::put_data(const GltfSink& write) const {
    const GltfBytes put = [&write](std::span<const std::byte> bytes) { write(bytes); };
    for (const ForestSurface& surface : surfaces_) {
        for (std::size_t material = 0; material < surface.blocks.size(); ++material) {
            const SliceBlock& block = surface.sliced.blocks[material];
            const auto vertices =
                std::span(surface.sliced.vertices).subspan(block.first_vertex, block.vertex_count);
            const ForestBlock& to = surface.blocks[material];
            for (const ForestView& view : to.attributes) {
                write_items(*surface.mesh, vertices, view.array, to.form, put);
            }
            write_indices<std::uint32_t>(surface, material, put);
            write_indices<std::uint16_t>(surface, material, put);
        }
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
