// What the command line asks for, one struct a command. Made by command_line.cpp, read by the
// command of the same name.
#pragma once

#include "compiler/compile.h"
#include "grammar/render_diagnostic.h"
#include "runtime/export.h"
#include "runtime/mesh.h"
#include "runtime/physics.h"
#include "runtime/placement.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lsys::lsc {

enum class ColourMode : std::uint8_t { Auto, Always, Never };

/// How messages are shown; every command has these.
struct MessageOptions {
    MessageFormat format = MessageFormat::Human;
    ColourMode colour = ColourMode::Auto;
    bool deny_warnings = false;
    bool quiet = false;   // errors only, no progress
    bool verbose = false; // what is done, and how large it is
};

/// How a grammar is read and compiled.
struct GrammarOptions {
    std::string dialect; // empty: by what the file holds, else by its extension
    bool bug_compatible = false;
    std::string system; // of a file that holds several; empty: the only one
    std::vector<Definition> definitions;
    std::optional<std::uint32_t> generations; // -n
    std::uint64_t max_modules = std::uint64_t{1} << 32;
    std::uint64_t max_bytes = ~std::uint64_t{0}; // of the files that it is made from
};

struct CheckCommand {
    MessageOptions messages;
    GrammarOptions grammar;
    std::vector<std::string> files;
    bool fix = false;
};

struct CompileCommand {
    MessageOptions messages;
    GrammarOptions grammar;
    std::optional<std::uint64_t> seed;
    std::string file;
    std::string output;
};

enum class Stage : std::uint8_t { Tokens, Ast, Program, Instanced, Bytecode, Word, Skeleton, Mesh };

struct DumpCommand {
    MessageOptions messages;
    GrammarOptions grammar;
    std::optional<std::uint64_t> seed;
    std::uint32_t threads = 0; // 0: as many as the machine has
    std::uint64_t max_bytes = 0;
    std::string file;
    std::string output = "-";
    Stage stage = Stage::Word;
    MeshOptions mesh;
    bool all = false;
    bool count = false;
    bool stream = false;
    std::optional<float> rho;           // of --stage instanced
    bool origins = false;               // say which production wrote each module, and where
    std::optional<std::uint32_t> steps; // generations of this run
    std::string save_state;
    std::string from;
};

struct ExportCommand {
    MessageOptions messages;
    GrammarOptions grammar;
    std::optional<std::uint64_t> seed;
    std::uint32_t threads = 0; // 0: as many as the machine has
    std::uint64_t max_bytes = 0;
    std::string file;
    std::string output;
    std::optional<ExportFormat> format; // none: by the output's name
    MeshOptions mesh;
    std::optional<float> gravity; // m/s^2; any of these three: the plant bends
    std::optional<Wind> wind;
    bool settle = false;
    std::uint32_t frames = 0; // of an animation or a numbered series; 0: the plant at rest
    float frames_per_second = 24.0F;
    bool stream = false;
    bool stats = false;
};

/// A tile of an unbounded forest: a square of `size` metres, `column` along X and `row` along Z.
struct ForestTile {
    std::int64_t column = 0;
    std::int64_t row = 0;
    double size = 0.0;
};

/// What is left out is the scene's.
struct ForestCommand {
    MessageOptions messages;
    GrammarOptions grammar;
    std::vector<std::string> files; // one scene, or grammars
    std::string output;             // empty: none
    std::optional<std::uint64_t> key;
    std::optional<std::uint64_t> seed; // of the heroes
    std::optional<std::uint32_t> heroes;
    std::optional<float> rho;
    std::optional<std::uint32_t> cache_cap;
    std::optional<float> tolerance;
    std::optional<PlacementMethod> method;
    std::optional<std::uint64_t> count;
    std::optional<float> size;    // m, of a square around the origin
    std::optional<float> spacing; // m
    std::optional<float> density; // places a square metre
    std::string density_map;
    std::optional<std::uint32_t> years;
    std::optional<ForestTile> tile;
    bool expand = false;
    bool bake = false;
    float cell = 100.0F; // m, of the squares whose instances are one node; 0: all are
    std::uint32_t frames = 0;
    bool check = false;
    bool stats = false;
    MeshOptions mesh;
    std::uint32_t threads = 0; // 0: as many as the machine has
    std::uint64_t max_bytes = 0;
};

struct StatsCommand {
    MessageOptions messages;
    GrammarOptions grammar;
    std::string file;
};

struct ImportCommand {
    MessageOptions messages;
    GrammarOptions grammar;
    std::string file;   // empty: all of `folder`
    std::string folder; // whose files are all imported
    std::string output; // a file, or a folder for --all
    bool force = false; // replace files whose names come from systems or other files
};

struct FormatCommand {
    MessageOptions messages;
    std::string dialect;
    std::vector<std::string> files;
    bool check = false;
};

struct ExplainCommand {
    MessageOptions messages;
    std::string code; // empty: the list of all
};

} // namespace lsys::lsc
