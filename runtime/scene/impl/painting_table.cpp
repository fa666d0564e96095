// SPDX-License-Identifier: MIT
#include "runtime/scene/impl/table_reader.h"
#include "runtime/scene/impl/tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numbers>
#include <string_view>
#include <vector>

namespace lsys {

namespace {

constexpr std::size_t kItemsPerTree = 5;
constexpr double kMinScale = 1e-3;
constexpr double kMaxScale = 1e3;

/// One row of `trees`: species, x, z, yaw, scale.
void read_tree(const SceneValue& row,
               const std::vector<std::string_view>& names,
               TableReader& reader,
               Painting& painting) {
    if (row.kind != SceneValueKind::List || row.items.size() != kItemsPerTree ||
        row.items[0].kind != SceneValueKind::Text) {
        reader.report_bad_value(
            row.span, "a painted tree is a list: its species' name, x, z, yaw in degrees, scale");
        return;
    }
    const auto species = std::find(names.begin(), names.end(), row.items[0].text);
    if (species == names.end()) {
        Diagnostic& error = reader.report_bad_value(
            row.items[0].span, fmt::format("there is no species `{}`", row.items[0].text));
        if (const auto nearest = nearest_name(row.items[0].text, names)) {
            error.help.push_back(fmt::format("did you mean `{}`?", *nearest));
        }
        return;
    }
    const NumberRange place{-kMaxCoordinate, kMaxCoordinate, false, "m"};
    const auto x = reader.number_of(row.items[1], "x of a painted tree", place);
    const auto z = reader.number_of(row.items[2], "z of a painted tree", place);
    const auto yaw = reader.number_of(row.items[3], "the yaw of a painted tree",
                                      {-360.0, 360.0, false, "degrees"});
    const auto scale = reader.number_of(row.items[4], "the scale of a painted tree",
                                        {kMinScale, kMaxScale, false, {}});
    if (x && z && yaw && scale) {
        painting.trees.push_back({static_cast<std::uint16_t>(species - names.begin()),
                                  static_cast<float>(*x), static_cast<float>(*z),
                                  static_cast<float>(*yaw * std::numbers::pi / 180.0),
                                  static_cast<float>(*scale)});
    }
}

} // namespace

void read_painting_table(const SceneValue* table, Scene& scene, Diagnostics& diagnostics) {
    TableReader reader(table, "[painted]", diagnostics);
    const auto list = [&](std::string_view key) -> const std::vector<SceneValue>* {
        const SceneEntry* const entry = reader.entry(key);
        if (entry == nullptr) {
            return nullptr;
        }
        if (entry->value.kind != SceneValueKind::List) {
            reader.report_bad_value(entry->value.span, fmt::format("`{}` must be a list", key));
            return nullptr;
        }
        if (entry->value.items.size() > kMaxPainted) {
            reader.report_bad_value(entry->value.span,
                                    fmt::format("`{}` has more than 10,000,000 trees", key));
            return nullptr;
        }
        return &entry->value.items;
    };
    std::vector<std::string_view> names;
    for (const SceneSpecies& species : scene.species) {
        names.push_back(species.name);
    }
    if (const std::vector<SceneValue>* const trees = list("trees")) {
        for (const SceneValue& row : *trees) {
            read_tree(row, names, reader, scene.painting);
        }
    }
    if (const std::vector<SceneValue>* const erased = list("erased")) {
        for (const SceneValue& number : *erased) {
            if (const auto value =
                    reader.integer_of(number, "the number of an erased tree",
                                      {0, std::numeric_limits<std::uint32_t>::max()})) {
                scene.painting.erased.push_back(static_cast<std::uint32_t>(*value));
            }
        }
        std::sort(scene.painting.erased.begin(), scene.painting.erased.end());
    }
    reader.finish();
}

} // namespace lsys
