// SPDX-License-Identifier: MIT
#include "runtime/tiles/impl/tileset.h"

#include "runtime/tiles/impl/geodesy.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <utility>

namespace lsys {

namespace {

using Json = nlohmann::ordered_json;

/// `value` rounded to a micrometre, for short numbers.
double rounded(double value) {
    constexpr double kSteps = 1e6;
    return std::floor(value * kSteps + 0.5) / kSteps + 0.0; // without a negative zero
}

/// The matrix in column-major order. Axes are rounded to 12 decimals, which moves a point by less
/// than 1e-12 of the diameter of the Earth.
Json json_of(const glm::dmat4& matrix) {
    Json numbers = Json::array();
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            constexpr double kSteps = 1e12;
            const double value = matrix[column][row];
            numbers.push_back(column == 3 ? rounded(value)
                                          : std::floor(value * kSteps + 0.5) / kSteps + 0.0);
        }
    }
    return numbers;
}

Json json_of(const TileBox& box) {
    const glm::dvec3 middle = 0.5 * (box.low + box.high);
    // One millimetre larger, because numbers of tiles and tilesets are rounded.
    const glm::dvec3 half = 0.5 * (box.high - box.low) + glm::dvec3(1e-3);
    return {rounded(middle.x),
            rounded(middle.y),
            rounded(middle.z),
            rounded(half.x),
            0.0,
            0.0,
            0.0,
            rounded(half.y),
            0.0,
            0.0,
            0.0,
            rounded(half.z)};
}

class TilesetWriter {
public:
    TilesetWriter(const TilesetPlan& plan, const TileId& root) : plan_(plan), root_(root) {}

    std::string write() {
        Json node = node_of(root_);
        if (root_.level == 0) {
            node["transform"] = json_of(plan_.boxes.frame_of(root_));
        }
        Json tileset;
        tileset["asset"] = {{"version", "1.1"}, {"extras", {{"generator", plan_.generator}}}};
        // The error if the tileset is not shown; for the root tileset the side of the ground.
        tileset["geometricError"] =
            rounded(root_.level == 0 ? plan_.grid.square().width : plan_.levels[root_.level].error);
        tileset["root"] = std::move(node);
        return tileset.dump() + "\n";
    }

private:
    /// A tile that the tileset lists, with those below it, without a transform.
    Json node_of(const TileId& tile) {
        Json node = reference(tile, TileForest::content_path(tile));
        node["refine"] = "REPLACE";
        Json children = Json::array();
        const glm::dmat4 to_tile = inverse_of_frame(plan_.boxes.frame_of(tile));
        for (std::uint32_t i = 0; i < 4; ++i) {
            const TileId below{tile.level + 1, 2 * tile.column + (i & 1U), 2 * tile.row + i / 2};
            if (below.level >= plan_.levels.size() || !plan_.grid.has_ground(below)) {
                continue;
            }
            Json child =
                is_subtree_root(below.level, static_cast<std::uint32_t>(plan_.levels.size()) - 1)
                    ? reference(below, TileForest::tileset_path(below))
                    : node_of(below);
            child["transform"] = json_of(to_tile * plan_.boxes.frame_of(below));
            children.push_back(std::move(child));
        }
        if (!children.empty()) {
            node["children"] = std::move(children);
        }
        return node;
    }

    [[nodiscard]] Json reference(const TileId& tile, const std::string& path) const {
        Json node;
        node["boundingVolume"]["box"] = json_of(plan_.boxes.box_of(tile));
        node["geometricError"] = rounded(plan_.levels[tile.level].error);
        // Tilesets other than the root are two folders deeper.
        node["content"]["uri"] = root_.level == 0 ? path : "../../" + path;
        return node;
    }

    const TilesetPlan& plan_;
    const TileId& root_;
};

} // namespace

std::string make_tileset(const TilesetPlan& plan, const TileId& root) {
    return TilesetWriter(plan, root).write();
}

} // namespace lsys
