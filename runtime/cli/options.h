// SPDX-License-Identifier: MIT
// The options of each command, one struct per command. Made by command_line.cpp.
#pragma once

#include "runtime/meshing/mesh.h"
#include "runtime/output/file_options.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/pipeline/scene_overrides.h"
#include "runtime/program/message_options.h"
#include "runtime/program/run_options.h"
#include "runtime/serve/http_server.h"
#include "runtime/tiles/tiles.h"

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

    friend bool operator==(const CheckCommand&, const CheckCommand&) = default;
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
    Instanced, // the instanced system, in which branches are recorded or replaced
    Bytecode,
    Word,
    Skeleton,
    Mesh,
    Heroes,     // words of the heroes of a forest
    Cache,      // branches recorded from the heroes
    Environment // what the plant sensed last
};

/// Format of `dump --stage environment`.
enum class EnvironmentFormat : std::uint8_t { Json, Ply };

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
    std::optional<EnvironmentFormat> environment_format;
    bool all = false;    // --all: every generation
    bool count = false;  // --count: the number of modules in place of the word
    bool stream = false; // --stream: derive without storing words
    /// --rho, for --stage instanced, heroes and cache: probability that a branch is replaced by a
    /// recorded one.
    std::optional<float> rho;
    // For --stage instanced, which lists 2^n forms of a production with n branches: each branch is
    // written out or replaced by a recorded one.
    std::optional<std::uint64_t> first; // number of the first form listed
    std::optional<std::uint64_t> rows;  // number of forms listed per production
    // For --stage heroes and cache.
    std::optional<std::uint32_t> heroes;    // number of plants derived completely
    std::optional<std::uint32_t> cache_cap; // CacheOptions::cap
    std::optional<float> tolerance;         // CacheOptions::tolerance
    bool origins = false; // --origins: the place in the grammar that wrote each module
    std::optional<std::uint32_t> steps; // number of generations to derive in this run
    std::string save_state;             // file of the saved derivation; empty: none
    std::string from; // --from: file of a saved derivation to continue; empty: none
};

struct ExportCommand : PlantFileOptions {
    MessageOptions messages;
    GrammarOptions grammar;
    RunOptions run;
    std::optional<std::uint64_t> seed;
    std::string file;
    std::optional<VariantValues> variants;
    bool stats = false; // print counts, sizes and times
};

struct ForestCommand : ForestFileOptions {
    MessageOptions messages;
    std::vector<std::string> files; // one scene, or one or more grammars
    SceneOverrides overrides;
    RunOptions run;
    bool check = false; // check the scene and its grammars, write no file
    bool stats = false; // print counts of trees, branches and cached instances
};

/// The share of one process, if several processes write one tileset (`--part I/N`).
struct TilePart {
    std::uint64_t index = 1; // number of this process, 1 to `count`
    std::uint64_t count = 1; // number of processes
};

/// Value of `--instances`: each tree is a whole hero, or is assembled from branches of heroes.
enum class TileInstances : std::uint8_t { Trees, Branches };

/// A scene for `lsc place`, `lsc tiles` and `lsc serve`.
struct SceneCommand {
    MessageOptions messages;
    std::vector<std::string> files; // one scene, or one or more grammars
    TileInstances instance_kind = TileInstances::Trees;
    SceneOverrides overrides;
    RunOptions run;
};

struct PlaceCommand : SceneCommand {
    std::string output; // a tree file
    bool stats = false; // print numbers of trees
};

/// Options that `lsc tiles` and `lsc serve` share.
struct TileScene : SceneCommand {
    TileOptions tiles;
    std::string trees; // a file of `lsc place`; empty: the scene is placed
};

struct TilesCommand : TileScene {
    std::string output;  // folder
    bool force = false;  // write into a folder that has files
    bool resume = false; // keep existing files and write the missing ones
    TilePart part;
    bool stats = false; // print the levels of the tileset and their errors
};

struct ServeCommand : TileScene {
    ServerOptions server;
    std::uint64_t cache_bytes = std::uint64_t{256} << 20U; // max memory of cached tiles
};

struct StatsCommand {
    MessageOptions messages;
    GrammarOptions grammar;
    RunOptions run;
    std::optional<float> height; // m, of the plant
    std::string file;
    std::optional<float> gravity; // m/s^2; if set, report how the plant bends under its weight
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
    // As in TraceOptions: exactly one of the three is set.
    std::optional<std::uint64_t> position;
    std::string module;
    std::string name;                  // module name of --all
    std::uint64_t rows = 10;           // max number of modules of `name`
    bool written = false;              // --written: trace the step that wrote the module
    bool back = false;                 // --back: follow a module back to the axiom
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
    RunOptions run;
    std::string dialect; // value of --dialect; empty: found from the file
    std::vector<std::string> files;
    bool check = false; // list the files that are not formatted, write no file
};

struct LspCommand {
    MessageOptions messages;
    RunOptions run;
    bool stdio = false; // no effect: the streams are always used
};

struct ExplainCommand {
    MessageOptions messages;
    std::string code; // empty: list all codes
};

} // namespace lsys::lsc
