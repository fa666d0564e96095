// ForestDocument: a forest in glTF: the layout of its buffer, and the document that describes it.
// The document is made anew for each put_members() and never stored.
#pragma once

#include "runtime/export/impl/forest_plan.h"
#include "runtime/export/impl/forest_slices.h"
#include "runtime/export/impl/gltf_items.h"
#include "runtime/export/impl/gltf_parts.h"
#include "runtime/export/impl/json_writer.h"
#include "runtime/export/impl/pictures.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace lsys {

/// An array of the vertices or indices of a block: a buffer view.
struct ForestView {
    GltfArray array = GltfArray::Positions;
    GltfItem type;
    std::uint64_t count = 0;  // items
    std::uint64_t offset = 0; // in the buffer, a multiple of 4
    std::uint64_t bytes = 0;  // in the buffer

    [[nodiscard]] std::uint64_t item_bytes() const { return type.stride * count; }
};

/// Arrays of one material of a surface.
struct ForestBlock {
    GltfForm form;
    std::vector<ForestView> attributes;
    ForestView wide_indices;    // 32 bits; no view without items
    ForestView narrow_indices;  // 16 bits, likewise
    std::size_t first_view = 0; // of the attributes; wide indices, narrow ones follow
    bool coloured = false;      // vertices have colours of their own
};

/// Arrays of a kind of tree, or of the ground.
struct ForestSurface {
    const Mesh* mesh = nullptr;
    const std::vector<std::uint32_t>* materials = nullptr; // numbers among all of the scene
    SlicedMesh sliced;
    std::vector<ForestBlock> blocks; // by material of the mesh
};

class ForestDocument {
public:
    ForestDocument(const ForestScene& scene,
                   const ForestPlan& plan,
                   ForestForm form,
                   const ForestExportInfo& info);

    [[nodiscard]] std::uint64_t data_bytes() const { return bytes_; }
    /// Writes all members of the document but `buffers`.
    void put_members(JsonWriter& json) const;
    /// Writes the buffer to the sink.
    void put_data(const GltfSink& write) const;

private:
    static constexpr std::size_t kNoSurface = ~std::size_t{0};
    [[nodiscard]] bool instanced() const { return form_ == ForestForm::Instanced; }

    void add_surface(const Mesh& mesh,
                     const std::vector<std::uint32_t>& materials,
                     std::span<const PartList> lists);
    /// Plans the views of a surface.
    void add_views(ForestSurface& surface);
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
    std::vector<std::size_t> surface_of_kind_;
    std::size_t ground_surface_ = kNoSurface;
    std::vector<std::uint32_t> mesh_of_instance_;
    /// Number in the file of each pair (material of the scene, vertices have colours).
    std::map<std::pair<std::uint32_t, bool>, std::size_t> material_numbers_;
    Pictures pictures_;
    std::size_t view_count_ = 0;
    std::vector<std::string> images_;
    std::size_t transforms_view_ = 0;
    std::size_t first_image_view_ = 0;
    std::size_t first_group_accessor_ = 0;
    std::uint64_t transforms_offset_ = 0;
    std::uint64_t bytes_ = 0;
};

template <typename Visit>
void ForestDocument::for_each_mesh(const Visit& visit) const {
    if (ground_surface_ != kNoSurface) {
        visit(surfaces_[ground_surface_], std::span<const MeshPart>(scene_.ground->parts));
    }
    for (std::size_t k = 0; k < plan_.kinds().size(); ++k) {
        const ForestKind& kind = plan_.kinds()[k];
        for (std::uint32_t i = 0; i < kind.cache->instances.size(); ++i) {
            if (plan_.uses()[kind.first + i] > 0) {
                visit(surfaces_[surface_of_kind_[k]], kind.meshes->parts_of(i));
            }
        }
    }
}

} // namespace lsys
