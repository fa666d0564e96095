// SPDX-License-Identifier: MIT
// Forests as glTF 2.0: EXT_mesh_gpu_instancing (Khronos, vendor extension; a node for each pair of
// an instance and a cell of the ground), or a node for each branch instance. The instances of a
// species share arrays. Each primitive has accessors for a slice of these arrays, because many
// readers copy and upload whole accessors, and compute bounds of whole accessors.
#include "runtime/base/size_text.h"
#include "runtime/base/workers.h"
#include "runtime/export/impl/export_outcome.h"
#include "runtime/export/impl/forest_document.h"
#include "runtime/export/impl/forest_formats.h"
#include "runtime/export/impl/formats.h"
#include "runtime/export/impl/gltf_parts.h"
#include "runtime/forest/instance_skeleton.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace lsys {

ForestDocument::ForestDocument(const ForestScene& scene,
                               const ForestPlan& plan,
                               ForestForm form,
                               const ForestExportInfo& info)
    : scene_(scene), plan_(plan), form_(form), info_(info),
      materials_(find_forest_materials(scene, plan)) {
    ExportInfo pictures;
    pictures.textures = info.textures;
    grids_.resize(plan.stages().size());
    pictures_ = find_pictures(materials_.samples, ExportPictures::Inside, pictures);
    images_ = encode_pictures(pictures_.list, info.threads);
    if (scene.ground != nullptr && triangle_count(*scene.ground) > 0) {
        ground_surface_ = 0;
        const PartList all{0, scene.ground->parts.size(), 0};
        add_surface(kNoStage, *scene.ground, materials_.of_ground, std::span(&all, 1));
    }
    for (std::size_t k = 0; k < plan.stages().size(); ++k) {
        const ExportedStage& stage = plan.stages()[k];
        const auto uses =
            std::span(plan.instance_counts()).subspan(stage.first, stage.cache->instances.size());
        const bool used = std::any_of(uses.begin(), uses.end(), [](auto n) { return n > 0; });
        surface_of_stage_.push_back(used ? surfaces_.size() : kNoSurface);
        if (used) {
            add_surface(k, stage.meshes->mesh, materials_.of_stages[k], nested_lists(stage, plan));
        }
    }
    std::uint32_t meshes = ground_surface_ == kNoSurface ? 0 : 1;
    for (const std::uint64_t uses : plan.instance_counts()) {
        mesh_of_instance_.push_back(uses > 0 ? meshes++ : 0);
    }
    plan_texture_forms();
    for (ForestSurface& surface : surfaces_) {
        add_views(surface);
    }
    if (info.compression == ExportCompression::Meshopt) {
        compress_views();
    }
    place_views();
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
    if (instanced() && info.compression == ExportCompression::Meshopt) {
        compress_transforms();
    }
    transforms_offset_ = bytes_;
    if (instanced() && packed_.empty() && plan.branch_count() > 0) {
        ++view_count_;
        bytes_ += kInstanceBytes * plan.branch_count();
    }
    first_image_view_ = view_count_;
    for (std::string& image : images_) {
        image.resize((image.size() + 3) / 4 * 4, '\0');
        bytes_ += image.size();
    }
    first_collision_view_ = first_image_view_ + images_.size();
    first_collision_accessor_ =
        first_group_accessor_ + (instanced() ? 3 * plan.groups().size() : 0);
    if (info.collision != CollisionKind::None) {
        add_collisions();
    }
    std::size_t mesh = meshes;
    for (const GltfCollision& collision : collisions_) {
        collision_meshes_.push_back(mesh);
        mesh += collision.shapes.size();
        bytes_ += collision.byte_count();
    }
}

void ForestDocument::add_collisions() {
    collisions_.resize(plan_.instance_counts().size());
    ExportInfo shapes;
    shapes.collision = info_.collision;
    shapes.collision_names = info_.collision_names;
    for (std::size_t k = 0; k < plan_.stages().size(); ++k) {
        const ExportedStage& stage = plan_.stages()[k];
        const ItemGrid& grid = grids_[k];
        for (std::uint32_t i = 0; i < stage.cache->instances.size(); ++i) {
            if (plan_.instance_counts()[stage.first + i] == 0) {
                continue;
            }
            shapes.name = mesh_name(stage, i);
            GltfCollision& collision = collisions_[stage.first + i];
            collision.shapes =
                make_collision(skeleton_of(*stage.cache, stage.cache->instances[i]), shapes);
            // From m to steps of `grid`, counted from grid.low.
            for (CollisionShape& shape : collision.shapes) {
                for (glm::vec3& vertex : shape.vertices) {
                    vertex = glm::vec3((glm::dvec3(vertex) - glm::dvec3(grid.low)) /
                                       static_cast<double>(grid.step));
                }
            }
        }
    }
}

