// Export: a mesh, or for drawings the skeleton, as a file of somebody else's. Bytes go to a sink in
// pieces and in order, large arrays straight from memory; the file as a whole exists nowhere. Made
// from the results of make_mesh() and the turtle; read by the command line, which owns the files.
// Units are metres and +Y is up in every format that has a say in it. Same input, same bytes.
#pragma once

#include "runtime/meshing/mesh.h"
#include "runtime/turtle/skeleton.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

struct PlantAnimation;

enum class ExportFormat : std::uint8_t { Obj, Ply, Off, OffPlus, Stl, Gltf, Glb, Svg, Usda };

/// By the extension, in capitals or not.
[[nodiscard]] std::optional<ExportFormat> format_of_path(std::string_view path);
/// Svg is drawn from the skeleton; all others are made from the mesh, which it does not look at.
[[nodiscard]] bool uses_mesh(ExportFormat format);

/// Takes the next bytes; false stops the export.
using ByteSink = std::function<bool(std::string_view)>;

/// Of a skin: glTF counts joints in 16 bits, and one of them is that of what stands still.
inline constexpr std::uint32_t kMostJoints = 65'535;

/// What a file says about where it comes from.
struct ExportInfo {
    std::string grammar; // its name
    std::uint64_t seed = 0;
    std::uint32_t generations = 0;
    std::string generator; // the program and its version
    std::string mtl_name;  // the file of write_mtl() beside an OBJ; empty: none
    /// OBJ and USDA: what the names of their pictures begin with, which are files beside them;
    /// empty: there are none, and materials are plain colours.
    std::string picture_prefix;
    bool textures = true;      // pictures for the materials that are textured, where the format can
    std::uint32_t threads = 0; // 0: as many as the machine has
    /// Those of Skeleton::mesh_files, whose outlines Svg draws; it leaves out what is not here.
    const std::vector<UserMesh>* user_meshes = nullptr;
    /// glTF: the mesh is a skin that these poses move, of which the skeleton is the first. The mesh
    /// has its segments.
    const PlantAnimation* animation = nullptr;
};

enum class ExportStatus : std::uint8_t {
    Ok,
    Nothing,       // no triangle, or for Svg nothing drawn: no byte was written
    TooLarge,      // more than the format can hold: no byte was written
    TooManyJoints, // of a skin, more than kMostJoints: no byte was written
    Stopped,       // the sink said so
    OutOfMemory,
};

/// Writes one file to `sink`. Indices of the mesh must be below its number of vertices.
[[nodiscard]] ExportStatus export_mesh(const Mesh& mesh,
                                       const Skeleton& skeleton,
                                       ExportFormat format,
                                       const ExportInfo& info,
                                       const ByteSink& sink);
/// A PNG that a file refers to.
struct PictureFile {
    std::string name;
    std::string bytes;
};
/// Those of an OBJ and its MTL, or of a USDA.
[[nodiscard]] ExportStatus make_picture_files(const Mesh& mesh,
                                              ExportFormat format,
                                              const ExportInfo& info,
                                              std::vector<PictureFile>& files);
/// The materials of an OBJ, whose colours are sRGB. Nothing where there is no OBJ.
[[nodiscard]] ExportStatus
write_mtl(const Mesh& mesh, const ExportInfo& info, const ByteSink& sink);

} // namespace lsys
