// SPDX-License-Identifier: MIT
#include "runtime/tiles/impl/subtree.h"

#include "runtime/export/tile_document.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace lsys {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kAlignment = 8; // bytes, of JSON, data and views in a subtree file

template <typename T>
void append(std::string& bytes, T value) {
    static_assert(std::endian::native == std::endian::little);
    const auto* const first = reinterpret_cast<const char*>(&value);
    bytes.append(first, sizeof value);
}

void pad(std::string& bytes, char filler) {
    bytes.resize((bytes.size() + kAlignment - 1) / kAlignment * kAlignment, filler);
}

/// The tile number `place` on the Z-order curve through the tiles that are `depth` levels below
/// `root`.
TileId tile_below(const TileId& root, std::uint32_t depth, std::uint32_t place) {
    TileId tile{root.level + depth, root.column << depth, root.row << depth};
    for (std::uint32_t bit = 0; bit < depth; ++bit) {
        tile.column |= (place >> 2 * bit & 1U) << bit;
        tile.row |= (place >> (2 * bit + 1) & 1U) << bit;
    }
    return tile;
}

class SubtreeWriter {
public:
    SubtreeWriter(const TilesetPlan& plan, const TileId& root)
        : plan_(plan), root_(root),
          depth_(subtree_levels(static_cast<std::uint32_t>(plan.levels.size()))) {}

    std::string write() {
        std::vector<bool> tiles;
        std::vector<bool> contents;
        std::string boxes;
        std::string errors;
        for (std::uint32_t depth = 0; depth < depth_; ++depth) {
            for (std::uint32_t place = 0; place < 1U << 2 * depth; ++place) {
                const TileId tile = tile_below(root_, depth, place);
                tiles.push_back(has_tile(tile));
                contents.push_back(tiles.back() && plan_.levels[tile.level].has_content);
                if (tiles.back()) {
                    append_box(tile, boxes);
                    append(errors, plan_.levels[tile.level].error);
                }
            }
        }
        std::vector<bool> subtrees;
        for (std::uint32_t place = 0; place < 1U << 2 * depth_; ++place) {
            subtrees.push_back(has_tile(tile_below(root_, depth_, place)));
        }
        Json availability = json_of(tiles);
        Json of_contents = json_of(contents);
        Json of_subtrees = json_of(subtrees);
        Json properties;
        properties["boundingBox"]["values"] = add_view(boxes);
        properties["geometricError"]["values"] = add_view(errors);
        Json subtree;
        subtree["buffers"][0]["byteLength"] = data_.size();
        subtree["bufferViews"] = std::move(views_);
        subtree["propertyTables"][0] = {{"class", "tile"},
                                        {"count", std::count(tiles.begin(), tiles.end(), true)},
                                        {"properties", std::move(properties)}};
        subtree["tileAvailability"] = std::move(availability);
        subtree["contentAvailability"][0] = std::move(of_contents);
        subtree["childSubtreeAvailability"] = std::move(of_subtrees);
        subtree["tileMetadata"] = 0;
        return file_of(subtree.dump());
    }

private:
    [[nodiscard]] bool has_tile(const TileId& tile) const {
        return tile.level < plan_.levels.size() && plan_.grid.has_ground(tile);
    }

    /// Appends the box of a tile, in the frame of the root of the quadtree: its middle and three
    /// half axes.
    void append_box(const TileId& tile, std::string& boxes) const {
        const TileBox box = plan_.boxes.box_of(tile);
        const glm::dmat4 to_root = frame_in_root(plan_.boxes, tile);
        const glm::dvec3 middle(to_root * glm::dvec4(0.5 * (box.low + box.high), 1.0));
        const glm::dvec3 half = 0.5 * (box.high - box.low);
        const auto append_vector = [&boxes](const glm::dvec3& vector) {
            for (int axis = 0; axis < 3; ++axis) {
                append(boxes, static_cast<float>(vector[axis]));
            }
        };
        append_vector(middle);
        for (int axis = 0; axis < 3; ++axis) {
            // Boxes are enlarged by 1 mm, as in tilesets, and by the rounding error of numbers in
            // binary32.
            constexpr double kRounding = 0x1p-22;
            const double reach =
                std::max({std::abs(middle.x), std::abs(middle.y), std::abs(middle.z)}) +
                std::max({half.x, half.y, half.z});
            append_vector((half[axis] + 1e-3 + kRounding * reach) * glm::dvec3(to_root[axis]));
        }
    }

