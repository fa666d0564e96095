// SPDX-License-Identifier: MIT
// TileForest: a forest as 3D Tiles 1.1 (OGC 22-025r4), a quadtree over the ground of the scene.
// Near tiles have the ground, and the trees as instances: instances of whole heroes if rho is 0,
// else of branches. Coarser tiles have fewer triangles per tree, and show heroes in place of trees.
// Tiles with too many trees have one surface of ground and crowns. Files that all tiles share
// contain the meshes of heroes. A tile and a tileset depend only on the scene and their place, so
// they can be made in any order, by any process. Made by make_tile_forest(); used by `lsc tiles`.
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
/// Defaults of TileOptions.
inline constexpr std::uint64_t kTileTriangles = 500'000;
inline constexpr float kTileError = 0.05F; // m
/// Max number of trees of a tile that shows single trees.
inline constexpr std::uint64_t kMaxTileTrees = 16'384;

struct TileOptions {
    /// Place on the Earth of the scene's origin at altitude 0; +X points east and -Z north.
    /// nullopt: the tileset has coordinates of its own.
    std::optional<GeoPlace> origin;
    std::uint64_t triangles = kTileTriangles; // max of a tile with the mean number of trees
    float max_error = kTileError;             // m, max error of the trees in the nearest tiles
    /// Use implicit tiling: subtree files list the tiles, and contents have the coordinates of the
    /// root.
    bool implicit = false;
    /// Place all trees at once and keep them in memory, unless the forest has more than
    /// kMaxKeptTrees places. Faster if all tiles are made; the tiles are the same.
    bool keep_trees = false;
    /// Contents of a tree file of the scene (tree_file.h); nullopt: the trees of the scene are
    /// placed. The bytes must stay valid until make_tile_forest() returns.
    std::optional<std::string_view> tree_file;
    std::string tree_file_path; // of `tree_file`, for messages
    MeshOptions mesh;
    std::string generator; // the program and its version
};

/// Max number of trees that TileOptions::keep_trees keeps; they take 160 MB.
inline constexpr double kMaxKeptTrees = 4e6;

/// A square of the quadtree. The tile of level 0 is the whole square of the scene; columns are
/// numbered along +X and rows along +Z.
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
                                 // the side of the ground if the level has no content
    bool has_content = true;     // if false, clients go on to the next finer level
    bool has_trees = false;      // whether tiles show single trees, not a canopy
    double trees = 0.0;          // mean number of trees in a tile
    std::uint64_t triangles = 0; // mean number of triangles per tree
};

/// A file that tiles refer to: meshes or a picture.
struct TileFile {
    std::string path; // relative to the folder of the tileset; separator `/`
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

    /// The levels from the root to the finest level.
    [[nodiscard]] const std::vector<TileLevel>& levels() const;
    /// The files that tiles share.
    [[nodiscard]] const std::vector<TileFile>& files() const;
    /// Whether the forest has this tile. `tile` may have any numbers.
    [[nodiscard]] bool has_tile(const TileId& tile) const;
    /// The numbers of columns and rows of a level that have tiles. Precondition: the level exists.
    [[nodiscard]] TileExtent extent(std::uint32_t level) const;
    /// The tiles of a level, listed row by row.
    [[nodiscard]] std::vector<TileId> tiles(std::uint32_t level) const;
    /// Makes the content of a tile. Precondition: has_tile(tile), and its level has content. May be
    /// called from several threads. Throws std::bad_alloc.
    [[nodiscard]] TileContent content(const TileId& tile) const;
    /// Makes the tileset of the tiles below `root`: a JSON document that lists these tiles and
    /// refers to the tilesets below them. The tileset of level 0 also lists `root`. Precondition:
    /// has_tile(root) and has_tileset(root.level). May be called from several threads.
    [[nodiscard]] std::string tileset(const TileId& root) const;
    /// Whether tiles of a level have tilesets. With implicit tiling only level 0 has one.
    [[nodiscard]] bool has_tileset(std::uint32_t level) const;
    /// Makes the subtree file that lists `root` and the tiles below it. Precondition:
    /// has_tile(root) and has_subtree(root.level). May be called from several threads.
    [[nodiscard]] std::string subtree(const TileId& root) const;
    /// Whether tiles of a level have subtree files; always false without implicit tiling.
    [[nodiscard]] bool has_subtree(std::uint32_t level) const;
    /// The path of the content of a tile, such as "3/5/2.glb", and the path of its tileset, such as
    /// "4/7/1.json" or "tileset.json".
    [[nodiscard]] static std::string content_path(const TileId& tile);
    [[nodiscard]] static std::string tileset_path(const TileId& root);
    /// The path of a subtree file, such as "5/9/17.subtree".
    [[nodiscard]] static std::string subtree_path(const TileId& root);
    /// A hash of all that the bytes of the files depend on, with the version of the program. It
    /// does not depend on paths, threads and layout of the sources. Time is linear in the bytes of
    /// files().
    [[nodiscard]] std::uint64_t digest() const;

private:
    friend Outcome<TileForest>
    make_tile_forest(LoadedScene loaded, const TileOptions& options, const Project& project);
    struct State;
    explicit TileForest(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

/// Whether the trees of a scene can be placed tile by tile: the placement of the scene is on an
/// unbounded grid, and no tree is painted or erased.
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
    std::uint64_t placement_digest = 0; // identifies the scene to which the trees belong
    LargeVector<Tree> trees;            // in the order of write_tree_file()
};

/// Places the trees of a scene. Stops for the reasons of grow_species() and place_forest().
[[nodiscard]] Outcome<PlacedScene> place_scene(const LoadedScene& loaded, const Project& project);

} // namespace lsys