void ForestDocument::add_surface(std::size_t stage,
                                 const Mesh& mesh,
                                 const std::vector<std::uint32_t>& materials,
                                 std::span<const PartList> lists) {
    ForestSurface& surface = surfaces_.emplace_back();
    surface.stage = stage;
    surface.mesh = &mesh;
    surface.materials = &materials;
    surface.sliced = slice_mesh(mesh, lists);
    surface.blocks.resize(mesh.materials.size());
    for (const MeshPart& part : mesh.parts) {
        ForestBlock& block = surface.blocks[part.material];
        block.coloured = block.coloured || has_vertex_colours(mesh, part);
    }
    Bounds bounds;
    for (const std::size_t part : surface.sliced.order) {
        bounds.add(surface.sliced.slices[part].bounds.low);
        bounds.add(surface.sliced.slices[part].bounds.high);
    }
    GltfForm form = form_of(info_.compression, bounds);
    if (stage == kNoStage) {
        form.step = 0.0F; // exact: above rounded ground, trees would float
    } else if (form.step > 0.0F) {
        grids_[stage] = {form.low, form.step};
    }
    for (ForestBlock& block : surface.blocks) {
        block.form = form;
    }
}

void ForestDocument::plan_texture_forms() {
    texture_forms_.resize(materials_.samples.materials.size());
    if (info_.compression == ExportCompression::None) {
        return;
    }
    struct Range {
        glm::vec2 low{std::numeric_limits<float>::max()};
        glm::vec2 high{std::numeric_limits<float>::lowest()};
    };
    std::vector<Range> ranges(texture_forms_.size());
    for (const ForestSurface& surface : surfaces_) {
        const auto& coordinates = surface.mesh->texture_coordinates;
        for (std::size_t material = 0; material < surface.blocks.size(); ++material) {
            const SliceBlock& block = surface.sliced.blocks[material];
            Range& range = ranges[(*surface.materials)[material]];
            if (!is_complete(*surface.mesh, coordinates)) {
                continue;
            }
            for (std::uint64_t v = 0; v < block.vertex_count; ++v) {
                const glm::vec2& at = coordinates[surface.sliced.vertices[block.first_vertex + v]];
                range.low = glm::min(range.low, at);
                range.high = glm::max(range.high, at);
            }
        }
    }
    for (std::size_t i = 0; i < ranges.size(); ++i) {
        const MaterialPictures& shown = pictures_.of_materials[i];
        if ((shown.colour || shown.normal_map) && ranges[i].low.x <= ranges[i].high.x) {
            texture_forms_[i] = texture_form_of(info_.compression, ranges[i].low, ranges[i].high);
        }
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
        to.form.texture = texture_forms_[(*surface.materials)[material]];
        const MaterialPictures& shown = pictures_.of_materials[(*surface.materials)[material]];
        const auto add = [&](GltfArray array) {
            to.attributes.push_back(
                {.array = array, .type = item_of(array, to.form), .count = from.vertex_count});
        };
        add(GltfArray::Positions);
        add(GltfArray::Normals);
        if (is_complete(mesh, mesh.texture_coordinates) &&
            (shown.colour || shown.normal_map || !to.form.quantized())) {
            add(GltfArray::TextureCoordinates);
        }
        // Only normal maps need tangents.
        if (is_complete(mesh, mesh.tangents) && shown.normal_map) {
            add(GltfArray::Tangents);
        }
        if (to.coloured) {
            add(GltfArray::Colours);
        }
        to.wide_indices = {.array = GltfArray::Indices,
                           .type = {kGltfUnsignedInt, "SCALAR", false, 4},
                           .count = from.wide_indices};
        to.narrow_indices = {.array = GltfArray::Indices,
                             .type = {kGltfUnsignedShort, "SCALAR", false, 2},
                             .count = from.narrow_indices};
        view_count_ += to.attributes.size();
        view_count_ += (from.wide_indices > 0 ? 1U : 0U) + (from.narrow_indices > 0 ? 1U : 0U);
    }
}

