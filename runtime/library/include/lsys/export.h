// Export: writes a plant and its mesh as a file for other programs.
#pragma once

#include <cstdint>
#include <functional>
#include <lsys/api.h>
#include <lsys/outcome.h>
#include <lsys/plant.h>
#include <lsys/project.h>
#include <string>
#include <string_view>
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

/// Names of the formats, "glb", "obj" ...
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

} // namespace lsys::LSYS_INTERFACE
