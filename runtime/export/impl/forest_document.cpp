// SPDX-License-Identifier: MIT
#include "runtime/export/impl/forest_document.h"

#include "runtime/export/impl/forest_formats.h"
#include "runtime/forest/surroundings.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace lsys {

namespace {

constexpr int kArrayBuffer = 34962;
constexpr int kElementArrayBuffer = 34963;

/// The view of an array: in buffer 0, or for a compressed array in buffer 1, which holds decoded
/// items. Vertices have a stride, which glTF requires because the accessors of slices share the
/// view.
void put_array_view(JsonWriter& json, const ForestView& view) {
    const bool is_indices = view.array == GltfArray::Indices;
    const bool compressed = !view.compressed.empty();
    json.object().member("buffer", compressed ? 1 : 0);
    json.member("byteOffset", compressed ? view.decoded_offset : view.offset);
    json.member("byteLength", view.item_bytes());
    if (!is_indices) {
        json.member("byteStride", view.type.stride);
    }
    json.member("target", is_indices ? kElementArrayBuffer : kArrayBuffer);
    if (compressed) {
        put_packed_view(json, {view.offset, view.bytes, view.type.stride, view.count, is_indices});
    }
    json.end();
}

/// The view of compressed transforms, without a target, because the items are not vertices.
void put_transform_view(JsonWriter& json, const ForestView& view) {
    json.object().member("buffer", 1).member("byteOffset", view.decoded_offset);
    json.member("byteLength", view.item_bytes());
    put_packed_view(json,
                    {view.offset, view.bytes, view.type.stride, view.count, false, view.filter});
    json.end();
}

/// A view of bytes that are not vertices.
void put_plain_view(JsonWriter& json, std::uint64_t offset, std::uint64_t bytes) {
    json.object().member("buffer", 0).member("byteOffset", offset);
    json.member("byteLength", bytes).end();
}

} // namespace

void ForestDocument::put_extras(JsonWriter& json) const {
    json.object("extras").member("scene", info_.name).member("key", scene_.forest.key);
    json.member("trees", scene_.forest.trees.size()).member("branches", plan_.branch_count());
    json.member("triangles", plan_.triangle_count()).array("species");
    for (const ExportedStage& stage : plan_.stages()) {
        const ForestSpecies& species = scene_.forest.species[stage.species];
        json.object().member("name", species.name);
        json.member("n", species.stages[stage.stage_index].generations);
        if (species.senses_surroundings) {
            json.member("surroundings", kSurroundingsNames[stage.stage_index % kSurroundings]);
        }
        json.member("heroes", stage.cache->heroes);
        json.member("instances", stage.cache->instances.size()).member("trees", stage.trees).end();
    }
    json.end().end();
}

/// Nodes: the forest, the ground, the cells, then the branches in them.
void ForestDocument::put_nodes(JsonWriter& json) const {
    const std::size_t ground = ground_surface_ == kNoSurface ? 0 : 1;
    const std::size_t cells = plan_.cells().size();
    json.member("scene", 0).array("scenes").object().member("nodes", {0}).end().end();
    json.array("nodes").object().member("name", "forest");
    if (const glm::vec3 at = glm::vec3(0.0F) - info_.pivot; at != glm::vec3(0.0F)) {
        json.member("translation", {at.x, at.y, at.z});
    }
    json.array("children");
    for (std::size_t i = 0; i < ground + cells; ++i) {
        json.value(1 + i);
    }
    json.end();
    put_extras(json);
    json.end();
    if (ground > 0) {
        json.object().member("name", "ground").member("mesh", 0).end(); // never quantised
    }
    std::uint64_t child = 1 + ground + cells;
    std::vector<bool> written(collisions_.size()); // by instance; see for_each_collider()
    for (const ForestCell& cell : plan_.cells()) {
        json.object().member("name", fmt::format("cell {} {}", cell.x, cell.z));
        json.array("children");
        std::uint64_t count = instanced() ? cell.group_count : cell.branches;
        // Nodes of collision shapes are siblings of the node of their group, and follow it.
        for (std::size_t i = 0; instanced() && !collisions_.empty() && i < cell.group_count; ++i) {
            const std::uint32_t instance = plan_.groups()[cell.first_group + i].instance;
            if (!(written[instance] && collides_once())) {
                written[instance] = true;
                count += collisions_[instance].shapes.size();
            }
        }
        for (std::uint64_t i = 0; i < count; ++i) {
            json.value(child++);
        }
        json.end().end();
    }
    if (instanced()) {
        put_instanced_nodes(json);
    } else {
        put_expanded_nodes(json);
    }
    json.end();
}

