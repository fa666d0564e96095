// SPDX-License-Identifier: MIT
// Joins glTF documents: adds items of one document to another and renumbers their references.
#pragma once

#include "runtime/export/take_apart.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace lsys {

using GltfJson = nlohmann::ordered_json;

inline constexpr const char* kMeshopt = "EXT_meshopt_compression";

/// Takes the array `list` out of `document`; empty if there is none.
[[nodiscard]] GltfJson take_list(GltfJson& document, const char* list);
[[nodiscard]] std::size_t count_of(const GltfJson& document, const char* list);
/// The object that states the place of a view in a stored buffer: its extension
/// EXT_meshopt_compression, or the view itself.
[[nodiscard]] GltfJson& stored_part(GltfJson& view);

/// New numbers of items, by their numbers in the document that they come from.
using GltfNumbers = std::vector<std::size_t>;
/// Renumbers the reference `key`, if there is one.
void renumber(GltfJson& holder, const char* key, const GltfNumbers& numbers);
void renumber_texture(GltfJson& texture, const GltfNumbers& images, const GltfNumbers& samplers);
void renumber_material(GltfJson& material, const GltfNumbers& textures);
/// Renumbers the primitives of a mesh, whose accessors now begin at `first_accessor`.
void renumber_mesh(GltfJson& mesh, std::size_t first_accessor, const GltfNumbers& materials);

/// Adds the items that `document` does not have yet, after `adapt` has set their references.
/// Returns the new numbers of all items.
template <typename Adapt>
GltfNumbers add_missing(GltfJson& document, const char* list, GltfJson items, const Adapt& adapt) {
    const TakesApart taken(items);
    GltfNumbers numbers;
    for (GltfJson& item : items) {
        adapt(item);
        GltfJson& existing = document[list];
        const auto found = std::find(existing.begin(), existing.end(), item);
        numbers.push_back(static_cast<std::size_t>(found - existing.begin()));
        if (found == existing.end()) {
            existing.push_back(std::move(item));
        }
    }
    return numbers;
}
/// Adds the name of an extension to `list`, "extensionsUsed" or "extensionsRequired".
void use_extension(GltfJson& document, const char* list, const std::string& name);

} // namespace lsys
