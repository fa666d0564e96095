// SPDX-License-Identifier: MIT
// ForestDocument: the JSON document of a forest in glTF, and the layout of its buffer. Each call of
// put_members() generates the document again; it is never stored.
#pragma once

#include "runtime/export/impl/forest_formats.h"
#include "runtime/export/impl/forest_plan.h"
#include "runtime/export/impl/forest_slices.h"
#include "runtime/export/impl/gltf_collision.h"
#include "runtime/export/impl/gltf_items.h"
#include "runtime/export/impl/gltf_parts.h"
#include "runtime/export/impl/json_writer.h"
#include "runtime/export/impl/pictures.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lsys {

inline constexpr std::size_t kNoStage = ~std::size_t{0};

/// An array of the vertices or indices of a block: a buffer view.
struct ForestView {
    GltfArray array = GltfArray::Positions;
    GltfItem type;
    std::uint64_t count = 0;  // items
    std::uint64_t offset = 0; // in the buffer, a multiple of 4
    std::uint64_t bytes = 0;  // in the buffer
    /// Bytes in the buffer if EXT_meshopt_compression compresses the array, and the place of the
    /// decoded items.
    GltfBuffer compressed = {};
    std::uint64_t decoded_offset = 0;
    std::string_view filter = {}; // of EXT_meshopt_compression; empty: none

    [[nodiscard]] std::uint64_t item_bytes() const { return type.stride * count; }
};

/// The arrays of one material of a surface.
struct ForestBlock {
    GltfForm form;
    std::vector<ForestView> attributes;
    ForestView wide_indices;    // 32 bits; count 0: there is no view
    ForestView narrow_indices;  // 16 bits; count 0: there is no view
    std::size_t first_view = 0; // of the attributes; then the views of wide and of narrow indices
    bool coloured = false;      // has vertex colours
};

/// Arrays of a stage of a species, or of the ground.
struct ForestSurface {
    std::size_t stage = kNoStage; // index in ForestPlan::stages(); kNoStage: the ground
    const Mesh* mesh = nullptr;
    /// By material of the mesh: index of this material among all materials of the scene.
    const std::vector<std::uint32_t>* materials = nullptr;
    SlicedMesh sliced;
    std::vector<ForestBlock> blocks; // by material of the mesh
};

/// Compressed transforms of consecutive groups.
struct PackedTransforms {
    std::uint64_t first = 0;         // number of the first instance
    std::uint64_t group_count = 0;   // at least 1
    std::array<ForestView, 3> views; // translations, rotations, scales
};
/// Compresses the transforms `floats` of `groups`. The scale of an instance is the step of its
/// quantised positions in metres; translations are rounded to multiples of the largest power of two
/// that is at most half the scale. Components of rotations are rounded to 16 bits, scales to 16
/// significant bits.
[[nodiscard]] PackedTransforms pack_transforms(std::span<const ForestGroup> groups,
                                               std::span<const float> floats,
                                               std::uint32_t threads);

class ForestDocument {
public:
    ForestDocument(const ForestScene& scene,
                   const ForestPlan& plan,
                   ForestForm form,
                   const ForestExportInfo& info);

    [[nodiscard]] std::uint64_t data_bytes() const { return bytes_; }
    [[nodiscard]] std::uint64_t node_count() const;
    /// Size of buffer 1, the decoded items of compressed arrays (GltfFile::decoded_bytes); 0:
    /// nothing is compressed.
    [[nodiscard]] std::uint64_t decoded_bytes() const { return decoded_bytes_; }
    /// Writes all members of the document except `buffers`.
    void put_members(JsonWriter& json) const;
    /// Writes the buffer to the sink.
    void put_data(const GltfSink& write) const;

private:
    static constexpr std::size_t kNoSurface = ~std::size_t{0};
    [[nodiscard]] bool instanced() const { return form_ == ForestForm::Instanced; }

