// SPDX-License-Identifier: MIT
#include "runtime/tiles/impl/tileset.h"

#include "grammar/base/contract.h"
#include "runtime/tiles/impl/box_corners.h"
#include "runtime/tiles/impl/geodesy.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace lsys {

namespace {

using Json = nlohmann::ordered_json;

/// A box along the axes of a frame.
struct Box {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};

    void add(const glm::dvec3& point) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
};

/// `value` rounded to a multiple of 2^-20, about a micrometre, for a tileset.
double rounded(double value) {
    constexpr double kSteps = 1 << 20;
    return std::floor(value * kSteps + 0.5) / kSteps;
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

Json json_of(const Box& box) {
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

std::string tileset_path(const TileId& tile) {
    return tile.level == 0 ? "tileset.json"
                           : fmt::format("{}/{}/{}.json", tile.level, tile.column, tile.row);
}

class TilesetWriter {
public:
    explicit TilesetWriter(const TilesetPlan& plan) : plan_(plan), contents_(plan.levels.size()) {
        for (std::size_t level = 0; level < plan.levels.size(); ++level) {
            const std::vector<TileId>& tiles = plan.levels[level].tiles;
            LSYS_CHECK(tiles.size() == plan.contents[level].size(), level);
            for (std::size_t i = 0; i < tiles.size(); ++i) {
                contents_[level][{tiles[i].column, tiles[i].row}] = &plan.contents[level][i];
            }
        }
    }

    std::vector<TileFile> write() {
        visit({}, 0);
        return std::move(files_);
    }

private:
    struct Node {
        glm::dmat4 frame{1.0};
        Box box;   // of the tile and all below it, in its frame
        Json json; // without a transform
    };

    /// Makes the node of a tile and the files of the tilesets below it. `from`: level of the root
    /// tile of the tileset file that lists the tile, for relative paths.
    Node visit(const TileId& tile, std::uint32_t from) {
        Node node;
        node.frame = plan_.frame_of(tile);
        const TileContent& content = *contents_[tile.level].at({tile.column, tile.row});
        node.box.add({content.low[0], content.low[1], content.low[2]});
        node.box.add({content.high[0], content.high[1], content.high[2]});
        const bool is_file = tile.level % kSubtreeLevels == 0;
        Json children = visit_children(tile, is_file ? tile.level : from, node);
        const double error = plan_.levels[tile.level].error;
        const bool is_in_folder = is_file ? tile.level != 0 : from != 0;
        node.json["boundingVolume"]["box"] = json_of(node.box);
        node.json["geometricError"] = rounded(error);
        node.json["refine"] = "REPLACE";
        node.json["content"]["uri"] = relative(TileForest::path_of(tile), is_in_folder);
        if (!children.empty()) {
            node.json["children"] = std::move(children);
        }
        if (is_file) {
            write_file(tile, node);
            node.json = {{"boundingVolume", {{"box", json_of(node.box)}}},
                         {"geometricError", rounded(error)},
                         {"content", {{"uri", relative(tileset_path(tile), from != 0)}}}};
        }
        return node;
    }

    /// The children of a tile, whose boxes widen the box of `node`.
    Json visit_children(const TileId& tile, std::uint32_t from, Node& node) {
        Json children = Json::array();
        const glm::dmat4 to_node = inverse_of_frame(node.frame);
        for (std::uint32_t i = 0; i < 4 && tile.level + 1 < contents_.size(); ++i) {
            const TileId below{tile.level + 1, 2 * tile.column + (i & 1U), 2 * tile.row + i / 2};
            if (!contents_[below.level].contains({below.column, below.row})) {
                continue;
            }
            Node child = visit(below, from);
            const glm::dmat4 transform = to_node * child.frame;
            for_each_corner(child.box.low, child.box.high, [&](const glm::dvec3& corner) {
                node.box.add(glm::dvec3(transform * glm::dvec4(corner, 1.0)));
            });
            child.json["transform"] = json_of(transform);
            children.push_back(std::move(child.json));
        }
        return children;
    }

    /// A path below the folder of the root, as seen from a tileset: files other than the root are two
    /// folders deeper.
    static std::string relative(const std::string& path, bool is_in_folder) {
        return is_in_folder ? "../../" + path : path;
    }

    void write_file(const TileId& tile, const Node& node) {
        const bool is_root = tile.level == 0;
        Json root = node.json;
        if (is_root) {
            root["transform"] = json_of(node.frame);
        }
        Json tileset;
        tileset["asset"] = {{"version", "1.1"}, {"extras", {{"generator", plan_.generator}}}};
        tileset["geometricError"] =
            rounded(is_root ? plan_.root_error : plan_.levels[tile.level].error);
        tileset["root"] = std::move(root);
        files_.push_back({tileset_path(tile), tileset.dump() + "\n"});
    }

    const TilesetPlan& plan_;
    /// By level, and by column and row.
    std::vector<std::map<std::pair<std::uint32_t, std::uint32_t>, const TileContent*>> contents_;
    std::vector<TileFile> files_;
};

} // namespace

std::vector<TileFile> make_tilesets(const TilesetPlan& plan) {
    return TilesetWriter(plan).write();
}

} // namespace lsys