void ForestDocument::put_instanced_nodes(JsonWriter& json) const {
    std::size_t accessor = first_group_accessor_;
    std::vector<bool> written(collisions_.size());
    for (const ForestGroup& group : plan_.groups()) {
        const auto put_instances = [&](std::size_t mesh) {
            json.member("mesh", mesh).object("extensions");
            json.object("EXT_mesh_gpu_instancing").object("attributes");
            json.member("TRANSLATION", accessor).member("ROTATION", accessor + 1);
            json.member("SCALE", accessor + 2).end().end().end().end();
        };
        json.object();
        put_instances(mesh_of_instance_[group.instance]);
        if (!collisions_.empty() && !(written[group.instance] && collides_once())) {
            written[group.instance] = true;
            const std::vector<CollisionShape>& shapes = collisions_[group.instance].shapes;
            for (std::size_t i = 0; i < shapes.size(); ++i) {
                json.object().member("name", shapes[i].name);
                put_instances(collision_meshes_[group.instance] + i);
            }
        }
        accessor += 3;
    }
}

std::uint64_t ForestDocument::node_count() const {
    std::uint64_t count = 1 + (ground_surface_ == kNoSurface ? 0 : 1) + plan_.cells().size() +
                          (instanced() ? plan_.groups().size() : plan_.branch_count());
    for_each_collider(
        [&](std::uint32_t instance) { count += collisions_[instance].shapes.size(); });
    return count;
}

std::string ForestDocument::mesh_name(const ExportedStage& stage, std::uint32_t instance) const {
    const ForestSpecies& species = scene_.forest.species[stage.species];
    const std::string stage_text = stage_name(species, stage.stage_index);
    return stage_text.empty() ? fmt::format("{} {}", species.name, instance)
                              : fmt::format("{} {} {}", species.name, stage_text, instance);
}

void ForestDocument::put_expanded_nodes(JsonWriter& json) const {
    std::uint64_t child =
        1 + (ground_surface_ == kNoSurface ? 0 : 1) + plan_.cells().size() + plan_.branch_count();
    std::vector<bool> written(collisions_.size());
    for (const ForestCell& cell : plan_.cells()) {
        plan_.for_each_branch(cell, [&](const ExportedStage& stage, std::uint32_t instance,
                                        const BranchInstance& branch) {
            if (plan_.instance_counts()[instance] == 0) {
                return;
            }
            const auto number = static_cast<std::size_t>(&stage - plan_.stages().data());
            const InstancePose pose = pose_of_items(
                pose_of(branch, stage.cache->instances[branch.instance]), grids_[number]);
            const glm::vec3& t = pose.translation;
            const glm::quat& r = pose.rotation;
            json.object().member("mesh", mesh_of_instance_[instance]);
            if (!collisions_.empty() && !collisions_[instance].shapes.empty() &&
                !(written[instance] && collides_once())) {
                written[instance] = true;
                json.array("children");
                for (std::size_t i = 0; i < collisions_[instance].shapes.size(); ++i) {
                    json.value(child++);
                }
                json.end();
            }
            json.member("translation", {t.x, t.y, t.z});
            json.member("rotation", {r.x, r.y, r.z, r.w});
            json.member("scale", {pose.scale, pose.scale, pose.scale}).end();
        });
    }
    for_each_collider([&](std::uint32_t instance) {
        put_collision_nodes(json, collisions_[instance], collision_meshes_[instance]);
    });
}

