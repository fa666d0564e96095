// SPDX-License-Identifier: MIT
// TileDocument: a GLB of a tile, composed of glTF documents: one of the ground, whose buffer goes
// into the GLB, and one per hero, whose buffer and pictures are parts of other files. Adds trees
// and branches as instances (EXT_mesh_gpu_instancing) with a table of the properties of their trees
// (EXT_instance_features, EXT_structural_metadata). TileParts has the documents of the heroes as
// text, formatted once for all tiles. A fallback is a buffer that stands for the decoded items of
// EXT_meshopt_compression and is not stored.
#pragma once

#include "runtime/base/large_vector.h"
#include "runtime/export/export.h"
#include "runtime/meshing/mesh.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lsys {

/// `value` rounded to a micrometre, for short numbers.
[[nodiscard]] double rounded_for_tileset(double value);
/// The matrix in column-major order, for tiles and tilesets. Axes are rounded to 12 decimals, which
/// moves a point by less than 1e-12 of the diameter of the Earth.
[[nodiscard]] nlohmann::ordered_json json_of_matrix(const glm::dmat4& matrix);

/// Bytes of a file that tiles share.
struct FilePart {
    std::string uri;              // percent-encoded, relative to the tile
    std::uint64_t file_bytes = 0; // size of the file
    std::uint64_t offset = 0;     // of the part in the file
    std::uint64_t bytes = 0;      // size of the part
};

/// A glTF document of one mesh without its member `buffers`, and the place of its buffer.
struct MeshDocument {
    nlohmann::ordered_json json;     // buffer 0 is `data`, buffer 1 its fallback
    std::string data;                // the buffer; empty if it is in the file `uri`
    std::uint64_t decoded_bytes = 0; // size of the fallback; 0: no fallback
    std::string uri; // name of the file with the buffer, percent-encoded, relative to the tile
    std::uint64_t file_bytes = 0;   // size of the file `uri`
    std::vector<FilePart> pictures; // by image: PNG files; empty: the document has the images
};
/// The order in which a compressed document stores the triangles and vertices of a mesh with one
/// part. If all vertices differ, the order depends on the triangles alone, so meshes with equal
/// triangles share one order.
struct MeshOrder {
    LargeVector<std::uint32_t> vertices; // numbers in the mesh
    LargeVector<std::byte> indices;      // compressed
};
[[nodiscard]] MeshOrder make_mesh_order(const Mesh& mesh, const ExportInfo& info);

/// The document of a mesh at rest. It refers to the picture files that make_picture_files() makes
/// for ExportFormat::Gltf and `info`. Precondition: the mesh has triangles, a few million at most;
/// `info` has a `buffer_name`, and no motion, film, levels or variants. Throws std::bad_alloc.
[[nodiscard]] MeshDocument make_mesh_document(const Mesh& mesh, const ExportInfo& info);
/// Like the function above, but takes the order of the mesh instead of computing it, and so needs a
/// third of the time. Precondition: `order` is the order of `mesh`.
[[nodiscard]] MeshDocument
make_mesh_document(const Mesh& mesh, const ExportInfo& info, const MeshOrder& order);
/// Stores a picture in the buffer of the document; image `number` then refers to the buffer, not to
/// a file. Precondition: the document contains its buffer (`data`).
void embed_picture(std::size_t number, const std::string& png, MeshDocument& document);

/// Moves the buffers of compressed documents to the end of `file`. Items of one kind, for example
/// all positions, become one view, which the documents share; but each accessor of texture
/// coordinates keeps a view of its own. The caller sets `uri` and `file_bytes` of the documents.
/// Precondition: each view holds the items of one accessor and nothing else.
void join_buffers(std::span<MeshDocument* const> documents, std::string& file);

/// The properties of a tree of a tile.
struct TileTree {
    float height = 0.0F;      // m
    std::uint32_t number = 0; // Tree::number
    std::uint16_t species = 0;
    std::uint16_t age = 0; // years; 0: full-grown
};

/// A tree or branch as an instance of a part: its transform from the coordinates of the part.
struct TileInstance {
    glm::quat rotation{1.0F, 0.0F, 0.0F, 0.0F};
    glm::vec3 translation{}; // m, in the frame of the tile with +Y up
    float scale = 1.0F;
    std::uint32_t tree = 0; // index in the trees of the document
};

/// The parts of documents that tiles share: meshes of heroes with their materials and pictures.
class TileParts {
public:
    /// `generator`: the program and its version. `species`: names, for the table of properties.
    TileParts(const std::string& generator, const std::vector<std::string>& species);
    TileParts(TileParts&& other) noexcept;
    TileParts& operator=(TileParts&& other) noexcept;
    ~TileParts();

    /// Adds a document whose buffer is in a file. Returns its number, counted from 0.
    std::size_t add(const MeshDocument& hero);

private:
    friend class TileWriter;
    struct State;
    std::unique_ptr<State> state_;
};

class TileDocument {
public:
    /// `parts` must outlive the document.
    explicit TileDocument(const TileParts& parts) : parts_(parts) {}

    /// Sets the surface of the tile, drawn by one node. Precondition: `surface` contains its
    /// buffer, MeshDocument::data.
    void set_surface(MeshDocument surface) { surface_ = std::move(surface); }
    /// Sets the trees of the table of properties. Trees without instances get no row.
    void set_trees(std::vector<TileTree> trees) { trees_ = std::move(trees); }
    /// Adds `instances`, at least one, of the mesh of a part. `part`: number from TileParts::add().
    /// Instances of a tree are consecutive.
    void add_instances(std::size_t part, std::vector<TileInstance> instances) {
        groups_.push_back({part, std::move(instances)});
    }
    /// Moves the whole tile by a rigid `matrix`, for coordinates with +Z up. The file states the
    /// matrix in binary64.
    void move(const glm::dmat4& matrix) { matrix_ = matrix; }
    /// The file. Precondition: it has a surface. Call it once.
    [[nodiscard]] std::string write();

private:
    friend class TileWriter;
    struct Group {
        std::size_t part = 0; // index of the part in parts_
        std::vector<TileInstance> instances;
    };

    const TileParts& parts_;
    std::optional<MeshDocument> surface_;
    std::vector<TileTree> trees_;
    std::vector<Group> groups_;
    glm::dmat4 matrix_{1.0}; // of the tile, +Z up
};

} // namespace lsys
