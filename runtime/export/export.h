// SPDX-License-Identifier: MIT
// Export: writes a mesh, or for drawings the skeleton, as a file of a common format. Bytes go to a
// sink in pieces and in order, large arrays straight from memory; no file is held in memory as a
// whole. The input is the result of make_mesh() and of the turtle; callers open and commit files.
// Metres; +Y up, or +Z if requested. The same input gives the same bytes.
#pragma once

#include "grammar/base/outcome.h"
#include "runtime/meshing/mesh.h"
#include "runtime/meshing/mesh_film.h"
#include "runtime/turtle/skeleton.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

struct PlantAnimation;

enum class ExportFormat : std::uint8_t {
#define LSYS_EXPORT_FORMAT(enumerator, ...) enumerator,
#include "runtime/export/formats.def"
#undef LSYS_EXPORT_FORMAT
};

/// The place where a format stores the textures of materials.
enum class ExportPictures : std::uint8_t {
    None,
    Inside, // embedded in the file; readers multiply them by the colour of the material
    FilesWithNormalMaps, // pictures with the colour of the material; normal maps of bark
    FilesWithOpacity,    // as FilesWithNormalMaps, and pictures with the opacity of leaves
};

/// Axis of a file that points away from the ground. Z: a point (x, y, z) of the mesh is at
/// (x, -z, y) in the file.
enum class UpAxis : std::uint8_t { Y, Z };

/// Collision shapes of trunk and boughs for game engines, as nodes of glTF beside the plant.
enum class CollisionKind : std::uint8_t { None, Capsules, Hulls };
/// Names of the nodes of collision shapes, by which importers recognise them. Unreal: `UCP_tree_00`
/// (capsule), `UCX_tree_00` (hull); Godot: `tree_00-convcolonly`; Unity: `tree_collider_00`.
enum class CollisionNames : std::uint8_t { Unreal, Godot, Unity };

/// Unit of the lengths in a file. The mesh is already in this unit; formats with a field for units
/// state it.
enum class LengthUnit : std::uint8_t { Metres, Centimetres, Millimetres };
/// Units per metre: 1, 100 or 1000.
[[nodiscard]] float units_per_metre(LengthUnit unit);

struct ExportJob;
struct ForestExportJob;
class PieceWriter;

/// A row of formats.def.
struct FormatTraits {
    std::string_view name;    // value of `--format` and extension of files
    std::string_view content; // contents of the format's row in the table of README.md
    bool uses_mesh = true;    // false: drawn from the skeleton, without the mesh
    /// Max size of a mesh in the format.
    std::uint64_t max_vertices = ~std::uint64_t{0};
    std::uint64_t max_triangles = ~std::uint64_t{0};
    ExportPictures pictures = ExportPictures::None;
    bool has_mtl = false;    // materials in a file of their own, by write_mtl()
    bool motion = false;     // one file holds all frames of an animation
    bool film = false;       // one file holds all frames of a growth
    bool lods = false;       // one file holds all levels of detail
    bool variants = false;   // takes ExportInfo::variants
    bool compresses = false; // takes ExportInfo::compression
    bool separates = false;  // takes ExportInfo::buffer_name
    bool wind_data = false;  // takes ExportInfo::wind_data
    bool up_axes = false;    // takes ExportInfo::up
    bool back_faces = false; // takes ExportInfo::both_sides
    bool units = false;      // takes ExportInfo::unit
    bool collision = false;  // takes ExportInfo::collision
    /// Writes a forest, by default as instances; null: the format has no instances.
    Outcome<void> (*write_forest)(const ForestExportJob& job, PieceWriter& out) = nullptr;
    bool expands_forest = false; // write_forest can write ForestForm::Expanded
    /// Writes a plant.
    Outcome<void> (*write)(const ExportJob& job, PieceWriter& out) = nullptr;
};
[[nodiscard]] const FormatTraits& traits_of(ExportFormat format);
/// All formats, in the order of formats.def.
[[nodiscard]] std::span<const ExportFormat> export_formats();
/// The format of the path's extension, in upper or lower case; none if it is unknown.
[[nodiscard]] std::optional<ExportFormat> format_of_path(std::string_view path);
/// Names of the formats for which `is_listed` returns true, in alphabetical order, with
/// `conjunction` before the last: "glb, gltf or usda".
[[nodiscard]] std::string format_names(std::string_view conjunction,
                                       const std::function<bool(const FormatTraits&)>& is_listed);

/// Receives the next bytes; returns false to stop the export.
using ByteSink = std::function<bool(std::string_view)>;

/// Max count of moving joints of a skin: glTF numbers joints in 16 bits, and joint 0 stands still.
inline constexpr std::uint32_t kMaxJoints = 65'535;

/// Encoding of the arrays in a glTF file.
enum class ExportCompression : std::uint8_t {
    None,
    Quantize, // integers of 8 to 16 bits: KHR_mesh_quantization, KHR_texture_transform
    Meshopt,  // quantised, and compressed by EXT_meshopt_compression
};

/// Contents of a file, as messages name them.
enum class ExportSubject : std::uint8_t { Plant, Forest };

