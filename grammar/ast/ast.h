// SPDX-License-Identifier: MIT
// Ast: the syntax tree of a grammar, made by the parser and read by the resolver.
// Nodes lie in vectors and refer to each other by typed ids. Children precede their parents, so a
// pass over a vector visits leaves first and needs no recursion. Statements of included files stand
// in the place of the #include. After errors the tree is partial, but well-formed.
#pragma once

#include "grammar/base/chunked_vector.h"
#include "grammar/base/names.h"
#include "grammar/base/source.h"
#include "grammar/base/stage.h"

#include <compare>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

// --- expressions

enum class ExpressionId : std::uint32_t {};
inline constexpr ExpressionId kNoExpression{0xFFFFFFFFu};

enum class ExpressionKind : std::uint8_t {
    Number,   // value
    Name,     // name: a constant or a formal parameter
    Unary,    // operation, left
    Binary,   // operation, left, right
    Range,    // {left, right}
    Call,     // name, arguments: function call
    Grouping, // (left): parentheses as written
    Error,    // replaces a syntax error; later checks do not report it
};

enum class UnaryOperation : std::uint8_t { Negate, Not };
enum class BinaryOperation : std::uint8_t {
    Power,
    Multiply,
    Divide,
    Add,
    Subtract,
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
    Equal,
    NotEqual,
    And,
    Or,
};

/// The operator as written, such as `<=` or `&&`.
[[nodiscard]] const char* spelling(UnaryOperation operation);
[[nodiscard]] const char* spelling(BinaryOperation operation);

/// A range of indices into a vector of the Ast that holds lists one after the other, such as
/// `Ast::expression_lists`.
struct ListRange {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

struct Expression {
    ExpressionKind kind = ExpressionKind::Error;
    std::uint8_t operation = 0; // UnaryOperation or BinaryOperation
    FileId file = kNoFile;
    std::uint32_t begin = 0; // the bytes of the expression are [begin, end)
    std::uint32_t end = 0;
    union {
        float value;                      // Number
        NameId name;                      // Name, Call
        ExpressionId left;                // Unary, Binary, Range, Grouping
        std::uint32_t bits = 0xFFFFFFFFu; // initialises the union
    };
    union {
        ExpressionId right;                     // Binary, Range
        std::uint32_t arguments;                // Call: index into Ast::argument_lists
        std::uint32_t right_bits = 0xFFFFFFFFu; // largest member, to initialise the union
    };

    [[nodiscard]] SourceSpan span() const { return {file, begin, end}; }
    [[nodiscard]] UnaryOperation unary() const { return static_cast<UnaryOperation>(operation); }
    [[nodiscard]] BinaryOperation binary() const { return static_cast<BinaryOperation>(operation); }
};

// --- modules

/// A module of a list, in eight bytes because an axiom may have a hundred million modules.
class ModuleNode {
public:
    ModuleNode() = default;
    ModuleNode(NameId name, std::uint32_t begin_offset)
        : begin(begin_offset), name_and_call_(static_cast<std::uint32_t>(name)) {}

    [[nodiscard]] NameId name() const { return static_cast<NameId>(name_and_call_ & ~kCallBit); }
    /// Whether a `(` follows the name.
    [[nodiscard]] bool has_call() const { return (name_and_call_ & kCallBit) != 0; }
    void set_call() { name_and_call_ |= kCallBit; }
    /// The id of the name; for a module with a `(`, a number greater than all ids, so that one
    /// comparison finds modules without parentheses.
    [[nodiscard]] std::uint32_t bare_name() const { return name_and_call_; }

