// SPDX-License-Identifier: MIT
// Bytecode: a compiled L-system, the interface between compiler and runtime. Made by compiler/lower
// or read from a .lsb file; the runtime uses no other data of the compiler. It is self-contained,
// immutable and passes verify().
//
// A word is a sequence of codes. Code c < symbols.size() is a module of symbol c whose parameters
// are stored beside the word as binary32. A higher code is a folded module, `&(22.5)`: a symbol
// whose arguments are constants and are stored in the bytecode, so the word stores none. The code
// count decides the width of a stored code: 1 byte up to 256, 2 up to 65,536, else 4. Modules are
// folded in order of first appearance while the width does not grow.
//
// Each table is filled in one order without gaps and without shared rows, so one pass over the
// program reads each table from its first row to its last:
//   constants       of folded[0], folded[1], ...
//   patterns        per production: left context, predecessor, right context
//   template_codes  the axioms, then the successor of each production
//   instructions    the globals, the arguments of the axioms, then per production: condition,
//                   weight, local values, arguments of the successor
//   template_places places of the modules of template_codes; empty if the places are unknown
#pragma once

#include "compiler/bytecode/curve.h"
#include "compiler/bytecode/environment.h"
#include "compiler/bytecode/settings.h"
#include "compiler/bytecode/turtle_operation.h"
#include "grammar/base/counted_enum.h"
#include "grammar/base/source.h"
#include "grammar/base/stage.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

enum class Opcode : std::uint8_t {
#define LSYS_OPCODE(identifier, mnemonic, operand, pops, pushes, value, meaning) identifier,
#include "compiler/bytecode/opcodes.def"
#undef LSYS_OPCODE
};
/// Kinds of operands, as opcodes.def describes them.
enum class OperandKind : std::uint8_t {
    None,
    Literal,
    Formal,
    Global,
    Draw,
    Branch,
    Local,
    Skip,
    Curve,
};

struct OpcodeInfo {
    std::string_view mnemonic;
    OperandKind operand;
    std::uint8_t pops;   // number of values taken from the stack
    std::uint8_t pushes; // number of values pushed onto the stack
    std::string_view meaning;
};
template <>
struct EnumCount<Opcode> {
    enum Enumerator : std::size_t {
#define LSYS_OPCODE(identifier, mnemonic, operand, pops, pushes, value, meaning) identifier,
#include "compiler/bytecode/opcodes.def"
#undef LSYS_OPCODE
        kCount
    };
};
inline constexpr std::uint32_t kOpcodeCount = kCountOf<Opcode>;
/// Precondition: opcode < kOpcodeCount.
[[nodiscard]] const OpcodeInfo& info(Opcode opcode);
inline constexpr std::uint32_t kMaxOperand = (1U << 24) - 1;
/// Max number of draws (random ranges and distributions) per successor with `rewriting sequential`,
/// since the pass of rule k numbers its draws from 4096 k on.
inline constexpr std::uint32_t kMaxSequentialDraws = 4095;
[[nodiscard]] constexpr std::uint32_t encode(Opcode opcode, std::uint32_t operand) {
    return static_cast<std::uint32_t>(opcode) | (operand << 8);
}

/// Number of parameters of a SaveBranch module before the formals and local values that its branch
/// uses: whether to take a recorded instance, the age of the word with this module, and the id of
/// the branch.
inline constexpr std::uint32_t kBranchArguments = 3;

enum class SymbolId : std::uint32_t {};
inline constexpr SymbolId kNoSymbol{0xFFFFFFFFu};
enum class ProductionId : std::uint32_t {};
inline constexpr ProductionId kNoProduction{0xFFFFFFFFu};
/// A code of a word; see the comment at the top of this file.
using Code = std::uint32_t;
/// Stands for a missing index of an instruction, a site or a row of a table.
inline constexpr std::uint32_t kNone = 0xFFFFFFFFu;

/// Brackets and polygons are recognised by the kind of a symbol, not by its name.
LSYS_COUNTED_ENUM(SymbolKind, Plain, BranchOpen, BranchClose, PolygonOpen, PolygonClose);

struct BytecodeSymbol {
    std::string name;
    std::uint32_t parameter_count = 0;
    SymbolKind kind = SymbolKind::Plain;
    bool ignored = false; // contexts skip the symbol (#ignore, #consider)
    TurtleOperation turtle = TurtleOperation::Nothing; // effect of a module on the turtle
    std::string mesh_file;        // for MeshFile; for SetContour: the name of a contour, or empty
    Sense sense = Sense::Nothing; // quantity that a sense module reads

    /// Whether the symbol is a sense module, `?NAME`.
    [[nodiscard]] bool senses() const { return sense != Sense::Nothing; }
};

/// A module whose arguments are constants. Its code is symbols.size() plus its index in
/// Bytecode::folded.
struct FoldedModule {
    SymbolId symbol = kNoSymbol;
    std::uint32_t first_constant = 0; // index in constants; one constant per parameter
};

