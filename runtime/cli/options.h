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
    std::string fix;   // `certain` or `offered` repairs are applied; empty: none
    bool diff = false; // repairs are shown, and no file is written
    bool part = false; // the files are parts of grammars
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
    std::optional<float> rho;           // of --stage instanced, heroes and cache
    std::optional<std::uint64_t> first; // form of --stage instanced
    std::optional<std::uint64_t> rows;  // forms of --stage instanced
    std::optional<std::uint32_t> heroes;
    std::optional<std::uint32_t> cache_cap;
    std::optional<float> tolerance;
    bool origins = false;
    std::optional<std::uint32_t> steps; // generations of this run
    std::string save_state;
    std::string from;
};

/// Place of the buffer and the pictures of a glTF.
enum class BufferPlace : std::uint8_t {
    Embedded,
    Separate, // files beside the output
};

/// Options of the file of a mesh.
struct SurfaceOptions {
    UpAxis up = UpAxis::Y;
    bool both_sides = false;
};

/// Values of a constant of the grammar: a plant for each in one file.
struct VariantValues {
    std::string name;
    std::vector<std::string> texts; // as they were given
    std::vector<float> values;
};

struct ExportCommand {
    MessageOptions messages;
    GrammarOptions grammar;
    RunOptions run;
    std::optional<std::uint64_t> seed;
    std::string file;
    std::string output;
    std::optional<ExportFormat> format;           // default: by the extension of the output
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
    std::optional<float> gravity; // m/s^2; gravity or wind bend the plant
    std::optional<Wind> wind;
    bool settle = false;
    /// Max joints of a skin, 0: one for each segment that moves; default 128.
    std::optional<std::uint32_t> bones;
    bool wind_data = false;   // in vertices, for shaders
    bool loop = false;        // the last frame is the first
    bool grow = false;        // the frames show the generations
    std::uint32_t frames = 0; // of an animation or of numbered files; 0: the plant at rest
    float frames_per_second = 24.0F;
    bool stream = false;
    std::uint32_t lods = 0; // levels of detail to write; 0: MeshOptions::level alone
    bool lod_files = false; // a file for each level
    std::optional<VariantValues> variants;
    bool stats = false;
};

/// Parts of a forest that its file repeats.
enum class ForestInstances : std::uint8_t { Branches, Trees, Lods };

/// Place of a scene that is the origin of its file.
enum class ForestPivot : std::uint8_t {
    Origin, // that of the scene
    Base,   // the ground in the middle of the scene's rectangle
};

struct ForestCommand {
    MessageOptions messages;
    std::vector<std::string> files; // one scene, or grammars
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
    std::optional<glm::vec3> viewpoint; // m, of ForestInstances::Lods
    /// Side in m of the ground cells with one node each; 0: one cell; unset: 100, of whole trees 0.
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
    std::optional<float> gravity; // m/s^2; weighs the plant too
    bool parameters = false;      // list the constants instead
};

enum class TraceFormat : std::uint8_t { Text, Json };

struct TraceCommand {
    MessageOptions messages;
    GrammarOptions grammar; // generations: the generation of the modules
    RunOptions run;
    std::optional<std::uint64_t> seed;
    std::string file;
    std::string output = "-";
    std::optional<std::uint64_t> position;
    std::string module;
    std::string name; // of --all
    std::uint64_t rows = 10;
    bool back = false;
    std::optional<TraceFormat> format; // default: text; JSON with --message-format json
};

struct ImportCommand {
    MessageOptions messages;
    GrammarOptions grammar;
    RunOptions run;
    std::string file;   // empty: all of `folder`
    std::string folder; // of --all
    std::string output; // a file, or a folder for --all
    bool force = false; // replace existing files whose names the program chose
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