    std::uint32_t begin = 0; // first byte of the name, or of its back quote

private:
    static constexpr std::uint32_t kCallBit = 0x80000000u; // ids of names are smaller
    std::uint32_t name_and_call_ = 0;
};
static_assert(sizeof(ModuleNode) == 8);

/// The parentheses after a module: `(expr, ...)`.
struct CallNode {
    std::uint32_t module = 0;   // index in Ast::modules, ascending in Ast::calls
    std::uint32_t name_end = 0; // one past the name
    std::uint32_t open = 0;     // the `(`
    std::uint32_t end = 0;      // one past the `)`
    ListRange arguments;        // range of Ast::expression_lists; empty for `()`
};

/// Modules [first, first + count) of Ast::modules, all in one file.
struct ModuleList {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    SourceSpan span; // all modules; for an empty list, the place where modules may stand
};

/// A module of a list, unpacked.
struct ModuleView {
    NameId name = kNoName;
    SourceSpan name_span; // place of the name, with its back quotes if any
    SourceSpan span;      // place of the name with the arguments
    // True for a name in back quotes or spelt differently in its file: never split into several
    // modules.
    bool is_indivisible = false;
    bool has_parentheses = false;
    ListRange arguments;
};

// --- statements

enum class StatementKind : std::uint8_t {
    Generations, // #n = expr;
    Define,      // #define NAME expr;
    Param,       // #param NAME expr {min, max};
    Function,    // #function NAME(formals) expr;
    Curve,       // #curve NAME x y, x y, ...;
    Contour,     // #contour NAME x y, x y, ...;
    Material,    // #material INDEX key values ...;
    Sense,       // #sense NAME KIND key values ...;
    Module,      // #module NAME(formals);
    Object,      // #object NAME OBJECT;
    Include,     // #include "file"; its statements follow
    Set,         // #set KEY values;
    Ignore,      // #ignore : names; #consider : names;
    Axiom,       // #w : modules;
    Production,  // #NAME : ... ; #decompose, #interpret, #down or #up NAME : ... ;
};

struct Statement {
    StatementKind kind{};
    std::uint32_t index = 0; // index in the vector of its kind
    SourceSpan span;         // place from `#` to one past `;`
};

struct GenerationsNode {
    ExpressionId value = kNoExpression;
};

struct DefineNode {
    NameId name = kNoName;
    SourceSpan name_span;
    ExpressionId value = kNoExpression;
};

struct ParamNode {
    NameId name = kNoName;
    SourceSpan name_span;
    ExpressionId value = kNoExpression;
    ExpressionId minimum = kNoExpression;
    ExpressionId maximum = kNoExpression;
    SourceSpan bounds_span; // `{min, max}`
};

struct FunctionNode {
    NameId name = kNoName;
    SourceSpan name_span;
    ListRange formals; // range of Ast::expression_lists: names, or expressions in place of names
    SourceSpan formals_span;
    ExpressionId body = kNoExpression;
};

/// A #curve or #contour. Coordinates x y x y ... in Ast::expression_lists.
struct CurveNode {
    NameId name = kNoName;
    SourceSpan name_span;
    ListRange coordinates;
};

struct ModuleDeclarationNode {
    ModuleList modules; // modules as written; the resolver requires exactly one module
};

struct ObjectNode {
    SourceSpan keyword_span; // `#object` or `#include`
    ModuleList name;         // as written; the resolver requires one module without parentheses
    SourceSpan object_span;
    bool is_file = false; // `object` is a file name: "leaf.obj"
    std::string object;   // SPHERE, or a file name
    std::string contour;  // `ring` in `#object C CONTOUR ring;`; empty if there is none
    SourceSpan contour_span;
};

struct IncludeNode {
    SourceSpan path_span;  // place of the path with its quotes
    std::string path;      // path as written
    FileId file = kNoFile; // kNoFile until the file is read
};

/// A word, number or file name after the key of a #set, in a #material or in a #sense.
struct SetValue {
    SourceSpan span;      // includes the quotes of a file name
    bool is_word = false; // a mode, a profile or a constant; a key of a #material or #sense
    NameId word = kNoName;
    ExpressionId value = kNoExpression; // kNoExpression for a word or a file
    bool is_file = false;               // `word` is a file name; in #material and #sense
};

struct SetNode {
    NameId key = kNoName;
    SourceSpan key_span;
    ListRange values; // range of Ast::set_values
};

/// The index, the keys and the values of the keys, in one list as written. The resolver decides
/// which entries are keys.
struct MaterialNode {
    SourceSpan keyword_span; // `#material`
    ListRange values;        // range of Ast::set_values
};

/// The kind, the keys and the values of the keys, in one list as written. The resolver decides
/// which entries are keys.
struct SenseNode {
    NameId name = kNoName; // name without the `?`
    SourceSpan name_span;
    ListRange values; // range of Ast::set_values
};

struct IgnoreNode {
    ModuleList modules;
    bool considers = false; // `#consider`: all other modules are ignored
    SourceSpan keyword_span;
};

struct AxiomNode {
    // Set if the grammar has several axioms; else kNoExpression.
    ExpressionId probability = kNoExpression;
    ModuleList modules;
};

/// `*`, `expr`, `~ p`, `expr ~ p` or `* ~ p`; the condition of `*` is kNoExpression.
struct ConditionNode {
    ExpressionId condition = kNoExpression;
    ExpressionId probability = kNoExpression;
    SourceSpan span;
    SourceSpan tilde_span; // empty without `~`
};

/// `name = value` after `let`.
struct LocalNode {
    NameId name = kNoName;
    SourceSpan name_span;
    ExpressionId value = kNoExpression;
};

struct ProductionNode {
    Stage stage = Stage::Rewrite;
    NameId name = kNoName;
    SourceSpan name_span;   // place of the name, without the `#`
    bool has_left = false;  // `<` was written
    bool has_right = false; // `>` was written
    SourceSpan less_span;
    SourceSpan greater_span;
    ModuleList left;
    ModuleList predecessor;
    ModuleList right;
    ConditionNode condition;
    ListRange locals; // range of Ast::locals
    ModuleList successor;
};

/// A file of the compilation; the first is the root.
struct AstFile {
    FileId file = kNoFile;
    SourceSpan included_at; // the path in the #include; kNoFile for the root
};

/// Place of a module name that the file spells differently: with typographic characters, or in
/// another dialect.
struct WrittenName {
    FileId file = kNoFile;
    std::uint32_t begin = 0;
    std::uint32_t end = 0;

