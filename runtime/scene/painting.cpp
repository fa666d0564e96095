// SPDX-License-Identifier: MIT
#include "runtime/scene/painting.h"

#include "runtime/base/random.h"
#include "runtime/scene/impl/scene_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <iterator>
#include <numbers>
#include <optional>

namespace lsys {

namespace {

/// A text as a TOML string.
std::string quoted(std::string_view text) {
    std::string result = "\"";
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') {
            result += '\\';
            result += c;
        } else if (byte < 0x20 || byte == 0x7F) {
            result += fmt::format("\\u{:04X}", byte);
        } else {
            result += c;
        }
    }
    return result + '"';
}

std::string table_text(const Painting& painting, std::span<const std::string> species) {
    constexpr std::size_t kNumbersInLine = 12;
    std::string text = "[painted]\n";
    if (!painting.trees.empty()) {
        text += "trees = [ # species, x, z, yaw in degrees, scale\n";
        for (const PaintedTree& tree : painting.trees) {
            // Degrees in double precision are converted back to exactly the same angle in radians.
            fmt::format_to(std::back_inserter(text), "  [{}, {}, {}, {}, {}],\n",
                           quoted(species[tree.species]), tree.x, tree.z,
                           static_cast<double>(tree.yaw) * 180.0 / std::numbers::pi, tree.scale);
        }
        text += "]\n";
    }
    if (!painting.erased.empty()) {
        text += "erased = [ # numbers of placed trees";
        for (std::size_t i = 0; i < painting.erased.size(); ++i) {
            fmt::format_to(std::back_inserter(text), "{}{},",
                           i % kNumbersInLine == 0 ? "\n  " : " ", painting.erased[i]);
        }
        text += "\n]\n";
    }
    return text;
}

/// The range of `[painted]` in a file: from its heading to the end of its last value.
struct TablePlace {
    std::size_t begin = 0;
    std::size_t end = 0;
};

TablePlace place_of(const SceneEntry& entry, std::string_view text) {
    TablePlace place{entry.value.span.begin, entry.value.span.end};
    if (place.begin >= text.size() || text[place.begin] != '[') {
        place.begin = entry.key_span.begin;
    }
    for (const SceneEntry& value : entry.value.entries) {
        place.end = std::max<std::size_t>(place.end, value.value.span.end);
    }
    place.end = std::min(text.find('\n', place.end), text.size());
    place.end += place.end < text.size() ? 1U : 0U;
    return place;
}

} // namespace

Tree painted_tree(const PaintedTree& painted, const Terrain& terrain) {
    Tree tree;
    tree.position = {painted.x, terrain.height(painted.x, painted.z), painted.z};
    tree.yaw = painted.yaw;
    tree.scale = painted.scale;
    const PhiloxBlock words =
        philox4x32({std::bit_cast<std::uint32_t>(painted.x),
                    std::bit_cast<std::uint32_t>(painted.z), painted.species, 0},
                   {0, 0});
    tree.number = kFirstPainted | words[0];
    tree.species = painted.species;
    return tree;
}

void apply_painting(const Painting& painting,
                    const Region& region,
                    const Terrain& terrain,
                    LargeVector<Tree>& trees) {
    if (!painting.erased.empty()) {
        trees.erase(std::remove_if(trees.begin(), trees.end(),
                                   [&](const Tree& tree) {
                                       return std::binary_search(painting.erased.begin(),
                                                                 painting.erased.end(),
                                                                 tree.number);
                                   }),
                    trees.end());
    }
    for (const PaintedTree& painted : painting.trees) {
        if (region.contains(painted.x, painted.z)) {
            trees.push_back(painted_tree(painted, terrain));
        }
    }
}

Result<std::string> with_painting(std::string_view scene,
                                  const Painting& painting,
                                  std::span<const std::string> species) {
    const Result<SceneValue> root = read_scene_table(scene);
    if (!root) {
        return root.error();
    }
    std::string text(scene);
    const std::string table = painting.empty() ? std::string() : table_text(painting, species);
    if (const SceneEntry* const entry = find_entry(root.value(), "painted")) {
        const TablePlace place = place_of(*entry, text);
        text.replace(place.begin, place.end - place.begin, table);
    } else if (!table.empty()) {
        text += text.empty() || text.back() == '\n' ? "\n" : "\n\n";
        text += table;
    }
    const std::optional<Scene> saved = read_scene(text);
    if (!saved || saved->painting != painting) {
        return Error{
            "`[painted]` is not a table of its own in this file, so it cannot be replaced"};
    }
    return text;
}

} // namespace lsys