void ForestDocument::put_mesh(JsonWriter& json,
                              const std::string& name,
                              const ForestSurface& surface,
                              std::span<const MeshPart> parts,
                              std::size_t& accessor) const {
    json.object().member("name", name).array("primitives");
    for (const MeshPart& part : parts) {
        const ForestBlock& block = surface.blocks[part.material];
        json.object().object("attributes");
        for (const ForestView& view : block.attributes) {
            json.member(attribute_name(view.array), accessor++);
        }
        json.end().member("indices", accessor++);
        const std::pair key((*surface.materials)[part.material], block.coloured);
        json.member("material", material_numbers_.at(key)).end();
    }
    json.end().end();
}

void ForestDocument::put_meshes(JsonWriter& json) const {
    json.array("meshes");
    std::size_t accessor = 0;
    if (ground_surface_ != kNoSurface) {
        put_mesh(json, "ground", surfaces_[ground_surface_], scene_.ground->parts, accessor);
    }
    for (std::size_t k = 0; k < plan_.stages().size(); ++k) {
        const ExportedStage& stage = plan_.stages()[k];
        for (std::uint32_t i = 0; i < stage.cache->instances.size(); ++i) {
            if (plan_.instance_counts()[stage.first + i] > 0) {
                put_mesh(json, mesh_name(stage, i), surfaces_[surface_of_stage_[k]],
                         stage.meshes->parts_of(i), accessor);
            }
        }
    }
    accessor = first_collision_accessor_;
    for (const GltfCollision& collision : collisions_) {
        put_collision_meshes(json, collision, accessor);
        accessor += collision.accessor_count();
    }
    json.end();
}

void ForestDocument::put_materials(JsonWriter& json) const {
    std::vector<std::pair<std::uint32_t, bool>> list(material_numbers_.size());
    for (const auto& [key, number] : material_numbers_) {
        list[number] = key;
    }
    json.array("materials");
    for (const auto& [material, coloured] : list) {
        const Material& shown = materials_.samples.materials[material];
        put_material(json, shown, pictures_.of_materials[material],
                     {shown.name, coloured ? glm::vec3(1.0F) : glm::vec3(shown.colour),
                      texture_forms_[material].transform});
    }
    json.end();
    if (!pictures_.list.empty()) {
        put_images(json, pictures_.list, first_image_view_);
    }
}

void ForestDocument::put_part_accessors(JsonWriter& json,
                                        const ForestSurface& surface,
                                        std::size_t part) {
    const MeshPart& drawn = surface.mesh->parts[part];
    const Slice& slice = surface.sliced.slices[part];
    const ForestBlock& block = surface.blocks[drawn.material];
    for (std::size_t i = 0; i < block.attributes.size(); ++i) {
        const ForestView& view = block.attributes[i];
        begin_accessor(json, {block.first_view + i, view.type.stride * slice.first_vertex,
                              view.type.component, slice.vertex_count, view.type.type});
        if (view.array == GltfArray::Positions) {
            put_position_bounds(json, block.form, slice.bounds);
        }
        if (view.type.normalized) {
            json.member("normalized", true);
        }
        json.end();
    }
    const std::size_t wide_view = block.first_view + block.attributes.size();
    const std::size_t narrow_view = wide_view + (block.wide_indices.count > 0 ? 1 : 0);
    if (slice.is_wide()) {
        begin_accessor(json, {wide_view, sizeof(std::uint32_t) * slice.first_index,
                              kGltfUnsignedInt, drawn.index_count, "SCALAR"})
            .end();
    } else {
        begin_accessor(json, {narrow_view, sizeof(std::uint16_t) * slice.first_index,
                              kGltfUnsignedShort, drawn.index_count, "SCALAR"})
            .end();
    }
}

