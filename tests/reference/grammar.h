// SPDX-License-Identifier: MIT
// A grammar as plain data, statement by statement. The generator of random grammars and
// hand-written tests make it, the oracle (derive.h) reads it, and the printer (print.h) writes it
// as text. It shares no code with the compiler, so that both cannot have the same mistake. The
// order of all lists matters: statements are in the order of the text, and a file that is included
// stands where its #include stands.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lsys::reference {

enum class ExprKind { Number, Name, Unary, Binary, Call, Range };

// An expression as a tree. `text` is the name, the operator ("-", "&&") or the function. For a
// number it is the spelling to print; if it is empty, any spelling of `number` may be printed.
struct Expr {
    ExprKind kind = ExprKind::Number;
    float number = 0;
    std::string text;
    std::vector<Expr> parts;
};

// A module of the axiom or of a successor. Brackets are modules named "[" and "]".
struct ModuleUse {
    std::string name;
    std::vector<Expr> arguments;
};

// A module of a predecessor or of a context. The brackets of a right context are modules, too.
struct ModulePattern {
    std::string name;
    std::vector<std::string> formals;
};

using Pattern = std::vector<ModulePattern>;

// Down and Up: the sweeps of `#down` (from the last module of the word to the first: from tips to the
// base) and `#up` (from the first to the last).
enum class Stage { Rewrite, Decompose, Interpret, Down, Up };

struct Production {
    Stage stage = Stage::Rewrite;
    std::string label;
    Pattern predecessor;
    std::optional<Pattern> left;
    std::optional<Pattern> right;
    std::optional<Expr> condition; // absent: `*`, or nothing before `~`
    std::optional<Expr> probability;
    std::vector<std::pair<std::string, Expr>> locals; // `let name = value`
    std::vector<ModuleUse> successor;
};

// A key of `#sense` with its value: one of `numbers`, `word` and `file`.
struct SenseKey {
    std::string key;
    std::vector<Expr> numbers;
    std::string word; // a shape of `space`
    std::string file; // path of a mesh or picture of the grammar
};

// An environment: `#sense NAME KIND key value ...;`, where NAME is that of the statement.
struct Sense {
    std::string kind;
    std::vector<SenseKey> keys;
};

enum class StatementKind {
    Generations,
    Define,
    Param,
    Function,
    Curve,
    Module,
    Object,
    IncludeFile,
    Set,
    Ignore,
    Consider,
    Material,
    Sense,
    Axiom,
    Production,
};

struct Statement {
    StatementKind kind = StatementKind::Axiom;
    std::string name;     // Define, Param, Function, Curve; Sense: without `?`; Object: the module;
                          // Set: the key
    std::string text;     // Object: the object; Set, Material: the values as they are written
    std::string mesh;     // Object: path of a mesh of the grammar, in place of `text`
    std::size_t file = 0; // IncludeFile: index into Grammar::files
    Expr expr;            // Generations, Define, Param; Function: the body; Axiom: its probability
    bool has_probability = false;              // Axiom: one of several
    std::vector<std::pair<Expr, Expr>> points; // Curve
    Expr low;                                  // Param: the lower bound
    Expr high;                                 // Param: the upper bound
    Pattern patterns;                          // Module: the declared module
    std::vector<std::string> names;            // Ignore, Consider; Function: the formals
    std::vector<ModuleUse> modules;            // Axiom
    Production production;                     // Production
    Sense sense;                               // Sense
};

struct File {
    std::string path;     // relative to the folder of the test, with '/'
    bool letters = false; // `#set names letters`; the statement itself is among `statements`
    std::vector<Statement> statements;
};

// A mesh that the grammar names. Coordinates are binary32 numbers.
struct MeshFile {
    std::string path; // as File::path
    std::vector<std::array<float, 3>> vertices;
    std::vector<std::vector<std::size_t>> faces; // indexes of vertices from 0, at least three
};

// A picture that the grammar names, a PNG file.
struct PictureFile {
    std::string path; // as File::path
    std::size_t columns = 0;
    std::size_t rows = 0;
    std::size_t channels = 1;           // 1 grey, 2 grey and alpha, 3 RGB, 4 RGB and alpha
    unsigned depth = 8;                 // bits of a sample: 8 or 16
    std::vector<std::uint16_t> samples; // by rows, from the first row on
};

// files[0] is the one given to the compiler.
struct Grammar {
    std::vector<File> files;
    std::vector<MeshFile> meshes;
    std::vector<PictureFile> pictures;
};

// All statements except IncludeFile, in the order in which they take effect.
std::vector<const Statement*> statements_in_order(const Grammar& grammar);

// Whether a module of that name senses: it begins with `?`.
bool is_sense_name(const std::string& name);

// The value of `#set key`, if the grammar has one.
std::optional<std::string> setting(const Grammar& grammar, const std::string& key);

// The text `left < predecessor > right`, with names and numbers of parameters only. Productions
// with equal texts form a group (docs/language.md section 5).
std::string group_of(const Production& production);

// The text of the predecessor, with names and numbers of parameters only. Productions with equal
// texts form a rule (docs/language.md section 5).
std::string rule_of(const Production& production);

} // namespace lsys::reference
