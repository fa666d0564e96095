// Program: the checked system. Names are resolved to symbols, constants are values, conditions and
// probabilities are apart, name splitting is done. Made by check/ from an Ast without errors,
// changed by passes/, lowered to Bytecode by lower/. Holds no text but names and no pointer into
// the Ast.
#pragma once

#include "compiler/bytecode.h"
#include "compiler/settings.h"
#include "grammar/ast.h"
#include "grammar/chunked_vector.h"
#include "grammar/names.h"
#include "grammar/source.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lsys {

enum class ValueId : std::uint32_t {};
inline constexpr ValueId kNoValue{0xFFFFFFFFu};

/// A node of an expression: an instruction and the values it takes. Constants are folded and
/// shared: equal literals are one node. Children come before parents.
struct Value {
    Opcode opcode = Opcode::Literal;
    SourceSpan span;
    union {
        float literal;           // Literal
        std::uint32_t index = 0; // Formal, Global, Range (draw number)
    };
    ValueId left = kNoValue;
    ValueId right = kNoValue;
};

struct Symbol {
    NameId name = kNoName;
    std::uint32_t parameter_count = 0;
    SymbolKind kind = SymbolKind::Plain;
    bool ignored = false;
    TurtleOperation turtle = TurtleOperation::Nothing;
    std::string mesh_file;
};

/// A module of an axiom or successor; its arguments are the next parameter_count values of the
/// list.
struct ProgramModule {
    SymbolId symbol = kNoSymbol;
    std::uint32_t begin = 0; // byte offset in the list's file
};

struct ProgramWord {
    FileId file = kNoFile;
    std::uint32_t first_module = 0; // in Program::modules
    std::uint32_t module_count = 0;
    std::uint32_t first_argument = 0; // in Program::arguments
    std::uint32_t draw_count = 0;
    SourceSpan span;
};

/// A context or predecessor.
struct ProgramPattern {
    std::vector<PatternItem> items;
    SourceSpan span;
};

struct Production {
    NameId name = kNoName;
    SourceSpan name_span;
    SourceSpan span;
    std::uint32_t rule = 0;
    std::uint32_t group = 0;
    bool has_left = false;
    bool has_right = false;
    ProgramPattern left;
    ProgramPattern predecessor;
    ProgramPattern right;
    std::vector<NameId> formals; // left, predecessor, right
    ValueId condition = kNoValue;
    SourceSpan condition_span;
    bool stochastic = false;
    float weight = 0.0F;
    SourceSpan weight_span;
    ProgramWord successor;
};

/// A constant drawn when the derivation starts; others are folded into the values that use them.
struct Global {
    NameId name = kNoName;
    SourceSpan span;
    ValueId value = kNoValue;
    std::uint32_t draw_position = 0;
    std::uint32_t draw_count = 0;
    bool has_bounds = false;
    float minimum = 0.0F;
    float maximum = 0.0F;
};

/// A constant as the author sees it, for dumps and for sliders.
struct Constant {
    NameId name = kNoName;
    SourceSpan span;
    bool is_param = false;
    bool is_drawn = false; // then `global` names it, else `value` is it
    float value = 0.0F;
    std::uint32_t global = kNone;
    float minimum = 0.0F;
    float maximum = 0.0F;
};

struct Program {
    Settings settings;
    std::optional<std::uint32_t> generations;
    SourceSpan generations_span;
    std::vector<std::string> files; // paths by FileId

    std::vector<Symbol> symbols;
    std::vector<Constant> constants;
    std::vector<Global> globals;
    std::vector<Production> productions;
    std::uint32_t rule_count = 0;
    std::uint32_t group_count = 0;
    ProgramWord axiom;
    std::uint32_t axiom_draw_position = 0;

    ChunkedVector<ProgramModule> modules;
    ChunkedVector<ValueId> arguments;
    ChunkedVector<Value> values;

    [[nodiscard]] const Value& value(ValueId id) const {
        return values[static_cast<std::size_t>(id)];
    }
    [[nodiscard]] const Symbol& symbol(SymbolId id) const {
        return symbols[static_cast<std::size_t>(id)];
    }
};

} // namespace lsys