/// A place in a source file for messages. Has line and column, so messages need no source text.
struct Site {
    SourceSpan span;          // its FileId is an index in Bytecode::files
    std::uint32_t line = 0;   // from 1
    std::uint32_t column = 0; // from 1
};

/// The instructions from `instruction` up to the next range belong to one site.
struct SiteRange {
    std::uint32_t instruction = 0;
    std::uint32_t site = 0; // index in sites
};

/// Places of consecutive modules of template_codes at equal distances in one line of ASCII text, so
/// that a long axiom takes few rows. The file is that of the axiom's site or of the production's
/// name_site. The first module of each word begins a run.
struct PlaceRun {
    std::uint32_t first = 0;  // index in template_codes; the run ends where the next begins
    std::uint32_t begin = 0;  // byte offset of the first module in its file
    std::uint32_t length = 0; // bytes of each module, arguments included
    std::uint32_t stride = 0; // bytes from one module to the next; 0 for a single module
    std::uint32_t line = 0;
    std::uint32_t column = 0; // column of the first module
};

LSYS_COUNTED_ENUM(PatternKind, Module, Open, Close);

/// One element of a context or predecessor. Parameter i of a module is formal first_formal + i.
struct PatternItem {
    PatternKind kind = PatternKind::Module;
    SymbolId symbol = kNoSymbol;
    std::uint32_t first_formal = 0;
};

struct TableRange {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

/// The codes of a word in template_codes, and the instructions that emit its `parameter_count`
/// stored parameters in order.
struct WordTemplate {
    TableRange codes;
    /// First instruction of the code that moves local values to their slots before the arguments
    /// are computed, or kNone.
    std::uint32_t locals = kNone;
    std::uint32_t arguments = kNone; // first instruction, or kNone if nothing is stored
    std::uint32_t parameter_count = 0;
    std::uint32_t draw_count = 0; // random ranges and distributions
};

struct BytecodeProduction {
    std::string name;
    std::uint32_t name_site = kNone; // index in sites
    std::uint32_t rule = 0;          // number of its rule, by first appearance
    std::uint32_t group = 0;         // number of its group, by first appearance
    Stage stage = Stage::Rewrite;
    bool has_left = false;  // has a left context
    bool has_right = false; // has a right context
    TableRange left;        // range of patterns; only modules, in text order
    TableRange predecessor; // range of patterns; only modules, at least one
    TableRange right;       // range of patterns; Open and Close are balanced
    std::uint32_t formal_count = 0;
    std::uint32_t condition = kNone; // first instruction, or kNone for `*`
    bool stochastic = false;         // has a `~`: chosen at random within its group
    float weight = 0.0F; // the number after `~`; 0 if there is none or it is not constant
    /// First instruction of a weight that is not constant, else kNone. The code ends with Test, as
    /// the code of a condition does.
    std::uint32_t weight_code = kNone;
    WordTemplate successor;
};

/// An axiom. If there are several, a derivation begins with a randomly chosen one.
struct BytecodeAxiom {
    WordTemplate word;
    std::uint32_t site = kNone;      // index in sites
    std::uint32_t draw_position = 0; // index of its first draw, as BytecodeGlobal::draw_position
    float weight = 1.0F;             // the number after `~`
};

/// A constant that is drawn when the derivation starts.
struct BytecodeGlobal {
    std::string name;
    std::uint32_t instruction = 0; // first instruction of its code, which ends with Emit, End
    /// Index of its first draw among the draws of all #define, #param and #w.
    std::uint32_t draw_position = 0;
    std::uint32_t draw_count = 0; // random ranges and distributions
    bool has_bounds = false;      // true for a #param
    float minimum = 0.0F;         // bounds of a #param
    float maximum = 0.0F;
    std::uint32_t site = kNone; // index in sites
};

/// A `#curve`. set_slopes() has set the slopes of the points.
struct BytecodeCurve {
    std::string name;
    std::vector<CurveKnot> points;
};

/// A point of a cross-section: x along the turtle's right axis, y along its up axis, relative to
/// the width.
struct ContourPoint {
    float x = 0.0F;
    float y = 0.0F;

    friend bool operator==(const ContourPoint&, const ContourPoint&) = default;
};
inline constexpr std::size_t kMinContourPoints = 2;
inline constexpr std::size_t kMaxContourPoints = 64;

/// A `#contour`: the cross-section of an organ. It is closed if its last point equals the first.
struct BytecodeContour {
    std::string name;
    std::vector<ContourPoint> points;
};

/// The file of a picture, relative to the grammar; empty if there is none.
struct BytecodePicture {
    std::string path;
    std::uint32_t site = kNone; // index in sites
};

/// `#material`: the appearance of a colour index.
struct BytecodeMaterial {
    std::uint32_t index = 0; // colour index, up to kMaxColourIndex
    bool has_colour = false;
    std::array<float, 3> colour{}; // sRGB, 0 to 1
    BytecodePicture picture;       // picture of the colour
    BytecodePicture normal;        // normal map
    bool has_roughness = false;
    float roughness = 0.0F; // 0 to 1
    bool has_translucency = false;
    float translucency = 0.0F; // 0 to 1
    bool has_sides = false;    // the material says whether it has one side or two
    bool two_sided = false;
};
inline constexpr std::uint32_t kMaxColourIndex = 65535;

struct Bytecode {
    Settings settings;
    std::optional<std::uint32_t> generations; // value of #n; unset if the grammar has no #n

