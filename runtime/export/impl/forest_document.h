// The document of a forest in glTF: what lies where in the buffer, and the text that says so.
// Written as often as it is asked for, and held nowhere.
#pragma once

#include "runtime/export/impl/forest_plan.h"
#include "runtime/export/impl/gltf_data.h"
#include "runtime/export/impl/pictures.h"
#include "runtime/export/impl/piece_writer.h"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace lsys {

/// The arrays of a kind, or of the ground.
struct ForestBlock {
    const Mesh* mesh = nullptr;
    const std::vector<std::uint32_t>* materials = nullptr; // among those of the scene
    GltfData data;
    std::vector<bool> coloured; // by materials of the mesh
    Bounds bounds;
    std::uint64_t offset = 0; // in the buffer
    std::size_t first_view = 0;
    std::size_t first_accessor = 0;

    /// Views before that of the indices.
    [[nodiscard]] std::size_t attributes() const { return data.views.size() - 1; }
};

class ForestDocument {
public:
    ForestDocument(const ForestScene& scene,
                   const ForestPlan& plan,
                   ForestForm form,
                   const ForestExportInfo& info);

    [[nodiscard]] std::uint64_t data_bytes() const { return bytes_; }
    /// Up to the size of the buffer, without what closes it.
    void put(PieceWriter& out);
    /// The buffer.
    void put_data(const std::function<bool(std::span<const std::byte>)>& write) const;

private:
    static constexpr std::size_t kNoBlock = ~std::size_t{0};
    template <typename... Arguments>
    void add(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
        fmt::format_to(std::back_inserter(text_), format, std::forward<Arguments>(arguments)...);
        if (text_.size() > kPieceBytes / 8) {
            out_->put({text_.data(), text_.size()});
            text_.clear();
        }
    }
    [[nodiscard]] const char* comma(std::size_t index) const { return index == 0 ? "" : ","; }
    [[nodiscard]] bool instanced() const { return form_ == ForestForm::Instanced; }

    void add_block(const Mesh& mesh, const std::vector<std::uint32_t>& materials);
    void add_extras();
    void add_nodes();
    void add_instanced_nodes();
    void add_expanded_nodes();
    void add_mesh(const std::string& name,
                  const ForestBlock& block,
                  std::span<const MeshPart> parts,
                  std::size_t& accessor);
    void add_meshes();
    void add_materials();
    void add_accessors();
    void add_attribute(const ForestBlock& block, std::size_t view);
    void add_views();
    /// Calls visit(block, parts) for each mesh, as they are numbered.
    template <typename Visit>
    void for_each_mesh(const Visit& visit) const;

    const ForestScene& scene_;
    const ForestPlan& plan_;
    ForestForm form_;
    const ForestExportInfo& info_;
    ForestMaterials materials_;
    std::vector<ForestBlock> blocks_;
    std::vector<std::size_t> block_of_kind_;
    std::size_t ground_block_ = kNoBlock;
    std::vector<std::uint32_t> mesh_of_instance_;
    /// Numbers in the file, by material of the scene and whether vertices are coloured.
    std::map<std::pair<std::uint32_t, bool>, std::size_t> material_numbers_;
    Pictures pictures_;
    std::vector<std::string> images_;
    std::size_t transforms_view_ = 0;
    std::size_t first_image_view_ = 0;
    std::size_t first_group_accessor_ = 0;
    std::uint64_t transforms_offset_ = 0;
    std::uint64_t bytes_ = 0;
    PieceWriter* out_ = nullptr;
    fmt::memory_buffer text_;
};

template <typename Visit>
void ForestDocument::for_each_mesh(const Visit& visit) const {
    if (ground_block_ != kNoBlock) {
        visit(blocks_[ground_block_], std::span<const MeshPart>(scene_.ground->parts));
    }
    for (std::size_t k = 0; k < plan_.kinds().size(); ++k) {
        const ForestKind& kind = plan_.kinds()[k];
        for (std::uint32_t i = 0; i < kind.cache->instances.size(); ++i) {
            if (plan_.uses()[kind.first + i] > 0) {
                visit(blocks_[block_of_kind_[k]], kind.meshes->parts_of(i));
            }
        }
    }
}

} // namespace lsys
