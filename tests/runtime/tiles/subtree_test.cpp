// SPDX-License-Identifier: MIT
// Implicit tiling: the subtree files list the tiles of the explicit tilesets, with the same boxes
// and errors. The content of a tile has one more node than that of the explicit tile: a root node,
// whose matrix is the place of the tile.
#include "runtime/tiles/impl/subtree.h"
#include "tests/support/tile_forest.h"

#include <catch2/catch.hpp>
#include <glm/matrix.hpp>
#include <nlohmann/json.hpp>

#include <cstring>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace lsys {

namespace {

using Json = nlohmann::ordered_json;

/// A tile as a client sees it.
struct SeenTile {
    glm::dvec3 middle{}; // of its box
    glm::dmat3 half{};   // half axes of its box
    double error = 0.0;
    glm::dmat4 place{1.0}; // from the tile to the root
};
using SeenTiles = std::map<std::string, SeenTile>; // by path of the content

template <typename T>
T number_at(const std::string& bytes, std::size_t at) {
    T value{};
    REQUIRE(at + sizeof value <= bytes.size());
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

glm::dmat4 matrix_of(const Json& numbers) {
    glm::dmat4 matrix;
    for (int i = 0; i < 16; ++i) {
        matrix[i / 4][i % 4] = numbers[static_cast<std::size_t>(i)].get<double>();
    }
    return matrix;
}

/// Adds the tiles with content of an explicit tileset and of the tilesets that it names. Returns
/// the number of all tiles, with and without content.
std::size_t
add_explicit(const TileForest& forest, const Json& tile, const glm::dmat4& place, SeenTiles& seen) {
    std::string uri = tile.contains("content") ? tile["content"]["uri"].get<std::string>() : "";
    while (uri.starts_with("../")) {
        uri.erase(0, 3);
    }
    std::size_t count = 1;
    if (uri.ends_with(".json")) {
        TileId root;
        REQUIRE(std::sscanf(uri.c_str(), "%u/%u/%u", &root.level, &root.column, &root.row) == 3);
        const Json below = Json::parse(forest.tileset(root));
        count = 0; // a tile that only refers to a tileset does not count
        for (const Json& child : below["root"]["children"]) {
            count += add_explicit(forest, child, place * matrix_of(child["transform"]), seen);
        }
        return count;
    }
    if (!uri.empty()) {
        SeenTile& added = seen[uri];
        const Json& box = tile["boundingVolume"]["box"];
        const auto vector = [&box](std::size_t first) {
            return glm::dvec3(box[first].get<double>(), box[first + 1].get<double>(),
                              box[first + 2].get<double>());
        };
        added.middle = glm::dvec3(place * glm::dvec4(vector(0), 1.0));
        added.half = glm::dmat3(place) * glm::dmat3(vector(3), vector(6), vector(9));
        added.error = tile["geometricError"].get<double>();
        added.place = place;
    }
    for (const Json& child : tile.value("children", Json::array())) {
        const bool moves = child.contains("transform");
        count += add_explicit(forest, child, moves ? place * matrix_of(child["transform"]) : place,
                              seen);
    }
    return count;
}

/// Reads the root subtree and all subtrees below it.
class SubtreeReader {
public:
    explicit SubtreeReader(const TileForest& forest)
        : forest_(forest), tileset_(Json::parse(forest.tileset({}))),
          depth_(tileset_["root"]["implicitTiling"]["subtreeLevels"].get<std::uint32_t>()) {
        read({});
    }

    SeenTiles seen;
    std::size_t count = 0; // number of tiles
    std::size_t files = 0; // number of subtree files
    /// By name of an availability, the number of files in which it is a constant.
    std::map<std::string, std::size_t> constants;

private:
    void read(const TileId& root) {
        REQUIRE(forest_.has_tile(root));
        REQUIRE(forest_.has_subtree(root.level));
        const std::string file = forest_.subtree(root);
        ++files;
        REQUIRE(file.substr(0, 4) == "subt");
        CHECK(number_at<std::uint32_t>(file, 4) == 1);
        const auto json_bytes = number_at<std::uint64_t>(file, 8);
        const auto data_bytes = number_at<std::uint64_t>(file, 16);
        REQUIRE(file.size() == 24 + json_bytes + data_bytes);
        CHECK(json_bytes % 8 == 0);
        CHECK(data_bytes % 8 == 0);
        const Json json = Json::parse(file.substr(24, json_bytes));
        const std::string data = file.substr(24 + json_bytes);
        const auto offset_of = [&json](const Json& view) {
            return json["bufferViews"][view.get<std::size_t>()]["byteOffset"].get<std::size_t>();
        };
        const auto bit = [&](const char* name, std::size_t index) {
            const Json& all = json[name].is_array() ? json[name][0] : json[name];
            if (all.contains("constant")) {
                return all["constant"].get<int>() == 1;
            }
            const auto byte =
                static_cast<unsigned char>(data[offset_of(all["bitstream"]) + index / 8]);
            return (byte >> index % 8 & 1U) != 0;
        };
        for (const char* const name : {"tileAvailability", "childSubtreeAvailability"}) {
            constants[name] += json[name].contains("constant") ? 1U : 0U;
        }
        const Json& properties = json["propertyTables"][0]["properties"];
        const std::size_t boxes = offset_of(properties["boundingBox"]["values"]);
        const std::size_t errors = offset_of(properties["geometricError"]["values"]);
        std::size_t row = 0;
        std::size_t index = 0;
        for (std::uint32_t depth = 0; depth <= depth_; ++depth) {
            for (std::uint32_t place = 0; place < 1U << 2 * depth; ++place) {
                const TileId tile = below(root, depth, place);
                if (depth == depth_) {
                    if (bit("childSubtreeAvailability", place)) {
                        read(tile);
                    }
                    continue;
                }
                const bool has_content = bit("contentAvailability", index);
                if (bit("tileAvailability", index++)) {
                    ++count;
                    if (has_content) {
                        add(tile, data, boxes + 48 * row, errors + 8 * row);
                    }
                    ++row;
                } else {
                    CHECK_FALSE(has_content);
                }
            }
        }
        CHECK(row == json["propertyTables"][0]["count"].get<std::size_t>());
    }

    static TileId below(const TileId& root, std::uint32_t depth, std::uint32_t place) {
        TileId tile = root;
        for (std::uint32_t i = depth; i-- > 0;) {
            tile = {tile.level + 1, 2 * tile.column + (place >> 2 * i & 1U),
                    2 * tile.row + (place >> (2 * i + 1) & 1U)};
        }
        return tile;
    }

    void add(const TileId& tile, const std::string& data, std::size_t box, std::size_t error) {
        SeenTile& added = seen[TileForest::content_path(tile)];
        const auto vector = [&](std::size_t first) {
            glm::dvec3 numbers;
            for (int i = 0; i < 3; ++i) {
                numbers[i] = static_cast<double>(
                    number_at<float>(data, box + 4 * first + 4 * static_cast<std::size_t>(i)));
            }
            return numbers;
        };
        added.middle = vector(0);
        added.half = glm::dmat3(vector(3), vector(6), vector(9));
        added.error = number_at<double>(data, error);
    }

    const TileForest& forest_;
    Json tileset_;
    std::uint32_t depth_;
};

double largest_difference(const glm::dmat4& a, const glm::dmat4& b) {
    double largest = 0.0;
    for (int i = 0; i < 16; ++i) {
        largest = std::max(largest, std::abs(a[i / 4][i % 4] - b[i / 4][i % 4]));
    }
    return largest;
}

/// The JSON of a GLB.
Json json_of_glb(const std::string& glb) {
    return Json::parse(glb.substr(20, number_at<std::uint32_t>(glb, 12)));
}

} // namespace

TEST_CASE("implicit tiling has the tiles of the explicit tilesets") {
    TileOptions options;
    if (GENERATE(false, true)) {
        options.origin = GeoPlace{9.7, 47.2, 430.0};
    }
    const TileForest by_json = tests::make_tile_strip(options);
    options.implicit = true;
    const TileForest forest = tests::make_tile_strip(options);
    const auto levels = static_cast<std::uint32_t>(forest.levels().size());
    REQUIRE(levels > 5); // more than one level of subtrees
    SeenTiles wanted;
    const Json root = Json::parse(by_json.tileset({}))["root"];
    const std::size_t count = add_explicit(by_json, root, glm::dmat4(1.0), wanted);
    const SubtreeReader reader(forest);
    CHECK(reader.count == count);
    CHECK(reader.files > 1);
    CHECK(reader.constants.at("childSubtreeAvailability") > 0);
    CHECK(reader.constants.at("tileAvailability") < reader.files); // no tile beside the strip
    REQUIRE(reader.seen.size() == wanted.size());
    for (const auto& [path, tile] : wanted) {
        CAPTURE(path);
        REQUIRE(reader.seen.contains(path));
        const SeenTile& other = reader.seen.at(path);
        CHECK(other.error == Approx(tile.error).margin(1e-6));
        for (int axis = 0; axis < 3; ++axis) {
            CHECK(glm::distance(other.half[axis], tile.half[axis]) < 0.01);
            CHECK(glm::length(other.half[axis]) >= glm::length(tile.half[axis]) - 1e-3);
        }
        CHECK(glm::distance(other.middle, tile.middle) < 0.01);
    }
    // A client that ignores the metadata halves the error of the root with each level; no error
    // computed in this way is too small.
    const Json top = Json::parse(forest.tileset({}))["root"];
    CHECK(matrix_of(top["transform"]) == matrix_of(root["transform"]));
    double implied = top["geometricError"].get<double>();
    for (const TileLevel& level : forest.levels()) {
        CHECK((implied >= level.error - 1e-6 || !level.has_content));
        implied /= 2.0;
    }
    CHECK(top["boundingVolume"]["box"][3].get<double>() == Approx(140.0)); // the square of 280 m
    CHECK_FALSE(forest.has_tileset(2));
    CHECK_FALSE(by_json.has_subtree(0));
}

TEST_CASE("contents of implicit tiling are the explicit ones below a node with their place") {
    TileOptions options;
    options.origin = GeoPlace{9.7, 47.2, 430.0};
    const TileForest by_json = tests::make_tile_strip(options);
    options.implicit = true;
    const TileForest forest = tests::make_tile_strip(options);
    SeenTiles explicit_tiles;
    add_explicit(by_json, Json::parse(by_json.tileset({}))["root"], glm::dmat4(1.0),
                 explicit_tiles);
    const auto finest = static_cast<std::uint32_t>(forest.levels().size()) - 1;
    for (const TileId tile : {TileId{3, 1, 1}, TileId{finest, 5, 2}}) {
        REQUIRE(forest.has_tile(tile));
        Json json = json_of_glb(forest.content(tile).bytes);
        const Json wanted = json_of_glb(by_json.content(tile).bytes);
        const Json placed = json["nodes"].back();
        CHECK(json["scenes"][0]["nodes"] == Json{wanted["nodes"].size()});
        CHECK(placed["children"] == wanted["scenes"][0]["nodes"]);
        json["nodes"].erase(json["nodes"].size() - 1);
        json["scenes"] = wanted["scenes"];
        CHECK(json == wanted);
        // Clients turn +Y of the file to +Z of the tile: (x, y, z) becomes (x, -z, y).
        const glm::dmat4 turn(glm::dvec4(1.0, 0.0, 0.0, 0.0), glm::dvec4(0.0, 0.0, 1.0, 0.0),
                              glm::dvec4(0.0, -1.0, 0.0, 0.0), glm::dvec4(0.0, 0.0, 0.0, 1.0));
        const glm::dmat4 place = explicit_tiles.at(TileForest::content_path(tile)).place;
        CHECK(largest_difference(turn * matrix_of(placed["matrix"]), place * turn) < 1e-5);
    }
}

TEST_CASE("subtrees have at most five levels, as evenly as possible") {
    CHECK(subtree_levels(1) == 1);
    CHECK(subtree_levels(5) == 5);
    CHECK(subtree_levels(6) == 3);
    CHECK(subtree_levels(13) == 5);
    CHECK(subtree_levels(16) == 4);
    CHECK(subtree_levels(25) == 5);
}

} // namespace lsys
