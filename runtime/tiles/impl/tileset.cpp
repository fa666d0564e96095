// SPDX-License-Identifier: MIT
#include "runtime/tiles/impl/tileset.h"

#include "runtime/export/tile_document.h"
#include "runtime/tiles/impl/geodesy.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <utility>

namespace lsys {

using Json = nlohmann::ordered_json;

glm::dmat4 frame_in_root(const TileBoxes& boxes, const TileId& tile) {
    return inverse_of_frame(boxes.frame_of({})) * boxes.frame_of(tile);
}

namespace {

Json json_of(const TileBox& box) {
    const glm::dvec3 middle = 0.5 * (box.low + box.high);
    // Boxes are enlarged by one millimetre, because numbers in tiles and tilesets are rounded.
    const glm::dvec3 half = 0.5 * (box.high - box.low) + glm::dvec3(1e-3);
    return {rounded_for_tileset(middle.x),
            rounded_for_tileset(middle.y),
            rounded_for_tileset(middle.z),
            rounded_for_tileset(half.x),
            0.0,
            0.0,
            0.0,
            rounded_for_tileset(half.y),
            0.0,
            0.0,
            0.0,
            rounded_for_tileset(half.z)};
}

class TilesetWriter {
public:
    TilesetWriter(const TilesetPlan& plan, const TileId& root) : plan_(plan), root_(root) {}

    std::string write() {
        Json node = Json::object();
        if (root_.level == 0) {
            node = node_of(root_);
            node["transform"] = json_of_matrix(plan_.boxes.frame_of(root_));
        } else {
            node = bounds_of(root_);
            node["refine"] = "REPLACE";
            node["children"] = children_of(root_);
        }
        Json tileset = Json::object();
        tileset["asset"] = {{"version", "1.1"}, {"extras", {{"generator", plan_.generator}}}};
        // The error that a client makes by not showing the tileset. For the root tileset it is the
        // side of the ground.
        tileset["geometricError"] = rounded_for_tileset(
            root_.level == 0 ? plan_.grid.square().width : plan_.levels[root_.level].error);
        tileset["root"] = std::move(node);
        return tileset.dump() + "\n";
    }

private:
    /// Makes the JSON of a tile without its transform, and of the tiles below it that this tileset
    /// lists.
    Json node_of(const TileId& tile) {
        Json node = bounds_of(tile);
        if (plan_.levels[tile.level].has_content) {
            node["content"]["uri"] = path_to(TileForest::content_path(tile));
        }
        node["refine"] = "REPLACE";
        if (has_nested_tileset(tile.level, static_cast<std::uint32_t>(plan_.levels.size()) - 1)) {
            // One child stands for all tiles below, so that a client requests one tileset when it
            // refines this tile, and none before.
            Json below = bounds_of(tile);
            below["content"]["uri"] = path_to(TileForest::tileset_path(tile));
            node["children"].push_back(std::move(below));
            return node;
        }
        Json children = children_of(tile);
        if (!children.empty()) {
            node["children"] = std::move(children);
        }
        return node;
    }

    Json children_of(const TileId& tile) {
        Json children = Json::array();
        const glm::dmat4 to_tile = inverse_of_frame(plan_.boxes.frame_of(tile));
        for (std::uint32_t i = 0; i < 4; ++i) {
            const TileId below{tile.level + 1, 2 * tile.column + (i & 1U), 2 * tile.row + i / 2};
            if (below.level >= plan_.levels.size() || !plan_.grid.has_ground(below)) {
                continue;
            }
            Json child = node_of(below);
            child["transform"] = json_of_matrix(to_tile * plan_.boxes.frame_of(below));
            children.push_back(std::move(child));
        }
        return children;
    }

    [[nodiscard]] Json bounds_of(const TileId& tile) const {
        Json node = Json::object();
        node["boundingVolume"]["box"] = json_of(plan_.boxes.box_of(tile));
        node["geometricError"] = rounded_for_tileset(plan_.levels[tile.level].error);
        return node;
    }
    /// The path from this tileset to a file. Tilesets other than tileset.json lie two folders
    /// deeper.
    [[nodiscard]] std::string path_to(const std::string& path) const {
        return root_.level == 0 ? path : "../../" + path;
    }

    const TilesetPlan& plan_;
    const TileId& root_;
};

} // namespace

std::string make_tileset(const TilesetPlan& plan, const TileId& root) {
    return TilesetWriter(plan, root).write();
}

} // namespace lsys
