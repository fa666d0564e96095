// SPDX-License-Identifier: MIT
// TileForest: a forest as 3D Tiles 1.1 (OGC 22-025r4), a quadtree over the ground of the scene.
// Near tiles hold the ground and the trees as instances: of whole heroes with rho 0, else of
// branches. Coarser tiles hold fewer triangles per tree, and heroes that stand in for trees. Tiles
// with too many trees hold one surface of ground and crowns. Meshes of heroes are in files that all
// tiles share. A tile and a tileset depend only on the scene and their place, so they can be made
// in any order, by any process. Made by make_tile_forest(); used by `lsc tiles`.
#pragma once

#include "grammar/base/outcome.h"
#include "runtime/base/large_vector.h"
#include "runtime/forest/tree.h"
#include "runtime/meshing/mesh.h"
#include "runtime/pipeline/forest.h"
#include "runtime/pipeline/project.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

/// A place on the Earth: degrees, and metres above the ellipsoid of WGS 84.
struct GeoPlace {
    double longitude = 0.0;
    double latitude = 0.0;
    double height = 0.0;
};

inline constexpr std::uint32_t kMaxTileLevel = 24;
inline constexpr std::uint64_t kTileTriangles = 500'000;
inline constexpr float kTileError = 0.05F; // m
/// Max number of trees of a tile that shows single trees.
inline constexpr std::uint64_t kMaxTileTrees = 16'384;

struct TileOptions {
    /// Place of the scene's origin at altitude 0; +X points east and -Z north. None: the tileset has
    /// coordinates of its own.
    std::optional<GeoPlace> origin;
    std::uint64_t triangles = kTileTriangles; // max per tile with the mean number of trees
    float error = kTileError;                 // m, of the trees of the nearest tiles
    /// Implicit tiling: subtree files list the tiles, and contents have the coordinates of the root.
    bool implicit = false;
    /// Whether to place all trees at once and keep them, up to kMaxKeptTrees, which is faster if all
    /// tiles are made. The tiles are the same.
    bool keep_trees = false;
    /// A file of the trees of the scene (tree_file.h); none: the scene is placed. Must live until
    /// make_tile_forest() returns.
    std::optional<std::string_view> tree_file;
    MeshOptions mesh;
    std::string generator; // the program and its version
};

/// Max trees kept by TileOptions::keep_trees; they take 160 MB.
inline constexpr double kMaxKeptTrees = 4e6;

/// A square of the quadtree. Level 0 is the whole square of the scene; column and row run along +X
/// and +Z.
struct TileId {
    std::uint32_t level = 0;
    std::uint32_t column = 0;
    std::uint32_t row = 0;

    friend bool operator==(const TileId&, const TileId&) = default;
};

/// One level of the quadtree.
struct TileLevel {
    double side = 0.0;           // m
    double error = 0.0;          // m, upper bound of the distance between its tiles and the forest;
                                 // without content the side of the ground
    bool has_content = true;     // else its tiles show nothing, and clients go on to the next level
    bool has_trees = false;      // single trees, else one surface of ground and crowns
    double trees = 0.0;          // mean number in a tile
    std::uint64_t triangles = 0; // mean number per tree
};

/// A file that tiles refer to: meshes or a picture.
struct TileFile {
    std::string path; // relative to the folder of the tileset, with `/`
    std::string bytes;
};

/// The tiles of a level: its first `columns` columns and `rows` rows.
struct TileExtent {
    std::uint32_t columns = 0;
    std::uint32_t rows = 0;

    [[nodiscard]] std::uint64_t count() const { return std::uint64_t{columns} * rows; }
};

struct TileContent {
    std::string bytes;       // a GLB
    std::uint64_t trees = 0; // number of trees shown as instances
};

class TileForest {
public:
    TileForest(TileForest&& other) noexcept;
    TileForest& operator=(TileForest&& other) noexcept;
    ~TileForest();

    /// From the root to the finest level.
    [[nodiscard]] const std::vector<TileLevel>& levels() const;
    /// The files that tiles share.
    [[nodiscard]] const std::vector<TileFile>& files() const;
    /// Whether the forest has this tile. Any numbers are allowed.
    [[nodiscard]] bool has_tile(const TileId& tile) const;
    /// The columns and rows of a level that have tiles. Precondition: the level exists.
    [[nodiscard]] TileExtent extent(std::uint32_t level) const;
    /// The tiles of a level, row by row.
    [[nodiscard]] std::vector<TileId> tiles(std::uint32_t level) const;
    /// Makes a tile. Precondition: has_tile(), and its level has content. May be called from several
    /// threads. Throws std::bad_alloc.
    [[nodiscard]] TileContent content(const TileId& tile) const;
    /// Makes the tileset of the tiles below `root`: a JSON document that lists them and names the
    /// tilesets below them. The tileset of level 0 also lists `root`. Precondition: has_tile() and
    /// has_tileset(). May be called from several threads.
    [[nodiscard]] std::string tileset(const TileId& root) const;
    /// Whether tiles of the level have a tileset. With implicit tiling only level 0 has one.
    [[nodiscard]] bool has_tileset(std::uint32_t level) const;
    /// Makes the subtree file of `root` and of the tiles below it. Precondition: has_tile() and
    /// has_subtree(). May be called from several threads.
    [[nodiscard]] std::string subtree(const TileId& root) const;
    /// Whether tiles of the level have a subtree file. False without implicit tiling.
    [[nodiscard]] bool has_subtree(std::uint32_t level) const;
    /// The path of the content of a tile, "3/5/2.glb", and that of its tileset, "4/7/1.json" or
    /// "tileset.json".
    [[nodiscard]] static std::string content_path(const TileId& tile);
    [[nodiscard]] static std::string tileset_path(const TileId& root);
    /// The path of a subtree file, "5/9/17.subtree".
    [[nodiscard]] static std::string subtree_path(const TileId& root);

private:
    friend Outcome<TileForest>
    make_tile_forest(LoadedScene loaded, const TileOptions& options, const Project& project);
    struct State;
    explicit TileForest(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

/// Whether the trees of a scene can be placed tile by tile: its placement is on an unbounded grid,
/// and no tree is painted or erased.
[[nodiscard]] bool is_placed_by_tile(const Scene& scene);

/// Grows the heroes of a scene, plans its tiles, and makes the files that they share. The trees of
/// a scene with is_placed_by_tile() are placed when their tile is made; the trees of other scenes
/// are all placed here, or read from TileOptions::tree_file. With rho above 0 trees are assembled
/// from branches. Stops for the reasons of grow_species(), place_forest(), read_tree_file() and
/// mesh_forest().
[[nodiscard]] Outcome<TileForest>
make_tile_forest(LoadedScene loaded, const TileOptions& options, const Project& project);

/// The trees of a scene, placed once for all tiles.
struct PlacedScene {
    std::uint64_t placement_digest = 0;
    LargeVector<Tree> trees; // in the order of write_tree_file()
};

/// Places the trees of a scene. Stops for the reasons of grow_species() and place_forest().
[[nodiscard]] Outcome<PlacedScene> place_scene(const LoadedScene& loaded, const Project& project);

} // namespace lsys