    std::vector<std::string> files; // paths; FileId of a Site indexes them
    std::vector<BytecodeSymbol> symbols;
    std::vector<FoldedModule> folded;    // modules with constant arguments
    std::vector<float> constants;        // arguments of `folded`, one after the other
    std::vector<BytecodeGlobal> globals; // in source order; a global uses only earlier ones
    std::vector<PatternItem> patterns;   // contexts and predecessors
    std::vector<Code> template_codes;    // codes of axioms and successors
    std::vector<std::uint32_t> instructions;
    std::vector<Site> sites;
    std::vector<SiteRange> site_ranges;          // sorted by instruction
    std::vector<PlaceRun> template_places;       // sorted by `first`
    std::vector<BytecodeProduction> productions; // sorted by stage, then in file order
    std::uint32_t rule_count = 0;                // rules: productions with equal predecessors
    std::uint32_t context_group_count = 0; // groups: productions of a rule with equal contexts
    std::vector<BytecodeAxiom> axioms;     // in file order, at least one
    bool uses_steps = false;               // some expression calls steps()
    std::vector<BytecodeCurve> curves;
    std::vector<BytecodeContour> contours;         // in source order
    std::vector<BytecodeMaterial> materials;       // sorted by index
    std::vector<BytecodeEnvironment> environments; // in source order, all kinds
    std::uint32_t stack_depth = 0;                 // max stack depth of any code
    std::uint32_t local_count = 0;                 // max number of slots that any code needs

    /// The range of productions of a stage.
    [[nodiscard]] TableRange productions_of(Stage stage) const;
    [[nodiscard]] bool has(Stage stage) const { return productions_of(stage).count != 0; }
    /// Number of rules of Stage::Rewrite. Rules of later stages have higher numbers.
    [[nodiscard]] std::uint32_t rewriting_rule_count() const;
    /// Whether some symbol can cut off the modules after it in its branch.
    [[nodiscard]] bool has_cuts() const;
    /// Whether some symbol is a sense module. If so, a derivation passes each word to
    /// DeriveOptions::senses, which writes the answers into the parameters of sense modules.
    [[nodiscard]] bool has_senses() const;
    /// Whether there are productions of `#down` or `#up`.
    [[nodiscard]] bool has_sweeps() const { return has(Stage::Down) || has(Stage::Up); }

    [[nodiscard]] Code code_count() const {
        return static_cast<Code>(symbols.size() + folded.size());
    }
    /// Precondition: code < code_count().
    [[nodiscard]] SymbolId symbol_of(Code code) const {
        return code < symbols.size() ? static_cast<SymbolId>(code)
                                     : folded[code - symbols.size()].symbol;
    }
    [[nodiscard]] const BytecodeSymbol& symbol(SymbolId id) const {
        return symbols[static_cast<std::size_t>(id)];
    }
    /// Number of parameters that a word stores for each module of this code.
    [[nodiscard]] std::uint32_t stored_parameters(Code code) const {
        return code < symbols.size() ? symbols[code].parameter_count : 0;
    }
};

/// Bytes of a stored code for `code_count` codes: 1, 2 or 4.
[[nodiscard]] constexpr std::uint32_t code_width(std::uint64_t code_count) {
    return code_count <= 256 ? 1 : code_count <= 65'536 ? 2 : 4;
}

/// The site that an instruction comes from, or kNone.
[[nodiscard]] std::uint32_t site_of(const Bytecode& bytecode, std::uint32_t instruction);

/// The axiom that holds template_codes[index], or nullptr.
[[nodiscard]] const BytecodeAxiom* axiom_with(const Bytecode& bytecode, std::uint32_t index);
/// The production whose successor holds template_codes[index]; kNoProduction for an axiom.
/// Precondition: index < template_codes.size().
[[nodiscard]] ProductionId production_with(const Bytecode& bytecode, std::uint32_t index);
/// The place of the module of template_codes[index] with its arguments, if known.
/// Precondition: index < template_codes.size().
[[nodiscard]] std::optional<Site> place_of(const Bytecode& bytecode, std::uint32_t index);

/// A 64-bit checksum for .lsb and state files; a change within one aligned group of eight bytes
/// always changes it.
[[nodiscard]] std::uint64_t checksum(std::string_view bytes);

/// A 64-bit digest of all fields that decide the derived word. Programs that differ only in the
/// layout of their text have equal digests.
[[nodiscard]] std::uint64_t digest(const Bytecode& bytecode);

} // namespace lsys
