// SPDX-License-Identifier: MIT
// Program: the resolved system. Names are symbols, constants are values, conditions and
// probabilities are separate, joined names are split. Made by resolve/ from an Ast, changed by
// instancing/, lowered to Bytecode by lower/. Holds no text but names and no pointer into the Ast.
//
// The Program of a grammar with errors (`is_valid` is false) only serves further checks. It is
// still well-formed: productions whose head or names could not be resolved are left out, and an
// expression in error is kPoison.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "compiler/bytecode/settings.h"
#include "grammar/ast/ast.h"
#include "grammar/base/cancellation.h"
#include "grammar/base/chunked_vector.h"
#include "grammar/base/grouped_lists.h"
#include "grammar/base/names.h"
#include "grammar/base/source.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lsys {

enum class ValueId : std::uint32_t {};
inline constexpr ValueId kNoValue{0xFFFFFFFFu};
/// Program::values[0]: the literal NaN, which replaces an expression in error. Checks do not report
/// expressions with this value. No literal of a valid program has this id.
inline constexpr ValueId kPoison{0};

/// A node of an expression: an instruction and its operands. Constants are folded: a node whose
/// operands are literals is a literal. Equal literals share a node, whose `span` is the place of
/// one of them; other nodes have one place. Operands come before their users in Program::values. A
/// choice is a node with Opcode::If. SetLocal moves `left` to a slot and has the value of `right`.
struct Value {
    Opcode opcode = Opcode::Literal;
    SourceSpan span;
    union {
        float literal;           // Literal
        std::uint32_t index = 0; // Formal, Global, Local, SetLocal, Curve, a draw, BranchDraw
        ValueId third;           // If: chooses `left` if not 0, else `right`; Mix: the fraction t
    };
    ValueId left = kNoValue;
    ValueId right = kNoValue;

    [[nodiscard]] bool has_third() const { return opcode == Opcode::If || opcode == Opcode::Mix; }
    /// `third`, `left` and `right`; kNoValue replaces missing operands.
    [[nodiscard]] std::array<ValueId, 3> operands() const {
        return {has_third() ? third : kNoValue, left, right};
    }
};

struct Symbol {
    NameId name = kNoName;
    std::uint32_t parameter_count = 0;
    SymbolKind kind = SymbolKind::Plain;
    bool ignored = false;                              // contexts skip the symbol
    TurtleOperation turtle = TurtleOperation::Nothing; // effect of a module on the turtle
    std::string mesh_file;        // for MeshFile; for SetContour: the name of a contour, or empty
    Sense sense = Sense::Nothing; // quantity that a sense module reads
};

/// A module of an axiom or successor. Its arguments are the next Symbol::parameter_count entries of
/// Program::arguments after those of the module before it.
struct ProgramModule {
    SymbolId symbol = kNoSymbol;
    std::uint32_t begin = 0; // byte offset in ProgramWord::file
};

struct ProgramWord {
    FileId file = kNoFile;
    std::uint32_t first_module = 0; // index in Program::modules
    std::uint32_t module_count = 0;
    std::uint32_t first_argument = 0; // index in Program::arguments
    std::uint32_t draw_count = 0;     // random ranges and distributions
    SourceSpan span;
};

/// A PatternItem (bytecode.h) with its byte range in the file of the production, arguments
/// included.
struct ProgramPatternItem {
    PatternKind kind = PatternKind::Module;
    SymbolId symbol = kNoSymbol;
    std::uint32_t first_formal = 0;
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
};

/// A context or predecessor.
struct ProgramPattern {
    std::vector<ProgramPatternItem> items;
    SourceSpan span;
};

/// `let name = value`. A literal or another leaf is substituted for each use of the name. Any other
/// value is stored in a slot, numbered by its index among the local values; Opcode::Local reads it.
struct LocalValue {
    NameId name = kNoName;
    SourceSpan name_span;
    SourceSpan span; // `name = value`
    ValueId value = kNoValue;
    bool is_used = false; // an expression reads it
};