namespace {

/// Reads the indices of a part, within its slice. With `ordered`, for compression, triangles are
/// sorted by their highest index, so that triangles of nested lists come first, in the order that
/// these triangles would have if the part were a separate mesh.
void read_indices(const ForestSurface& surface,
                  std::size_t number,
                  bool ordered,
                  LargeVector<std::uint32_t>& indices) {
    const MeshPart& part = surface.mesh->parts[number];
    const Slice& slice = surface.sliced.slices[number];
    const auto from =
        surface.sliced.indices.begin() + static_cast<std::ptrdiff_t>(part.first_index);
    const auto count = static_cast<std::ptrdiff_t>(part.index_count);
    if (!ordered) {
        indices.assign(from, from + count);
        return;
    }
    const auto last_of = [&](std::ptrdiff_t first) {
        return std::max({from[first], from[first + 1], from[first + 2]});
    };
    LargeVector<std::uint32_t> places; // by highest index: place of the next triangle
    places.assign(slice.vertex_count + 1, 0);
    for (std::ptrdiff_t i = 0; i + 2 < count; i += 3) {
        ++places[last_of(i) + 1];
    }
    std::partial_sum(places.begin(), places.end(), places.begin());
    indices.resize(static_cast<std::size_t>(count));
    for (std::ptrdiff_t i = 0; i + 2 < count; i += 3) {
        const std::uint64_t place = 3 * std::uint64_t{places[last_of(i)]++};
        std::copy_n(from + i, 3, indices.begin() + static_cast<std::ptrdiff_t>(place));
    }
}

/// Calls visit(indices) for the parts of one material with wide slices or, if `wide` is false, with
/// narrow slices.
template <typename Visit>
void for_each_part(const ForestSurface& surface,
                   std::size_t material,
                   bool wide,
                   bool ordered,
                   const Visit& visit) {
    LargeVector<std::uint32_t> indices;
    for (const std::size_t p : surface.sliced.order) {
        const MeshPart& part = surface.mesh->parts[p];
        if (part.material != material || surface.sliced.slices[p].is_wide() != wide) {
            continue;
        }
        read_indices(surface, p, ordered, indices);
        visit(std::span<const std::uint32_t>(indices));
    }
}

template <typename Index>
void write_indices(const ForestSurface& surface,
                   std::size_t material,
                   bool ordered,
                   const GltfBytes& write) {
    LargeVector<Index> narrowed;
    for_each_part(surface, material, sizeof(Index) == sizeof(std::uint32_t), ordered,
                  [&](std::span<const std::uint32_t> indices) {
                      narrowed.resize(indices.size());
                      std::transform(indices.begin(), indices.end(), narrowed.begin(),
                                     [](std::uint32_t index) { return static_cast<Index>(index); });
                      write(std::as_bytes(std::span<const Index>(narrowed)));
                  });
}

/// Writes the items of a view.
void write_view(const ForestSurface& surface,
                std::size_t material,
                const ForestView& view,
                const GltfBytes& write) {
    const SliceBlock& block = surface.sliced.blocks[material];
    const GltfForm& form = surface.blocks[material].form;
    const bool ordered = form.compression == ExportCompression::Meshopt;
    if (view.array != GltfArray::Indices) {
        write_items(
            *surface.mesh,
            std::span(surface.sliced.vertices).subspan(block.first_vertex, block.vertex_count),
            view.array, form, write);
    } else if (view.type.component == kGltfUnsignedInt) {
        write_indices<std::uint32_t>(surface, material, ordered, write);
    } else {
        write_indices<std::uint16_t>(surface, material, ordered, write);
    }
}

} // namespace

void ForestDocument::compress_views() {
    struct Task {
        const ForestSurface& surface;
        std::size_t material;
        ForestView& view;
    };
    std::vector<Task> tasks;
    for_each_view([&](const ForestSurface& surface, std::size_t material, ForestView& view) {
        tasks.push_back({surface, material, view});
    });
    Workers workers(info_.threads);
    workers.for_each(tasks.size(), [&](std::uint64_t i) {
        const ForestSurface& surface = tasks[i].surface;
        const std::size_t material = tasks[i].material;
        ForestView& view = tasks[i].view;
        if (view.array != GltfArray::Indices) {
            const GltfBuffer items = written_items(view.item_bytes(), [&](const GltfBytes& write) {
                write_view(surface, material, view, write);
            });
            view.compressed = compress_items(items, view.type.stride);
            return;
        }
        LargeVector<std::uint32_t> indices;
        indices.reserve(view.count);
        for_each_part(surface, material, view.type.component == kGltfUnsignedInt, true,
                      [&indices](std::span<const std::uint32_t> part) {
                          indices.insert(indices.end(), part.begin(), part.end());
                      });
        view.compressed = compress_indices(indices, surface.mesh->positions.size());
    });
}

