// SPDX-License-Identifier: MIT
// Options of files of plants and forests: one struct for each. Made by file_option_parsers.h from
// texts; read by plant_files.h and forest_files.h.
#pragma once

#include "runtime/export/export.h"
#include "runtime/export/placed_plant.h"
#include "runtime/meshing/mesh.h"
#include "runtime/physics/physics.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lsys {

/// Place of the buffer and the pictures of a glTF.
enum class BufferPlace : std::uint8_t {
    Embedded,
    Separate, // files beside the output
};

/// Options for files of meshes that only some formats accept.
struct SurfaceOptions {
    UpAxis up = UpAxis::Y;
    bool both_sides = false; // ExportInfo::both_sides
};

/// Values of one constant of the grammar, for a file with one plant per value.
struct VariantValues {
    std::string name;
    std::vector<std::string> texts; // the values as the user wrote them
    std::vector<float> values;
};

struct PlantFileOptions {
    std::string output;
    std::optional<ExportFormat> format;           // default: from the extension of the output
    std::optional<ExportCompression> compression; // default: none
    std::optional<BufferPlace> buffers;           // default: embedded
    SurfaceOptions surface;
    std::string preset; // name in presets.def; empty: none
    LengthUnit unit = LengthUnit::Metres;
    PlantPivot pivot = PlantPivot::Origin;
    CollisionKind collision = CollisionKind::None;
    CollisionNames collision_names = CollisionNames::Unreal;
    MeshOptions mesh;
    std::optional<float> height;  // m, of the plant
    std::optional<float> gravity; // m/s^2; with gravity or wind the plant is bent
    std::optional<Wind> wind;
    bool settle = false; // start the motion at rest; without frames a plant is always at rest
    /// Max number of joints of a skin. 0: one per segment that moves. Default: 128.
    std::optional<std::uint32_t> bones;
    bool wind_data = false; // add vertex attributes for wind shaders
    bool loop = false;      // the last frame equals the first
    bool grow = false;      // the frames show the growth through the generations
    /// Frames of an animation or numbered files; 0: a plant that does not move.
    std::uint32_t frames = 0;
    float frames_per_second = 24.0F;
    bool stream = false;    // grow the plant without storing its word
    std::uint32_t lods = 0; // number of levels of detail to write; 0: only MeshOptions::level
    bool lod_files = false; // one file per level
};

/// The objects that a forest file instances: shared branches, whole trees, or trees with levels of
/// detail.
enum class ForestInstances : std::uint8_t { Branches, Trees, Lods };

/// The point of the scene that becomes the origin of the file.
enum class ForestPivot : std::uint8_t {
    Origin, // the origin of the scene
    Base,   // the ground in the middle of the scene's rectangle
};

struct ForestFileOptions {
    std::string output;                           // empty: none
    std::string preset;                           // name in presets.def; empty: none
    std::optional<ExportCompression> compression; // default: none
    bool expand = false;                          // glTF: one node per instance
    bool bake = false;                            // all triangles as one mesh
    SurfaceOptions surface;
    LengthUnit unit = LengthUnit::Metres;
    ForestPivot pivot = ForestPivot::Origin;
    CollisionKind collision = CollisionKind::None;
    CollisionNames collision_names = CollisionNames::Unreal;
    ForestInstances instance_kind = ForestInstances::Branches;
    std::optional<glm::vec3> viewpoint; // m, for ForestInstances::Lods
    /// Side in m of the square cells of ground whose trees share a node. 0: a single cell. Unset:
    /// 100 for ForestInstances::Branches, else 0.
    std::optional<float> cell;
    std::uint32_t frames = 0; // moments of growth, one file each; 0: a single file
    MeshOptions mesh;
};

} // namespace lsys