    /// The availability of tiles: a constant if all bits are equal, else a stream of bits.
    Json json_of(const std::vector<bool>& bits) {
        const auto count = std::count(bits.begin(), bits.end(), true);
        if (count == 0 || static_cast<std::size_t>(count) == bits.size()) {
            return {{"constant", count == 0 ? 0 : 1}};
        }
        std::string bytes((bits.size() + 7) / 8, '\0');
        for (std::size_t i = 0; i < bits.size(); ++i) {
            const unsigned bit = bits[i] ? 1U << i % 8 : 0U;
            bytes[i / 8] = static_cast<char>(static_cast<unsigned char>(bytes[i / 8]) | bit);
        }
        return {{"bitstream", add_view(bytes)}, {"availableCount", count}};
    }

    /// Appends bytes to the buffer and returns the index of their buffer view.
    std::size_t add_view(const std::string& bytes) {
        views_.push_back(
            {{"buffer", 0}, {"byteOffset", data_.size()}, {"byteLength", bytes.size()}});
        data_ += bytes;
        pad(data_, '\0');
        return views_.size() - 1;
    }

    /// The bytes of the file: a header, `json` and the buffer.
    [[nodiscard]] std::string file_of(std::string json) const {
        pad(json, ' ');
        std::string file = "subt";
        append(file, std::uint32_t{1}); // version
        append(file, std::uint64_t{json.size()});
        append(file, std::uint64_t{data_.size()});
        return file + json + data_;
    }

    const TilesetPlan& plan_;
    const TileId& root_;
    std::uint32_t depth_;        // number of levels of the subtree
    Json views_ = Json::array(); // buffer views
    std::string data_;           // the buffer
};

/// The box of the whole square, which clients divide into quarters. Its axes are turned by 180
/// degrees about the first axis, so that rows are counted from the north.
Json square_of(const TilesetPlan& plan) {
    const TileBox box = plan.boxes.box_of({});
    const double side = 0.5 * plan.grid.square().width;
    const double height = 0.5 * (box.high.z - box.low.z) + 1e-3;
    return {0.0,  0.0,   rounded_for_tileset(0.5 * (box.low.z + box.high.z)),
            side, 0.0,   0.0,
            0.0,  -side, 0.0,
            0.0,  0.0,   rounded_for_tileset(-height)};
}

/// The min error in m of the root with which each level with content gets at least its own error,
/// if the error halves from level to level. Levels without content do not count: their error is the
/// side of the ground, with which a client would load the finest tiles everywhere.
double implied_error(const std::vector<TileLevel>& levels) {
    double error = 0.0;
    double factor = 1.0;
    for (const TileLevel& level : levels) {
        error = level.has_content ? std::max(error, factor * level.error) : error;
        factor *= 2.0;
    }
    return error;
}

Json schema_of_tiles() {
    Json schema{{"id", "tiles"}};
    schema["classes"]["tile"]["properties"] = {
        {"boundingBox",
         {{"description", "Box of all that the tile and the tiles below it draw"},
          {"type", "SCALAR"},
          {"componentType", "FLOAT32"},
          {"array", true},
          {"count", 12},
          {"required", true},
          {"semantic", "TILE_BOUNDING_BOX"}}},
        {"geometricError",
         {{"description", "Upper bound in metres of the distance between the tile and the forest"},
          {"type", "SCALAR"},
          {"componentType", "FLOAT64"},
          {"required", true},
          {"semantic", "TILE_GEOMETRIC_ERROR"}}}};
    return schema;
}

} // namespace

std::string make_implicit_tileset(const TilesetPlan& plan) {
    const auto levels = static_cast<std::uint32_t>(plan.levels.size());
    const double error = rounded_for_tileset(implied_error(plan.levels));
    Json tileset;
    tileset["asset"] = {{"version", "1.1"}, {"extras", {{"generator", plan.generator}}}};
    tileset["schema"] = schema_of_tiles();
    tileset["geometricError"] = std::max(error, rounded_for_tileset(plan.grid.square().width));
    Json& root = tileset["root"];
    root["boundingVolume"]["box"] = square_of(plan);
    root["geometricError"] = error;
    root["refine"] = "REPLACE";
    root["transform"] = json_of_matrix(plan.boxes.frame_of({}));
    root["content"]["uri"] = "{level}/{x}/{y}.glb";
    root["implicitTiling"] = {{"subdivisionScheme", "QUADTREE"},
                              {"subtreeLevels", subtree_levels(levels)},
                              {"availableLevels", levels},
                              {"subtrees", {{"uri", "{level}/{x}/{y}.subtree"}}}};
    return tileset.dump() + "\n";
}

std::string make_subtree(const TilesetPlan& plan, const TileId& root) {
    return SubtreeWriter(plan, root).write();
}

} // namespace lsys
