// SPDX-License-Identifier: MIT
#include "runtime/scene/season.h"

#include "runtime/scene/impl/scene_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace lsys {

namespace {

/// Where a new key is inserted: the start of the line after the last key above the tables; without
/// such a key, the start of the first line with a table.
std::size_t place_of_new_key(const SceneValue& root, std::string_view text) {
    std::size_t end = 0;
    for (const SceneEntry& entry : root.entries) {
        const bool is_table =
            entry.value.kind == SceneValueKind::Table ||
            (entry.value.kind == SceneValueKind::List && !entry.value.items.empty() &&
             entry.value.items.front().kind == SceneValueKind::Table);
        if (!is_table) {
            end = std::max<std::size_t>(end, entry.value.span.end);
        }
    }
    if (end != 0) {
        return std::min(text.find('\n', end), text.size() - 1) + 1;
    }
    if (text.starts_with('[')) {
        return 0;
    }
    const std::size_t table = text.find("\n[");
    return table == std::string_view::npos ? text.size() : table + 1;
}

bool has_season(std::string_view text, float season) {
    const std::optional<Scene> scene = read_scene(text);
    return scene &&
           std::all_of(scene->species.begin(), scene->species.end(),
                       [season](const SceneSpecies& each) { return each.season == season; });
}

} // namespace

Result<std::string> with_season(std::string_view scene, float season) {
    const Result<SceneValue> root = read_scene_table(scene);
    if (!root) {
        return root.error();
    }
    std::string text(scene);
    if (const SceneEntry* const entry = find_entry(root.value(), "season")) {
        text.replace(entry->value.span.begin, entry->value.span.end - entry->value.span.begin,
                     fmt::format("{}", season));
    } else {
        text.insert(place_of_new_key(root.value(), text), fmt::format("season = {}\n", season));
    }
    if (!has_season(text, season)) {
        return Error{"`season` cannot be replaced in this file"};
    }
    return text;
}

} // namespace lsys