struct Production {
    NameId name = kNoName;
    SourceSpan name_span;
    SourceSpan span;
    std::uint32_t rule = 0;  // index of the rule, below Program::rule_count
    std::uint32_t group = 0; // index of the group, below Program::context_group_count
    bool has_left = false;
    bool has_right = false;
    ProgramPattern left;
    ProgramPattern predecessor;
    ProgramPattern right;
    std::vector<NameId> formals; // of the left context, the predecessor and the right context
    std::vector<SourceSpan> formal_spans;
    ValueId condition = kNoValue;
    SourceSpan condition_span;
    Stage stage = Stage::Rewrite;
    bool stochastic = false;         // has a `~`
    float weight = 0.0F;             // NaN if the probability is in error or an expression
    ValueId weight_value = kNoValue; // the weight, if it is not constant
    SourceSpan weight_span;
    std::vector<LocalValue> locals;
    ProgramWord successor;
};

/// An axiom. If there are several, a derivation begins with a randomly chosen one.
struct Axiom {
    ProgramWord word;
    std::uint32_t draw_position = 0; // index of its first draw, as Global::draw_position
    bool has_weight = false;
    float weight = 1.0F; // NaN if the probability is in error
    SourceSpan weight_span;
};

/// A constant drawn when the derivation starts. Other constants are folded into the values that use
/// them.
struct Global {
    NameId name = kNoName;
    SourceSpan span;
    ValueId value = kNoValue;
    std::uint32_t draw_position = 0; // index of its first draw among all of #define, #param, #w
    std::uint32_t draw_count = 0;    // random ranges and distributions
    bool has_bounds = false;         // true for a #param
    float minimum = 0.0F;
    float maximum = 0.0F;
};

/// `#curve`. Its name is a function of one parameter.
struct Curve {
    NameId name = kNoName;
    SourceSpan span;
    std::vector<CurveKnot> points; // points, with the slopes that set_slopes() computes
};

/// `#contour`: the cross-section of an organ.
struct ProgramContour {
    NameId name = kNoName;
    SourceSpan span;
    std::vector<ContourPoint> points;
};

/// The file of a picture, relative to the root file; empty if there is none.
struct MaterialPictureName {
    std::string path;
    SourceSpan span; // place of the file name with its quotes
};

/// `#material`: the appearance of a colour index. Keys that are not set keep the built-in look.
struct ProgramMaterial {
    std::uint32_t index = 0;                    // a colour index, up to 65,535
    SourceSpan span;                            // place of the index
    std::optional<std::array<float, 3>> colour; // sRGB, 0 to 1
    MaterialPictureName picture;                // picture of the colour
    MaterialPictureName normal;                 // normal map
    std::optional<float> roughness;
    std::optional<float> translucency;
    std::optional<bool> two_sided;
};

/// `#sense`: an environment that modules `?NAME` ask.
struct ProgramEnvironment {
    NameId name = kNoName; // name without the `?`
    SourceSpan name_span;
    BytecodeEnvironment values; // values of the keys; name and sites are not set
    /// Places of values.surfaces: file names with quotes, or keys.
    std::vector<SourceSpan> surface_spans;
};

/// A constant of the grammar, for dumps and for sliders.
struct Constant {
    NameId name = kNoName;
    SourceSpan span;
    bool is_param = false; // by #param, not #define
    /// True: the value is globals[global], drawn when a derivation starts. False: it is `value`.
    bool is_random = false;
    bool is_used = false; // an expression reads it
    float value = 0.0F;
    std::uint32_t global = kNone; // index in Program::globals
    float minimum = 0.0F;         // bounds of a #param
    float maximum = 0.0F;
};

/// `#module NAME(formals);`
struct ModuleDeclaration {
    SymbolId symbol = kNoSymbol;
    SourceSpan span; // place of NAME(formals)
};

/// `#object NAME OBJECT;`: modules of this name draw the object, whatever their parameter count.
struct ObjectBinding {
    NameId name = kNoName;
    SourceSpan name_span;
    SourceSpan object_span;
    TurtleOperation object = TurtleOperation::Nothing;
    std::string mesh_file;
};

/// A name of an `#ignore` or of a `#consider`.
struct IgnoredName {
    NameId name = kNoName;
    SourceSpan span;
};

