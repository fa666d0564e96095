// SPDX-License-Identifier: MIT
#include "runtime/export/impl/gltf_join.h"

namespace lsys {

GltfJson take_list(GltfJson& document, const char* list) {
    return document.contains(list) ? std::move(document[list]) : GltfJson::array();
}

std::size_t count_of(const GltfJson& document, const char* list) {
    return document.contains(list) ? document[list].size() : 0;
}

GltfJson& stored_part(GltfJson& view) {
    return view.contains("extensions") && view["extensions"].contains(kMeshopt)
               ? view["extensions"][kMeshopt]
               : view;
}

void renumber(GltfJson& holder, const char* key, const GltfNumbers& numbers) {
    if (holder.contains(key)) {
        holder[key] = numbers[holder[key].get<std::size_t>()];
    }
}

void renumber_texture(GltfJson& texture, const GltfNumbers& images, const GltfNumbers& samplers) {
    renumber(texture, "source", images);
    renumber(texture, "sampler", samplers);
}

void renumber_material(GltfJson& material, const GltfNumbers& textures) {
    GltfJson& surface = material["pbrMetallicRoughness"];
    if (surface.contains("baseColorTexture")) {
        renumber(surface["baseColorTexture"], "index", textures);
    }
    if (material.contains("normalTexture")) {
        renumber(material["normalTexture"], "index", textures);
    }
}

void renumber_mesh(GltfJson& mesh, std::size_t first_accessor, const GltfNumbers& materials) {
    for (GltfJson& primitive : mesh["primitives"]) {
        for (auto& [name, accessor] : primitive["attributes"].items()) {
            accessor = accessor.get<std::size_t>() + first_accessor;
        }
        primitive["indices"] = primitive["indices"].get<std::size_t>() + first_accessor;
        renumber(primitive, "material", materials);
    }
}

void use_extension(GltfJson& document, const char* list, const std::string& name) {
    GltfJson& used = document[list];
    if (std::find(used.begin(), used.end(), name) == used.end()) {
        used.push_back(name);
    }
}

} // namespace lsys
