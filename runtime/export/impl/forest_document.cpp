#include "runtime/export/impl/forest_document.h"

#include "runtime/export/impl/forest_formats.h"
#include "runtime/export/impl/formats.h"
#include "runtime/export/impl/gltf_parts.h"
#include "runtime/export/impl/text.h"

#include <algorithm>
#include <array>

namespace lsys {

namespace {

/// A number above 2^53 is not safe with every reader of JSON.
std::string json_number(std::uint64_t value) {
    return value < std::uint64_t{1} << 53U ? fmt::format("{}", value)
                                           : fmt::format("\"{}\"", value);
}

} // namespace

void ForestDocument::add_extras() {
    add(R"("extras":{{"scene":"{}","key":{},"trees":{},"branches":{},"triangles":{},"species":[)",
        json_text(info_.name), json_number(scene_.forest.key), scene_.forest.trees.size(),
        plan_.branches(), plan_.triangles());
    for (std::size_t k = 0; k < plan_.kinds().size(); ++k) {
        const ForestKind& kind = plan_.kinds()[k];
        const ForestSpecies& species = scene_.forest.species[kind.species];
        add(R"({}{{"name":"{}","n":{},"heroes":{},"instances":{},"trees":{}}})", comma(k),
            json_text(species.name), species.stages[kind.stage].generations, kind.cache->heroes,
            kind.cache->instances.size(), kind.trees);
    }
    add("]}}");
}

/// Nodes: the forest, the ground, the cells, then what stands in them.
void ForestDocument::add_nodes() {
    const std::size_t ground = ground_block_ == kNoBlock ? 0 : 1;
    const std::size_t cells = plan_.cells().size();
    add(R"("scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"name":"forest","children":[)");
    for (std::size_t i = 0; i < ground + cells; ++i) {
        add("{}{}", comma(i), 1 + i);
    }
    add("],");
    add_extras();
    add("}}");
    if (ground > 0) {
        add(R"(,{{"name":"ground","mesh":0}})");
    }
    std::uint64_t child = 1 + ground + cells;
    for (const ForestCell& cell : plan_.cells()) {
        add(R"(,{{"name":"cell {} {}","children":[)", cell.x, cell.z);
        const std::uint64_t count = instanced() ? cell.group_count : cell.branches;
        for (std::uint64_t i = 0; i < count; ++i) {
            add("{}{}", comma(i), child++);
        }
        add("]}}");
    }
    if (instanced()) {
        add_instanced_nodes();
    } else {
        add_expanded_nodes();
    }
    add("],");
}

void ForestDocument::add_instanced_nodes() {
    std::size_t accessor = first_group_accessor_;
    for (const ForestGroup& group : plan_.groups()) {
        add(R"(,{{"mesh":{},"extensions":{{"EXT_mesh_gpu_instancing":{{"attributes":{{)"
            R"("TRANSLATION":{},"ROTATION":{},"SCALE":{}}}}}}}}})",
            mesh_of_instance_[group.instance], accessor, accessor + 1, accessor + 2);
        accessor += 3;
    }
}

void ForestDocument::add_expanded_nodes() {
    for (const ForestCell& cell : plan_.cells()) {
        plan_.for_each_branch(cell, [&](const ForestKind& kind, std::uint32_t instance,
                                        const BranchInstance& branch) {
            if (plan_.uses()[instance] == 0) {
                return;
            }
            const InstancePose pose = pose_of(branch, kind.cache->instances[branch.instance]);
            const glm::vec3& t = pose.translation;
            const glm::quat& r = pose.rotation;
            add(R"(,{{"mesh":{},"translation":[{},{},{}],"rotation":[{},{},{},{}],)"
                R"("scale":[{},{},{}]}})",
                mesh_of_instance_[instance], t.x, t.y, t.z, r.x, r.y, r.z, r.w, pose.scale,
                pose.scale, pose.scale);
        });
    }
}

void ForestDocument::add_mesh(const std::string& name,
                              const ForestBlock& block,
                              std::span<const MeshPart> parts,
                              std::size_t& accessor) {
    static constexpr std::array<std::pair<GltfArray, const char*>, 5> kAttributes{{
        {GltfArray::Positions, "POSITION"},
        {GltfArray::Normals, "NORMAL"},
        {GltfArray::TextureCoordinates, "TEXCOORD_0"},
        {GltfArray::Tangents, "TANGENT"},
        {GltfArray::Colours, "COLOR_0"},
    }};
    add(R"({{"name":"{}","primitives":[)", json_text(name));
    for (std::size_t p = 0; p < parts.size(); ++p) {
        const std::uint32_t material = parts[p].material;
        add(R"({}{{"attributes":{{)", comma(p));
        for (std::size_t a = 0; a < block.attributes(); ++a) {
            const GltfArray array = block.data.views[a].array;
            const auto named =
                std::find_if(kAttributes.begin(), kAttributes.end(),
                             [array](const auto& each) { return each.first == array; });
            if (array != GltfArray::Colours || block.coloured[material]) {
                add(R"({}"{}":{})", comma(a), named->second, block.first_accessor + a);
            }
        }
        add(R"(}},"indices":{},"material":{}}})", accessor++,
            material_numbers_.at({(*block.materials)[material], block.coloured[material]}));
    }
    add("]}}");
}

void ForestDocument::add_meshes() {
    add(R"("meshes":[)");
    std::size_t accessor = 0;
    for (const ForestBlock& block : blocks_) {
        accessor += block.attributes();
    }
    std::size_t written = 0;
    if (ground_block_ != kNoBlock) {
        add_mesh("ground", blocks_[ground_block_], scene_.ground->parts, accessor);
        ++written;
    }
    for (std::size_t k = 0; k < plan_.kinds().size(); ++k) {
        const ForestKind& kind = plan_.kinds()[k];
        const ForestSpecies& species = scene_.forest.species[kind.species];
        const std::string name =
            species.stages.size() == 1
                ? species.name
                : fmt::format("{} n{}", species.name, species.stages[kind.stage].generations);
        for (std::uint32_t i = 0; i < kind.cache->instances.size(); ++i) {
            if (plan_.uses()[kind.first + i] > 0) {
                add("{}", comma(written++));
                add_mesh(fmt::format("{} {}", name, i), blocks_[block_of_kind_[k]],
                         kind.meshes->parts_of(i), accessor);
            }
        }
    }
    add("],");
}

void ForestDocument::add_materials() {
    std::vector<std::pair<std::uint32_t, bool>> list(material_numbers_.size());
    for (const auto& [key, number] : material_numbers_) {
        list[number] = key;
    }
    add(R"("materials":[)");
    for (std::size_t i = 0; i < list.size(); ++i) {
        const auto& [material, coloured] = list[i];
        add("{}{}", comma(i),
            material_json(materials_.samples.materials[material], pictures_.of_materials[material],
                          coloured));
    }
    add("],");
    if (!pictures_.list.empty()) {
        add("{}", images_json(pictures_.list, first_image_view_));
    }
}

void ForestDocument::add_attribute(const ForestBlock& block, std::size_t view) {
    constexpr int kByte = 5121;
    constexpr int kFloat = 5126;
    const GltfArray array = block.data.views[view].array;
    const bool colours = array == GltfArray::Colours;
    const bool four = colours || array == GltfArray::Tangents;
    add(R"({{"bufferView":{},"componentType":{},"count":{},"type":"VEC{}")",
        block.first_view + view, colours ? kByte : kFloat, block.mesh->positions.size(),
        four                                     ? 4
        : array == GltfArray::TextureCoordinates ? 2
                                                 : 3);
    if (array == GltfArray::Positions) {
        // As exact as the data: the shortest text of a float reads back another double.
        const glm::dvec3 low(block.bounds.low);
        const glm::dvec3 high(block.bounds.high);
        add(R"(,"min":[{},{},{}],"max":[{},{},{}])", low.x, low.y, low.z, high.x, high.y, high.z);
    }
    add("{}}}", colours ? R"(,"normalized":true)" : "");
}

void ForestDocument::add_accessors() {
    constexpr int kUnsigned = 5125;
    add(R"("accessors":[)");
    std::size_t written = 0;
    for (const ForestBlock& block : blocks_) {
        for (std::size_t i = 0; i < block.attributes(); ++i) {
            add("{}", comma(written++));
            add_attribute(block, i);
        }
    }
    for_each_mesh([&](const ForestBlock& block, std::span<const MeshPart> parts) {
        for (const MeshPart& part : parts) {
            add(R"({}{{"bufferView":{},"byteOffset":{},"componentType":{},"count":{},)"
                R"("type":"SCALAR"}})",
                comma(written++), block.first_view + block.attributes(),
                part.first_index * sizeof(std::uint32_t), kUnsigned, part.index_count);
        }
    });
    if (instanced()) {
        const auto transform = [&](std::uint64_t offset, std::uint64_t count, int width) {
            add(R"(,{{"bufferView":{},"byteOffset":{},"componentType":5126,"count":{},)"
                R"("type":"VEC{}"}})",
                transforms_view_, offset, count, width);
        };
        for (const ForestGroup& group : plan_.groups()) {
            const std::uint64_t offset = kInstanceBytes * group.first;
            transform(offset, group.count, 3);
            transform(offset + kTranslationBytes * group.count, group.count, 4);
            transform(offset + (kTranslationBytes + kRotationBytes) * group.count, group.count, 3);
        }
    }
    add("],");
}

void ForestDocument::add_views() {
    constexpr int kVertices = 34962;
    constexpr int kIndices = 34963;
    add(R"("bufferViews":[)");
    std::size_t written = 0;
    for (const ForestBlock& block : blocks_) {
        for (const GltfView& view : block.data.views) {
            add(R"({}{{"buffer":0,"byteOffset":{},"byteLength":{},"target":{}}})", comma(written++),
                block.offset + view.offset, view.bytes,
                view.array == GltfArray::Indices ? kIndices : kVertices);
        }
    }
    std::uint64_t offset = transforms_offset_;
    if (first_image_view_ > transforms_view_) {
        const std::uint64_t bytes = kInstanceBytes * plan_.branches();
        add(R"({}{{"buffer":0,"byteOffset":{},"byteLength":{}}})", comma(written++), offset, bytes);
        offset += bytes;
    }
    for (const std::string& image : images_) {
        add(R"({}{{"buffer":0,"byteOffset":{},"byteLength":{}}})", comma(written++), offset,
            image.size());
        offset += image.size();
    }
    add("],");
}

void ForestDocument::put(PieceWriter& out) {
    out_ = &out;
    text_.clear();
    add(R"({{"asset":{{"version":"2.0","generator":"{}"}},)", json_text(info_.generator));
    if (first_image_view_ > transforms_view_) {
        add(R"("extensionsUsed":["EXT_mesh_gpu_instancing"],)"
            R"("extensionsRequired":["EXT_mesh_gpu_instancing"],)");
    }
    add_nodes();
    add_meshes();
    add_materials();
    add_accessors();
    add_views();
    add(R"("buffers":[{{"byteLength":{})", bytes_);
    out.put({text_.data(), text_.size()});
    text_.clear();
}

} // namespace lsys
