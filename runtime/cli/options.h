// The options of each command, one struct per command. Made by command_line.cpp.
#pragma once

#include "runtime/export/export.h"
#include "runtime/export/placed_plant.h"
#include "runtime/meshing/mesh.h"
#include "runtime/physics/physics.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/pipeline/scene_overrides.h"
#include "runtime/program/message_options.h"
#include "runtime/program/run_options.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lsys::lsc {

struct CheckCommand {
    MessageOptions messages;
    GrammarOptions grammar;
    RunOptions run;
    std::vector<std::string> files;
    std::string fix;   // which repairs to apply: `certain`, `offered`, or empty for none
    bool diff = false; // show repairs as a difference, write no file
    bool part = false; // GrammarOptions::part for all files
};

struct CompileCommand {
    MessageOptions messages;
    GrammarOptions grammar;
    RunOptions run;
    std::optional<std::uint64_t> seed;
    std::string file;
    std::string output;
};

enum class DumpStage : std::uint8_t {
    Tokens,
    Ast,
    Program,
    Instanced,
    Bytecode,
    Word,
    Skeleton,
    Mesh,
    Heroes,
    Cache
};

struct DumpCommand {
    MessageOptions messages;
    GrammarOptions grammar;
    RunOptions run;
    std::optional<std::uint64_t> seed;
    std::string file;
    std::string output = "-";
    DumpStage stage = DumpStage::Word;
    MeshOptions mesh;
    std::optional<float> height; // m, of the plant
    bool all = false;
    bool count = false;
    bool stream = false;
    std::optional<float> rho;           // --rho, for --stage instanced, heroes and cache
    std::optional<std::uint64_t> first; // for --stage instanced: first form listed
    std::optional<std::uint64_t> rows;  // for --stage instanced: number of forms per production
    std::optional<std::uint32_t> heroes;
    std::optional<std::uint32_t> cache_cap;
    std::optional<float> tolerance;
    bool origins = false;
    std::optional<std::uint32_t> steps; // number of generations to derive in this run
    std::string save_state;
    std::string from;
};

/// Place of the buffer and the pictures of a glTF.
enum class BufferPlace : std::uint8_t {
    Embedded,
    Separate, // files beside the output
};

/// Options of mesh files that only some formats accept.
struct SurfaceOptions {
    UpAxis up = UpAxis::Y;
    bool both_sides = false;
};

/// Values of one constant of the grammar, for a file with one plant per value.
struct VariantValues {
    std::string name;
    std::vector<std::string> texts; // the values as the user wrote them
    std::vector<float> values;
};

struct ExportCommand {
    MessageOptions messages;
    GrammarOptions grammar;
    RunOptions run;
    std::optional<std::uint64_t> seed;
    std::string file;
    std::string output;
    std::optional<ExportFormat> format;           // default: from the extension of the output
    std::optional<ExportCompression> compression; // default: none
    std::optional<BufferPlace> buffers;           // default: embedded
    SurfaceOptions surface;
    std::string preset; // of presets.def; empty: none
    LengthUnit unit = LengthUnit::Metres;
    PlantPivot pivot = PlantPivot::Origin;
    CollisionKind collision = CollisionKind::None;
    CollisionNames collision_names = CollisionNames::Unreal;
    MeshOptions mesh;
    std::optional<float> height;  // m, of the plant
    std::optional<float> gravity; // m/s^2; with gravity or wind the plant is bent
    std::optional<Wind> wind;
    bool settle = false;
    /// Max number of joints of a skin. 0: one per segment that moves. Default: 128.
    std::optional<std::uint32_t> bones;
    bool wind_data = false;   // add vertex attributes for wind shaders
    bool loop = false;        // the last frame of the motion equals the first
    bool grow = false;        // the frames show the growth through the generations
    std::uint32_t frames = 0; // of an animation or of numbered files; 0: only the plant at rest
    float frames_per_second = 24.0F;
    bool stream = false;
    std::uint32_t lods = 0; // number of levels of detail to write; 0: only MeshOptions::level
    bool lod_files = false; // one file per level
    std::optional<VariantValues> variants;
    bool stats = false;
};

/// The objects that a forest file instances: shared branches, whole trees, or trees with levels of
/// detail.
enum class ForestInstances : std::uint8_t { Branches, Trees, Lods };

/// The point of the scene that becomes the origin of the file.
enum class ForestPivot : std::uint8_t {
    Origin, // the origin of the scene
    Base,   // the ground in the middle of the scene's rectangle
};

struct ForestCommand {
    MessageOptions messages;
    std::vector<std::string> files; // one scene, or one or more grammars
    std::string output;             // empty: none
    std::string preset;             // of presets.def; empty: none
    SceneOverrides overrides;
    RunOptions run;
    std::optional<ExportCompression> compression; // default: none
    bool expand = false;
    bool bake = false;
    SurfaceOptions surface;
    LengthUnit unit = LengthUnit::Metres;
    ForestPivot pivot = ForestPivot::Origin;
    CollisionKind collision = CollisionKind::None;
    CollisionNames collision_names = CollisionNames::Unreal;
    ForestInstances instances = ForestInstances::Branches;
    std::optional<glm::vec3> viewpoint; // m, for ForestInstances::Lods
    /// Side in m of the square cells of ground whose trees share a node. 0: a single cell. Unset:
    /// 100 for ForestInstances::Branches, else 0.
    std::optional<float> cell;
    std::uint32_t frames = 0;
    bool check = false;
    bool stats = false;
    MeshOptions mesh;
};

struct StatsCommand {
    MessageOptions messages;
    GrammarOptions grammar;
    RunOptions run;
    std::optional<float> height; // m, of the plant
    std::string file;
    std::optional<float> gravity; // m/s^2; if set, also reports the plant under its weight
    bool parameters = false;      // list the constants instead of sizes
};

enum class TraceFormat : std::uint8_t { Text, Json };

struct TraceCommand {
    MessageOptions messages;
    GrammarOptions grammar; // `generations` is the generation of the traced modules
    RunOptions run;
    std::optional<std::uint64_t> seed;
    std::string file;
    std::string output = "-";
    std::optional<std::uint64_t> position;
    std::string module;
    std::string name; // module name of --all
    std::uint64_t rows = 10;
    bool written = false;
    bool back = false;
    std::optional<TraceFormat> format; // default: text; JSON with --message-format json
};

struct ImportCommand {
    MessageOptions messages;
    GrammarOptions grammar;
    RunOptions run;
    std::string file;   // empty: all files of `folder`
    std::string folder; // folder of --all
    std::string output; // a file, or with --all a folder
    bool force = false; // replace existing files whose names the program has chosen
};

struct FormatCommand {
    MessageOptions messages;
    std::string dialect;
    std::vector<std::string> files;
    bool check = false;
};

struct ExplainCommand {
    MessageOptions messages;
    std::string code; // empty: list all codes
};

} // namespace lsys::lsc