    friend auto operator<=>(const WrittenName&, const WrittenName&) = default;
};

/// Span of the name of the module at `begin` of a file, with its back quotes. Its end comes from
/// the entry of `written_names` (ascending) if there is one, else from the length of `name`.
[[nodiscard]] SourceSpan module_name_span(const SourceMap& sources,
                                          FileId file,
                                          std::uint32_t begin,
                                          std::string_view name,
                                          std::span<const WrittenName> written_names);

struct Ast {
    std::vector<AstFile> files;
    ChunkedVector<Statement> statements;

    std::vector<GenerationsNode> generations;
    ChunkedVector<DefineNode> defines;
    std::vector<ParamNode> params;
    std::vector<FunctionNode> functions;
    std::vector<CurveNode> curves;
    std::vector<CurveNode> contours;
    std::vector<MaterialNode> materials;
    std::vector<SenseNode> senses;
    std::vector<ModuleDeclarationNode> module_declarations;
    std::vector<ObjectNode> objects;
    std::vector<IncludeNode> includes;
    ChunkedVector<SetNode> sets;
    ChunkedVector<SetValue> set_values;
    std::vector<IgnoreNode> ignores;
    std::vector<AxiomNode> axioms;
    ChunkedVector<ProductionNode> productions;
    ChunkedVector<LocalNode> locals; // the locals of one production are consecutive

    ChunkedVector<Expression> expressions;
    ChunkedVector<ExpressionId> expression_lists; // lists of arguments, formals and coordinates
    ChunkedVector<ListRange> argument_lists;      // per function call: range of expression_lists
    ChunkedVector<ModuleNode> modules;
    ChunkedVector<CallNode> calls;

    /// Module names that their files spell differently, sorted by file, then by begin.
    std::vector<WrittenName> written_names;
    /// Each `//` before a word in a module list; the author may have meant a comment.
    std::vector<SourceSpan> slashes;

    /// Statements with syntax errors are missing; later checks do not report missing definitions.
    bool incomplete = false;

    [[nodiscard]] const Expression& expression(ExpressionId id) const {
        return expressions[static_cast<std::size_t>(id)];
    }
};

/// Iterates over a module list in order, in amortised constant time per module.
class ModuleCursor {
public:
    ModuleCursor(const Ast& ast, const Names& names, const SourceMap& sources, ModuleList list);
    [[nodiscard]] bool done() const { return index_ == end_; }
    /// The current module. Precondition: !done().
    [[nodiscard]] ModuleView view() const;
    void next();
    /// Index of the current module in Ast::modules.
    [[nodiscard]] std::uint32_t index() const { return index_; }
    /// Name of the current module.
    [[nodiscard]] NameId name() const;
    /// Advances to module `index`. Precondition: no module from the current one to `index` - 1 has
    /// a `(`.
    void skip_bare(std::uint32_t index) { index_ = index; }

private:
    const Ast* ast_;
    const Names* names_;
    const SourceMap* sources_;
    FileId file_;
    std::uint32_t index_;
    std::uint32_t end_;
    std::size_t call_; // index in Ast::calls of the first call of a module from index_ on
};

} // namespace lsys
