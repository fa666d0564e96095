// SPDX-License-Identifier: MIT
// Export: plants as files for other programs. Writes the bytes of one file, or all files of an
// export with its preset, levels of detail, pictures, motion or growth.
#pragma once

#include <cstdint>
#include <functional>
#include <lsys/api.h>
#include <lsys/outcome.h>
#include <lsys/plant.h>
#include <lsys/project.h>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lsys::LSYS_INTERFACE {

enum class Compression : std::uint8_t {
    None,
    Quantize, // integers of 8 to 16 bits: KHR_mesh_quantization
    Meshopt,  // quantised, then EXT_meshopt_compression
};

enum class UpAxis : std::uint8_t { Y, Z };

/// Options of an export. An option that the format does not accept is an error, as in `lsc export`.
struct ExportOptions {
    std::string name = "plant";                  // name of nodes and meshes
    Compression compression = Compression::None; // for glb and gltf
    UpAxis up = UpAxis::Y;                       // for obj, ply, stl, usda and usdz
};

/// Names of the formats, such as "glb" and "obj".
[[nodiscard]] LSYS_API const std::vector<std::string>& export_formats();
/// The format of a path by its extension, in lower case; empty: none.
[[nodiscard]] LSYS_API std::string format_of_path(std::string_view path);

/// Calls `write` with one file in pieces, until it returns false (Status::Cancelled). Pictures are
/// embedded, as in glb, or left out. An exception of `write` ends the call and is rethrown. Returns
/// the number of bytes.
[[nodiscard]] LSYS_API Outcome<std::uint64_t>
export_plant(const Plant& plant,
             const Mesh& mesh,
             std::string_view format,
             const std::function<bool(std::string_view piece)>& write,
             const ExportOptions& options = {},
             const Project& project = {});

/// Options of `lsc export` (or `lsc forest`) by name without dashes, and their values, empty for
/// flags: {{"preset", "unreal"}, {"lods", "6"}, {"wind-data", ""}}. docs/commands.md lists them.
using Options = std::vector<std::pair<std::string, std::string>>;

/// Name, value and help of an option of an OptionSet.
struct OptionHelp {
    std::string name;       // as in Options
    std::string value_name; // "METRES", "none|capsules|hulls"; empty for a flag
    std::string text;
};
enum class OptionSet : std::uint8_t {
    Plant,  // options of save_plant()
    Forest, // options of save_forest()
    Scene,  // names for ForestOptions::scene
};
[[nodiscard]] LSYS_API std::vector<OptionHelp> describe_options(OptionSet set);

/// A piece of a file. Pieces of a file follow each other; the last one is empty.
struct FilePiece {
    std::string_view name;
    std::string_view bytes;
    bool is_last = false;
};
/// Receives files, one after the other, instead of a folder on disk; returns false to end the call
/// with Status::Cancelled. An exception ends the call, which rethrows it.
using FileReceiver = std::function<bool(const FilePiece& piece)>;

/// Writes `mesh`, a mesh of `plant`, unchanged, to one file, which appears when it is complete.
/// `format`: one of export_formats(). Like save_plant(), it replaces no file that the plant was made
/// from. Returns the path.
[[nodiscard]] LSYS_API Outcome<std::vector<std::string>>
save_mesh(const Plant& plant,
          const Mesh& mesh,
          const std::string& path,
          std::string_view format,
          const ExportOptions& options = {},
          const Project& project = {});

/// Names of the presets, such as "web" and "unreal".
[[nodiscard]] LSYS_API const std::vector<std::string>& preset_names();

/// Writes `path`, whose extension sets the format, and the files beside it: pictures, materials,
/// buffers, levels, frames. All appear when they are complete, or none. None replaces a file that
/// the plant was made from: an error. Returns their paths.
/// Options: the options of `lsc export` for form, mesh, levels of detail, bending, motion and
/// growth (from `format` to `fps` in its help), and `height`, which grows the plant again.
[[nodiscard]] LSYS_API Outcome<std::vector<std::string>> save_plant(const Plant& plant,
                                                                    const std::string& path,
                                                                    const Options& options = {},
                                                                    const Project& project = {});
/// Like save_plant(), but passes the files to `receive`.
[[nodiscard]] LSYS_API Outcome<std::vector<std::string>> write_plant(const Plant& plant,
                                                                     const std::string& name,
                                                                     const FileReceiver& receive,
                                                                     const Options& options = {},
                                                                     const Project& project = {});

} // namespace lsys::LSYS_INTERFACE