/// A coarser level of detail in the same file.
struct CoarserMesh {
    Mesh mesh;
    /// The reader shows this level while the bounding box of the plant covers less than this
    /// fraction of the screen, 0 to 1.
    double coverage = 0.0;
};

/// Alternative plants in one file. A reader shows one of them: the mesh of the file, which is the
/// default, or one of `others`.
struct PlantVariants {
    std::string set;                // name of the variant set
    std::vector<std::string> names; // names of the mesh of the file, then of `others`
    std::vector<Mesh> others;
};

/// Origin and contents of a file.
struct ExportInfo {
    ExportSubject subject = ExportSubject::Plant;
    std::string grammar;   // name of the grammar
    std::string name = {}; // name of the plant, for nodes and meshes; empty: `plant`
    std::uint64_t seed = 0;
    std::uint32_t generations = 0;
    std::string generator;                // the program and its version
    LengthUnit unit = LengthUnit::Metres; // another unit only in formats with FormatTraits::units
    std::string mtl_name;                 // name of the file of write_mtl(); empty: none
    /// Prefix of the names of picture files; empty: no picture files, and materials are plain
    /// colours.
    std::string picture_prefix;
    /// Encoding of the arrays of vertices and indices, in formats with FormatTraits::compresses.
    ExportCompression compression = ExportCompression::None;
    /// Name of the file of write_gltf_buffer() beside a glTF, in formats with
    /// FormatTraits::separates; pictures are then files whose names begin with `picture_prefix`.
    /// Empty: the glTF contains its buffer and pictures.
    std::string buffer_name = {};
    bool textures = true;      // pictures for textured materials, where the format has pictures
    std::uint32_t threads = 0; // 0: as many as the machine has
    /// Meshes of Skeleton::mesh_files, for their outlines in SVG; missing meshes are skipped, all
    /// meshes if null.
    const std::vector<UserMesh>* user_meshes = nullptr;
    /// Poses that move the mesh as a skin, in formats with motion. Preconditions: the skeleton is
    /// the first pose; Mesh::segments has an item for each vertex.
    const PlantAnimation* animation = nullptr; // null: the plant stands still
    /// Frames with different meshes, in formats with films. Preconditions: the exported mesh is
    /// MeshFilm::mesh; no animation, compression or wind data.
    const MeshFilm* film = nullptr; // null: no film
    /// Max count of joints of the skin, 2 to kMaxJoints; the skin then has few joints with smooth
    /// weights (impl/bones.h). 0: a joint for each segment that moves.
    std::uint32_t max_joints = 0;
    /// Write the vertex attributes with which shaders move the plant in wind (impl/wind_data.h), in
    /// formats with FormatTraits::wind_data. Precondition: Mesh::segments has an item for each
    /// vertex.
    bool wind_data = false;
    /// Write the two numbers in Mesh::segments of each vertex to glTF files, as the attribute
    /// `_ITEMS` of two floats; -1 for kNoSegment. Precondition: Mesh::segments has an item for each
    /// vertex.
    bool item_numbers = false;
    UpAxis up = UpAxis::Y; // another axis only in formats with FormatTraits::up_axes
    /// Write the triangles of two-sided materials a second time, with reversed order of corners and
    /// reversed normals, in formats with FormatTraits::back_faces; for readers that draw front
    /// faces only.
    bool both_sides = false;
    /// Collision shapes of the plant at rest, in formats with FormatTraits::collision.
    CollisionKind collision = CollisionKind::None;
    CollisionNames collision_names = CollisionNames::Unreal;
    /// Levels of detail that follow the mesh itself, the finest first, in formats with
    /// FormatTraits::lods; null: none. Precondition: no animation.
    const std::vector<CoarserMesh>* coarser = nullptr;
    /// Other plants in the file, in formats with FormatTraits::variants; null: none. Precondition:
    /// neither an animation nor `coarser`.
    const PlantVariants* variants = nullptr;
};

/// Writes one file to `sink`. Precondition: indices of the mesh are below its number of vertices.
/// Stops before the first byte is written: Failed (nothing to draw, or more than the format can
/// store), Limit (a skin of more than kMaxJoints joints). Stops after any number of bytes:
/// Cancelled (by the sink), OutOfMemory.
Outcome<void> export_mesh(const Mesh& mesh,
                          const Skeleton& skeleton,
                          ExportFormat format,
                          const ExportInfo& info,
                          const ByteSink& sink);
/// Writes the buffer of a glTF, the file `info.buffer_name`. Stops as export_mesh().
Outcome<void> write_gltf_buffer(const Mesh& mesh,
                                const Skeleton& skeleton,
                                const ExportInfo& info,
                                const ByteSink& sink);
/// A PNG file that an exported file refers to.
struct PictureFile {
    std::string name;
    std::string bytes;
};
/// The picture files to write beside a file of the format. Stops: OutOfMemory.
Outcome<std::vector<PictureFile>>
make_picture_files(const Mesh& mesh, ExportFormat format, const ExportInfo& info);
Outcome<void> write_picture_file(const PictureFile& picture, const ByteSink& sink);
/// Writes the materials of an OBJ, with colours in sRGB. Stops as export_mesh().
Outcome<void> write_mtl(const Mesh& mesh, const ExportInfo& info, const ByteSink& sink);

} // namespace lsys