void ForestDocument::put_accessors(JsonWriter& json) const {
    json.array("accessors");
    for_each_mesh([&](const ForestSurface& surface, std::span<const MeshPart> parts) {
        const auto first = static_cast<std::size_t>(parts.data() - surface.mesh->parts.data());
        for (std::size_t part = first; part < first + parts.size(); ++part) {
            put_part_accessors(json, surface, part);
        }
    });
    if (instanced()) {
        put_group_accessors(json);
    }
    std::size_t view = first_collision_view_;
    for (const GltfCollision& collision : collisions_) {
        put_collision_accessors(json, collision, view);
        view += collision.shapes.empty() ? 0U : 2U;
    }
    json.end();
}

void ForestDocument::put_group_accessors(JsonWriter& json) const {
    std::size_t first_view = transforms_view_;
    std::size_t group = 0;
    for (const PackedTransforms& packed : packed_) {
        for (const std::size_t end = group + packed.group_count; group < end; ++group) {
            const auto& [instance, first, count] = plan_.groups()[group];
            for (std::size_t i = 0; i < packed.views.size(); ++i) {
                const GltfItem& type = packed.views[i].type;
                begin_accessor(json, {first_view + i, type.stride * (first - packed.first),
                                      type.component, count, type.type});
                if (type.normalized) {
                    json.member("normalized", true);
                }
                json.end();
            }
        }
        first_view += packed.views.size();
    }
    if (!packed_.empty()) {
        return;
    }
    for (const ForestGroup& floats : plan_.groups()) {
        std::uint64_t offset = kInstanceBytes * floats.first;
        const auto put_transform = [&](std::uint64_t bytes, std::string_view type) {
            begin_accessor(json, {transforms_view_, offset, kGltfFloat, floats.count, type}).end();
            offset += bytes * floats.count;
        };
        put_transform(kTranslationBytes, "VEC3");
        put_transform(kRotationBytes, "VEC4");
        put_transform(kScaleBytes, "VEC3");
    }
}

void ForestDocument::put_views(JsonWriter& json) const {
    json.array("bufferViews");
    for (const ForestSurface& surface : surfaces_) {
        for (const ForestBlock& block : surface.blocks) {
            for (const ForestView& view : block.attributes) {
                put_array_view(json, view);
            }
            for (const ForestView* view : {&block.wide_indices, &block.narrow_indices}) {
                if (view->count > 0) {
                    put_array_view(json, *view);
                }
            }
        }
    }
    for (const PackedTransforms& packed : packed_) {
        for (const ForestView& view : packed.views) {
            put_transform_view(json, view);
        }
    }
    std::uint64_t offset = transforms_offset_;
    if (packed_.empty() && first_image_view_ > transforms_view_) {
        const std::uint64_t bytes = kInstanceBytes * plan_.branch_count();
        put_plain_view(json, offset, bytes);
        offset += bytes;
    }
    for (const std::string& image : images_) {
        put_plain_view(json, offset, image.size());
        offset += image.size();
    }
    for (const GltfCollision& collision : collisions_) {
        put_collision_views(json, collision, offset);
        offset += collision.byte_count();
    }
    json.end();
}

void ForestDocument::put_extensions(JsonWriter& json) const {
    std::vector<std::string_view> names;
    if (first_image_view_ > transforms_view_) {
        names.emplace_back("EXT_mesh_gpu_instancing");
    }
    if (info_.compression != ExportCompression::None) {
        names.emplace_back("KHR_mesh_quantization");
    }
    if (std::any_of(texture_forms_.begin(), texture_forms_.end(),
                    [](const GltfTextureForm& form) { return form.transform.has_value(); })) {
        names.emplace_back("KHR_texture_transform");
    }
    if (decoded_bytes_ > 0) {
        names.emplace_back("EXT_meshopt_compression");
    }
    if (names.empty()) {
        return;
    }
    for (const char* const list : {"extensionsUsed", "extensionsRequired"}) {
        json.array(list);
        for (const std::string_view name : names) {
            json.value(name);
        }
        json.end();
    }
}

void ForestDocument::put_members(JsonWriter& json) const {
    json.object("asset").member("version", "2.0").member("generator", info_.generator).end();
    put_extensions(json);
    put_nodes(json);
    put_meshes(json);
    put_materials(json);
    put_accessors(json);
    put_views(json);
}

} // namespace lsys