struct Program {
    /// True if no error was found and the text is a whole grammar, not a part of one. Checks of the
    /// whole program run only then.
    bool is_valid = false;
    /// True if no statement was dropped after an error. A statement that the Program lacks is then
    /// missing in the grammar, too.
    bool has_all_statements = false;
    Settings settings;
    std::optional<std::uint32_t> generations; // value of #n; unset if the grammar has no #n
    SourceSpan generations_span;              // place of the number in #n
    SourceSpan height_span;         // place of the key in `#set height`; kNoFile if missing
    SourceSpan pipe_span;           // place of the key in `#set pipe`; kNoFile if missing
    std::vector<std::string> files; // paths by FileId
    /// Places of the names that a file spells differently, ascending.
    std::vector<WrittenName> written_names;

    std::vector<Symbol> symbols;
    std::vector<ModuleDeclaration> declarations;
    std::vector<ObjectBinding> objects;
    std::vector<IgnoredName> ignored;
    std::vector<IgnoredName> considered; // if not empty, all other names are ignored
    std::vector<Constant> constants;
    std::vector<Global> globals;
    std::vector<Curve> curves;
    std::vector<ProgramContour> contours;         // in source order
    std::vector<ProgramMaterial> materials;       // in source order, one per colour index
    std::vector<ProgramEnvironment> environments; // in source order; Symbol::sense is an index
    std::vector<Production> productions;          // sorted by stage
    std::uint32_t rule_count = 0;                 // rules: productions with equal predecessors
    std::uint32_t context_group_count = 0; // groups: productions of a rule with equal contexts
    std::vector<Axiom> axioms;             // axioms; at least one if `is_valid`

    ChunkedVector<ProgramModule> modules;
    ChunkedVector<ValueId> arguments;
    ChunkedVector<Value> values;

    /// The place of the first axiom; none if there is no axiom.
    [[nodiscard]] SourceSpan axiom_span() const {
        return axioms.empty() ? SourceSpan{} : axioms.front().word.span;
    }
    [[nodiscard]] const Value& value(ValueId id) const {
        return values[static_cast<std::size_t>(id)];
    }
    [[nodiscard]] const Symbol& symbol(SymbolId id) const {
        return symbols[static_cast<std::size_t>(id)];
    }
};

/// Calls visit(index in Program::modules, symbol) for each module of a word, in order. Words may
/// have a hundred million modules, so `visit` should be cheap: at most a look-up in one flat table.
template <typename Visit>
void for_each_symbol(const Program& program, const ProgramWord& word, Visit&& visit) {
    std::size_t index = word.first_module;
    for (const std::size_t end = index + word.module_count; index < end;) {
        stop_if_cancelled();
        for (const ProgramModule module : program.modules.row(index, end - index)) {
            visit(index++, module.symbol);
        }
    }
}

/// Calls visit(index in Program::modules, index of its first argument in Program::arguments,
/// module) for each module of a word.
template <typename Visit>
void for_each_module(const Program& program, const ProgramWord& word, Visit&& visit) {
    std::size_t argument = word.first_argument;
    std::size_t index = word.first_module;
    for (const std::size_t end = index + word.module_count; index < end;) {
        stop_if_cancelled();
        for (const ProgramModule module : program.modules.row(index, end - index)) {
            visit(index++, argument, module);
            argument += program.symbol(module.symbol).parameter_count;
        }
    }
}

/// Calls visit(id, value) for each node of the expressions with these roots. Iterative, since an
/// expression may be nested as deep as its file is long.
template <typename Visit>
void for_each_value(const Program& program, std::vector<ValueId> roots, Visit&& visit) {
    while (!roots.empty()) {
        const ValueId id = roots.back();
        roots.pop_back();
        if (id != kNoValue) {
            stop_if_cancelled();
            const Value& value = program.value(id);
            visit(id, value);
            const std::array<ValueId, 3> operands = value.operands();
            roots.insert(roots.end(), operands.begin(), operands.end());
        }
    }
}
/// All expressions of a production: the condition and the weight (kNoValue for a missing one), the
/// local values and the arguments of the successor.
[[nodiscard]] std::vector<ValueId> expressions_of(const Program& program,
                                                  const Production& production);

/// Per symbol: the productions whose predecessor contains it, once per occurrence.
[[nodiscard]] GroupedLists rewriters_of(const Program& program);
/// Per symbol: the productions whose successor contains it, each once.
[[nodiscard]] GroupedLists writers_of(const Program& program);

} // namespace lsys
