// The options of each command, one struct per command. Made by command_line.cpp, read by the
// command of the same name.
#pragma once

#include "runtime/export/export.h"
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
    bool fix = false;
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
    Mesh
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
    RunOptions run;
    std::optional<std::uint64_t> seed;
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

struct ForestCommand {
    MessageOptions messages;
    std::vector<std::string> files; // one scene, or grammars
    std::string output;             // empty: none
    SceneOverrides overrides;
    RunOptions run;
    bool expand = false;
    bool bake = false;
    float cell = 100.0F; // m, of the squares whose instances are one node; 0: all are
    std::uint32_t frames = 0;
    bool check = false;
    bool stats = false;
    MeshOptions mesh;
};

struct StatsCommand {
    MessageOptions messages;
    GrammarOptions grammar;
    RunOptions run;
    std::string file;
};

struct ImportCommand {
    MessageOptions messages;
    GrammarOptions grammar;
    RunOptions run;
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
