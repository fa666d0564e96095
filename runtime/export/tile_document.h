// SPDX-License-Identifier: MIT
// TileDocument: a GLB of a tile, composed of glTF documents: one of the ground, whose buffer goes
// into the GLB, and one per hero, whose buffer and pictures are parts of other files. Adds the trees as
// instances (EXT_mesh_gpu_instancing) with a table of their properties (EXT_instance_features,
// EXT_structural_metadata).
#pragma once

#include "runtime/export/export.h"
#include "runtime/meshing/mesh.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

/// Bytes of a file that tiles share.
struct FilePart {
    std::string uri;              // percent-encoded, relative to the tile
    std::uint64_t file_bytes = 0; // size of the file
    std::uint64_t offset = 0;
    std::uint64_t bytes = 0;
};

/// A glTF document of one mesh without its member `buffers`, and the place of its buffer.
struct MeshDocument {
    nlohmann::ordered_json json;     // buffer 0 is `data`, buffer 1 its fallback
    std::string data;                // the buffer; empty if it is in the file `uri`
    std::uint64_t decoded_bytes = 0; // size of the fallback; 0: no fallback
    std::string uri;                 // percent-encoded, relative to the tile; empty: none
    std::uint64_t file_bytes = 0;    // size of the file `uri`
    std::vector<FilePart> pictures;  // by image: PNG; empty: as the document says
};
/// The document of a mesh at rest. It refers to the picture files that make_picture_files() makes
/// for ExportFormat::Gltf and `info`. Precondition: the mesh has triangles, a few million at most;
/// `info` has a `buffer_name`, and no motion, film, levels or variants. Throws std::bad_alloc.
[[nodiscard]] MeshDocument make_mesh_document(const Mesh& mesh, const ExportInfo& info);
/// Stores a picture in the buffer of the document; image `number` then refers to it, not to a file.
/// Precondition: the buffer is `data`.
void embed_picture(std::size_t number, const std::string& png, MeshDocument& document);

/// Moves the buffers of compressed documents into a file: appends to `file`. Items of one kind, for
/// example all positions, become one view, which all documents have; but each accessor of texture
/// coordinates keeps a view of its own. The documents get no `uri` and `file_bytes`. Precondition:
/// their views have nothing but items of accessors, each those of one.
void join_buffers(std::span<MeshDocument* const> documents, std::string& file);

/// A tree of a tile, with its transform from the coordinates of its hero.
struct TileTree {
    glm::quat rotation{1.0F, 0.0F, 0.0F, 0.0F};
    glm::vec3 translation{}; // m, in the frame of the tile with +Y up
    float scale = 1.0F;
    float height = 0.0F; // m
    std::uint32_t number = 0;
    std::uint16_t species = 0;
    std::uint16_t age = 0; // years; 0: full-grown
};

class TileDocument {
public:
    /// `generator`: the program and its version.
    explicit TileDocument(const std::string& generator);

    /// Adds a node with the mesh of a document.
    void add_surface(const MeshDocument& surface);
    /// Adds `trees` as instances of the mesh of a document.
    void add_trees(const MeshDocument& hero, const std::vector<TileTree>& trees);
    /// Moves the whole tile by a matrix that keeps lengths and angles, for coordinates with +Z up. The
    /// matrix is a part of the file, in binary64.
    void move(const glm::dmat4& matrix) { matrix_ = matrix; }
    /// The file. `species`: names, for the table of properties. Call it once.
    [[nodiscard]] std::string write(const std::vector<std::string>& species);

private:
    using Json = nlohmann::ordered_json;

    struct Buffer {
        std::string uri; // empty: the buffer of the GLB
        std::uint64_t bytes = 0;
        std::uint64_t decoded_bytes = 0; // size of its fallback; 0: no fallback
    };
    /// A mesh with quantised positions, which are low + step * item.
    struct DrawnMesh {
        std::size_t number = 0;
        glm::vec3 low{0.0F};
        float step = 1.0F;
    };
    struct Group {
        DrawnMesh mesh;
        std::vector<TileTree> trees;
    };

    DrawnMesh add_mesh(const MeshDocument& part);
    /// The number of the buffer with this file; empty: that of the GLB.
    std::size_t add_buffer(const std::string& uri, std::uint64_t bytes);
    /// Makes the images of a document refer to its pictures.
    void place_pictures(const MeshDocument& part, Json& images);
    /// Reserves `bytes` bytes of decoded items in the fallback of a buffer; returns their offset.
    std::uint64_t reserve_decoded(std::size_t buffer, std::uint64_t bytes);
    /// The number of a view, which is added if the document does not have it.
    std::size_t add_view_once(Json view);
    std::size_t add_view(std::string_view bytes);
    std::size_t add_packed_view(const std::string& items, std::uint32_t stride);
    void add_node(Json node);
    std::size_t add_accessor(
        std::size_t view, std::uint64_t offset, int component, const char* type, std::size_t count);
    void put_groups();
    void put_table(const std::vector<std::string>& species);
    /// Puts all nodes below one that has the matrix.
    void put_matrix();
    /// Replaces the buffers of compressed views by their fallbacks.
    void point_to_fallbacks();

    Json json_;
    std::string data_; // of the GLB
    std::vector<Buffer> buffers_;
    std::vector<Group> groups_;
    glm::dmat4 matrix_{1.0}; // of the tile, +Z up
};

} // namespace lsys