void ForestDocument::compress_transforms() {
    for_each_transform_window(
        plan_, grids_, info_,
        [this](std::span<const ForestGroup> groups, std::span<const float> floats) {
            packed_.push_back(pack_transforms(groups, floats, info_.threads));
            for (ForestView& view : packed_.back().views) {
                place(view);
                ++view_count_;
            }
        });
}

void ForestDocument::place(ForestView& view) {
    view.offset = bytes_;
    view.bytes = view.item_bytes();
    if (!view.compressed.empty()) {
        view.bytes = view.compressed.size();
        view.decoded_offset = decoded_bytes_;
        decoded_bytes_ += (view.item_bytes() + 3) / 4 * 4;
    }
    bytes_ += (view.bytes + 3) / 4 * 4;
}

void ForestDocument::place_views() {
    for_each_view([this](const ForestSurface&, std::size_t, ForestView& view) { place(view); });
}

void ForestDocument::put_data(const GltfSink& write) const {
    std::uint64_t written = 0;
    const GltfBytes put = [&](std::span<const std::byte> bytes) {
        written += bytes.size();
        write(bytes);
    };
    const auto pad = [&] {
        constexpr std::array<std::byte, 3> kPadding{};
        put(std::span(kPadding).first((4 - written % 4) % 4));
    };
    for (const ForestSurface& surface : surfaces_) {
        for (std::size_t material = 0; material < surface.blocks.size(); ++material) {
            const auto put_view = [&](const ForestView& view) {
                if (view.compressed.empty()) {
                    write_view(surface, material, view, put);
                } else {
                    put(std::as_bytes(std::span(view.compressed)));
                }
                pad();
            };
            const ForestBlock& block = surface.blocks[material];
            std::for_each(block.attributes.begin(), block.attributes.end(), put_view);
            for (const ForestView* view : {&block.wide_indices, &block.narrow_indices}) {
                if (view->count > 0) {
                    put_view(*view);
                }
            }
        }
    }
    for (const PackedTransforms& packed : packed_) {
        for (const ForestView& view : packed.views) {
            put(std::as_bytes(std::span(view.compressed)));
            pad();
        }
    }
    if (instanced() && packed_.empty()) {
        write_transforms(plan_, grids_, info_, write);
    }
    for (const std::string& image : images_) {
        write(std::as_bytes(std::span(image)));
    }
    for (const GltfCollision& collision : collisions_) {
        if (!collision.shapes.empty()) {
            write_collision(collision, write);
        }
    }
}

namespace {

Outcome<void> write(const ForestExportJob& job, bool binary, PieceWriter& out) {
    if (job.form == ForestForm::Expanded && job.plan.branch_count() > kMaxForestNodes) {
        return {Stop::Limit, messages_of(plant_limit_diagnostic(
                                 "the expanded forest",
                                 fmt::format("{} branches", grouped_digits(kMaxForestNodes)),
                                 "without --expand, branches are instances"))};
    }
    const ForestDocument document(job.scene, job.plan, job.form, job.info);
    if (job.form == ForestForm::Expanded && document.node_count() > 2 * kMaxForestNodes) {
        return {
            Stop::Limit,
            messages_of(plant_limit_diagnostic(
                "the expanded forest", fmt::format("{} nodes", grouped_digits(2 * kMaxForestNodes)),
                "each tree has nodes for its collision shapes; omit --collision"))};
    }
    if (document.data_bytes() > kMaxGltfBytes || document.decoded_bytes() > kMaxGltfBytes) {
        return too_large_for_format(ExportSubject::Forest);
    }
    GltfFile file;
    file.binary = binary;
    file.put_members = [&document](JsonWriter& json) { document.put_members(json); };
    file.data_bytes = document.data_bytes();
    file.decoded_bytes = document.decoded_bytes();
    file.put_data = [&document](const GltfSink& to) { document.put_data(to); };
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