    /// Adds a mesh, sliced by `lists`, to surfaces_; its views are added later.
    void add_surface(std::size_t stage,
                     const Mesh& mesh,
                     const std::vector<std::uint32_t>& materials,
                     std::span<const PartList> lists);
    /// Sets texture_forms_.
    void plan_texture_forms();
    /// Sets collisions_ and collision_meshes_: the collision shapes of all instances in use.
    void add_collisions();
    /// Whether only the first tree of a hero gets collision shapes: Unreal Engine adds the shapes
    /// to the mesh, which all trees of the hero share.
    [[nodiscard]] bool collides_once() const {
        return info_.collision_names == CollisionNames::Unreal;
    }
    [[nodiscard]] std::string mesh_name(const ExportedStage& stage, std::uint32_t instance) const;
    /// Calls visit(instance) for each group (Instanced) or tree (Expanded) that has nodes of
    /// collision shapes, in the order of nodes; `instance` is numbered among all stages.
    template <typename Visit>
    void for_each_collider(const Visit& visit) const;
    /// Plans the views of a surface, without their offsets in the buffer.
    void add_views(ForestSurface& surface);
    /// Compresses the arrays of all views.
    void compress_views();
    void compress_transforms();
    /// Sets the offsets of all views, one after the other.
    void place_views();
    /// Sets the offset of a view to the end of the views placed before it.
    void place(ForestView& view);
    /// Calls visit(surface, material of the mesh, view) for each view in order.
    template <typename Visit>
    void for_each_view(const Visit& visit);
    void put_extensions(JsonWriter& json) const;
    /// Writes facts of the scene and its species.
    void put_extras(JsonWriter& json) const;
    void put_nodes(JsonWriter& json) const;
    void put_instanced_nodes(JsonWriter& json) const;
    void put_expanded_nodes(JsonWriter& json) const;
    void put_mesh(JsonWriter& json,
                  const std::string& name,
                  const ForestSurface& surface,
                  std::span<const MeshPart> parts,
                  std::size_t& accessor) const;
    void put_meshes(JsonWriter& json) const;
    void put_materials(JsonWriter& json) const;
    void put_accessors(JsonWriter& json) const;
    static void
    put_part_accessors(JsonWriter& json, const ForestSurface& surface, std::size_t part);
    void put_group_accessors(JsonWriter& json) const;
    void put_views(JsonWriter& json) const;
    /// Calls visit(surface, parts) for each mesh in the order of their numbers.
    template <typename Visit>
    void for_each_mesh(const Visit& visit) const;

    const ForestScene& scene_;
    const ForestPlan& plan_;
    ForestForm form_;
    const ForestExportInfo& info_;
    ForestMaterials materials_;
    std::vector<ForestSurface> surfaces_;
    std::vector<ItemGrid> grids_;               // by stage
    std::vector<GltfCollision> collisions_;     // by instance among all stages; empty: no collision
    std::vector<std::size_t> collision_meshes_; // by instance: number of its first mesh
    std::size_t first_collision_accessor_ = 0;
    std::size_t first_collision_view_ = 0;
    std::vector<GltfTextureForm> texture_forms_; // by material of the scene
    std::vector<std::size_t> surface_of_stage_;  // by stage: index in surfaces_, or kNoSurface
    std::size_t ground_surface_ = kNoSurface;
    /// By instance among all stages: number of its mesh; 0 if it has none.
    std::vector<std::uint32_t> mesh_of_instance_;
    /// Number in the file of each pair (material of the scene, vertices have colours).
    std::map<std::pair<std::uint32_t, bool>, std::size_t> material_numbers_;
    Pictures pictures_;
    std::size_t view_count_ = 0;
    std::vector<std::string> images_;      // PNG files, padded to multiples of 4 bytes
    std::vector<PackedTransforms> packed_; // empty: transforms are floats
    std::size_t transforms_view_ = 0;      // first view of transforms
    std::size_t first_image_view_ = 0;
    std::size_t first_group_accessor_ = 0;
    std::uint64_t transforms_offset_ = 0; // of float transforms; if packed, of the images
    std::uint64_t bytes_ = 0;             // size of the buffer
    std::uint64_t decoded_bytes_ = 0;
};

template <typename Visit>
void ForestDocument::for_each_view(const Visit& visit) {
    for (ForestSurface& surface : surfaces_) {
        for (std::size_t material = 0; material < surface.blocks.size(); ++material) {
            ForestBlock& block = surface.blocks[material];
            for (ForestView& view : block.attributes) {
                visit(surface, material, view);
            }
            for (ForestView* view : {&block.wide_indices, &block.narrow_indices}) {
                if (view->count > 0) {
                    visit(surface, material, *view);
                }
            }
        }
    }
}

template <typename Visit>
void ForestDocument::for_each_collider(const Visit& visit) const {
    if (collisions_.empty()) {
        return;
    }
    std::vector<bool> written(collisions_.size());
    const auto visit_once = [&](std::uint32_t instance) {
        if (!collisions_[instance].shapes.empty() && !(written[instance] && collides_once())) {
            written[instance] = true;
            visit(instance);
        }
    };
    if (instanced()) {
        for (const ForestGroup& group : plan_.groups()) {
            visit_once(group.instance);
        }
        return;
    }
    for (const ForestCell& cell : plan_.cells()) {
        plan_.for_each_branch(
            cell, [&](const ExportedStage&, std::uint32_t instance, const BranchInstance&) {
                if (plan_.instance_counts()[instance] > 0) {
                    visit_once(instance);
                }
            });
    }
}

template <typename Visit>
void ForestDocument::for_each_mesh(const Visit& visit) const {
    if (ground_surface_ != kNoSurface) {
        visit(surfaces_[ground_surface_], std::span<const MeshPart>(scene_.ground->parts));
    }
    for (std::size_t k = 0; k < plan_.stages().size(); ++k) {
        const ExportedStage& stage = plan_.stages()[k];
        for (std::uint32_t i = 0; i < stage.cache->instances.size(); ++i) {
            if (plan_.instance_counts()[stage.first + i] > 0) {
                visit(surfaces_[surface_of_stage_[k]], stage.meshes->parts_of(i));
            }
        }
    }
}

} // namespace lsys
