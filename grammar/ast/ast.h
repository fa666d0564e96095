// The syntax tree of a grammar as it was written: what the parser makes and the checks read.
// Nodes lie in vectors and refer to each other by typed ids; children come before their parents, so
// a pass over a vector is a pass from the leaves up and nothing recurses. Included files stand in
// place: `statements` is the order in which an author would read everything. After errors the tree
// is partial; what it holds is well-formed.
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

// ----------------------------------------------------------------------------------------
// expressions

enum class ExpressionId : std::uint32_t {};
inline constexpr ExpressionId kNoExpression{0xFFFFFFFFu};

enum class ExpressionKind : std::uint8_t {
    Number,   // value
    Name,     // name: a constant or a formal
    Unary,    // operation, left
    Binary,   // operation, left, right
    Range,    // {left, right}; range_number is set by the front end
    Call,     // name, arguments: function call
    Grouping, // (left): parentheses as written, for the formatter and for "a < b < c"
    Error,    // stands for what did not parse; stays quiet in every later check
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

/// As written: `<=`, `&&`, ...
[[nodiscard]] const char* spelling(UnaryOperation operation);
[[nodiscard]] const char* spelling(BinaryOperation operation);

/// A range of ids in one of the Ast's list vectors.
struct ListRange {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

struct Expression {
    ExpressionKind kind = ExpressionKind::Error;
    std::uint8_t operation = 0; // UnaryOperation or BinaryOperation
    FileId file = kNoFile;
    std::uint32_t begin = 0; // bytes of the whole expression
    std::uint32_t end = 0;
    union {
        float value;       // Number
        NameId name;       // Name, Call
        ExpressionId left; // Unary, Binary, Range, Grouping
        std::uint32_t bits = 0xFFFFFFFFu;
    };
    union {
        ExpressionId right;      // Binary, Range
        std::uint32_t arguments; // Call: index into Ast::argument_lists
        std::uint32_t more = 0xFFFFFFFFu;
    };

    [[nodiscard]] SourceSpan span() const { return {file, begin, end}; }
    [[nodiscard]] UnaryOperation unary() const { return static_cast<UnaryOperation>(operation); }
    [[nodiscard]] BinaryOperation binary() const { return static_cast<BinaryOperation>(operation); }
};

// --------------------------------------------------------------------------------------------
// modules

/// A module as it stands in a list. It takes eight bytes, since an axiom may have a hundred
/// million.
class ModuleNode {
public:
    ModuleNode() = default;
    ModuleNode(NameId name, std::uint32_t begin_offset)
        : begin(begin_offset), name_and_call_(static_cast<std::uint32_t>(name)) {}

    [[nodiscard]] NameId name() const { return static_cast<NameId>(name_and_call_ & ~kCallBit); }
    /// Whether a `(` follows.
    [[nodiscard]] bool has_call() const { return (name_and_call_ & kCallBit) != 0; }
    void set_call() { name_and_call_ |= kCallBit; }
    /// The name's number, or a number beyond those of all names for a module with a call: one
    /// comparison tells long words' bare modules from the others.
    [[nodiscard]] std::uint32_t bare_name() const { return name_and_call_; }

    std::uint32_t begin = 0; // first byte of the name, or of its back quote

private:
    static constexpr std::uint32_t kCallBit = 0x80000000u; // names are below
    std::uint32_t name_and_call_ = 0;
};
static_assert(sizeof(ModuleNode) == 8);

/// The parenthesis after a module: `(expr, ...)`.
struct CallNode {
    std::uint32_t module = 0;   // index in Ast::modules; calls are in that order
    std::uint32_t name_end = 0; // one past the name
    std::uint32_t open = 0;     // the `(`
    std::uint32_t end = 0;      // one past the `)`
    ListRange arguments;        // in Ast::expression_lists; `()` has none
};

/// Modules [first, first + count) of Ast::modules, all of one file.
struct ModuleList {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    SourceSpan
        span; // from the first module's name to the end of the last; empty where it would begin
};

/// A module of a list, unpacked.
struct ModuleView {
    NameId name = kNoName;
    SourceSpan name_span;  // with the back quotes, if any
    SourceSpan span;       // with the arguments
    bool is_whole = false; // no row of names: in back quotes, or spelt otherwise in its file
    bool has_parentheses = false;
    ListRange arguments;
};

// -----------------------------------------------------------------------------------------
// statements

enum class StatementKind : std::uint8_t {
    Generations, // #n = expr;
    Define,      // #define NAME expr;
    Param,       // #param NAME expr {min, max};
    Module,      // #module NAME(formals);
    Object,      // #object NAME OBJECT;
    Include,     // #include "file"; its statements follow
    Set,         // #set KEY values;
    Ignore,      // #ignore : names; #consider : names;
    Axiom,       // #w : modules;
    Production,  // #NAME : ... ; #decompose NAME : ... ; #interpret NAME : ... ;
};

/// `index` is the place in the vector of that kind.
struct Statement {
    StatementKind kind{};
    std::uint32_t index = 0;
    SourceSpan span; // from `#` to one past `;`
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

struct ModuleDeclarationNode {
    ModuleList modules; // one or more in a row as written; the checks want one
};

struct ObjectNode {
    SourceSpan keyword_span; // `#object` or `#include`
    ModuleList name;         // one module, without parentheses if written right
    SourceSpan object_span;
    bool is_file = false; // "leaf.obj"
    std::string object;   // SPHERE, or the file's name
};

struct IncludeNode {
    SourceSpan path_span;  // with the quotes
    std::string path;      // as written
    FileId file = kNoFile; // what it names, once read
};

/// One word or number after the key of a #set.
struct SetValue {
    SourceSpan span;
    bool is_word = false; // an identifier: a mode, a profile, or a constant
    NameId word = kNoName;
    ExpressionId value =
        kNoExpression; // numbers: a literal or a negated literal, or any expression
};

struct SetNode {
    NameId key = kNoName;
    SourceSpan key_span;
    ListRange values; // in Ast::set_values
};

struct IgnoreNode {
    ModuleList modules;
    bool considers = false; // `#consider`: all others are ignored
    SourceSpan keyword_span;
};

struct AxiomNode {
    ModuleList modules;
};

/// `*`, `expr`, `~ p`, `expr ~ p`, `* ~ p`; `*` is a condition of kNoExpression.
struct ConditionNode {
    ExpressionId condition = kNoExpression;
    ExpressionId probability = kNoExpression;
    SourceSpan span;
    SourceSpan tilde_span; // empty without `~`
};

struct ProductionNode {
    Stage stage = Stage::Rewrite;
    NameId name = kNoName;
    SourceSpan name_span;   // without the `#`
    bool has_left = false;  // `<` was written
    bool has_right = false; // `>` was written
    SourceSpan less_span;
    SourceSpan greater_span;
    ModuleList left;
    ModuleList predecessor;
    ModuleList right;
    ConditionNode condition;
    ModuleList successor;
};

/// A file of the compilation in the order it was met; the first is the root.
struct AstFile {
    FileId file = kNoFile;
    SourceSpan included_at; // the path in the #include; of kNoFile for the root
};

/// The bytes of a module's name that its file spells otherwise: with typographic characters, or as
/// another dialect does.
struct WrittenName {
    FileId file = kNoFile;
    std::uint32_t begin = 0;
    std::uint32_t end = 0;

    friend auto operator<=>(const WrittenName&, const WrittenName&) = default;
};

/// The bytes of the name of a module that begins at `begin` of a file, with its back quotes. Among
/// `written_names` (ascending), or as the file's text reads.
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
    std::vector<ModuleDeclarationNode> module_declarations;
    std::vector<ObjectNode> objects;
    std::vector<IncludeNode> includes;
    ChunkedVector<SetNode> sets;
    ChunkedVector<SetValue> set_values;
    std::vector<IgnoreNode> ignores;
    std::vector<AxiomNode> axioms;
    ChunkedVector<ProductionNode> productions;

    ChunkedVector<Expression> expressions;
    ChunkedVector<ExpressionId> expression_lists; // arguments of calls, consecutive
    ChunkedVector<ListRange> argument_lists;      // of function calls
    ChunkedVector<ModuleNode> modules;
    ChunkedVector<CallNode> calls;

    /// Ascending.
    std::vector<WrittenName> written_names;

    /// Statements that failed to parse were left out; later checks keep quiet about what may be
    /// missing.
    bool incomplete = false;

    [[nodiscard]] const Expression& expression(ExpressionId id) const {
        return expressions[static_cast<std::size_t>(id)];
    }
};

/// Walks a module list in order; amortised constant time a module.
class ModuleCursor {
public:
    ModuleCursor(const Ast& ast, const Names& names, const SourceMap& sources, ModuleList list);
    [[nodiscard]] bool done() const { return index_ == end_; }
    /// The module at the cursor; precondition: not done().
    [[nodiscard]] ModuleView view() const;
    void next();
    /// The module at the cursor, as an index of Ast::modules.
    [[nodiscard]] std::uint32_t index() const { return index_; }
    /// Its name.
    [[nodiscard]] NameId name() const;
    /// Moves on to `index`; no module on the way there has a `(`.
    void skip_bare(std::uint32_t index) { index_ = index; }

private:
    const Ast* ast_;
    const Names* names_;
    const SourceMap* sources_;
    FileId file_;
    std::uint32_t index_;
    std::uint32_t end_;
    std::size_t call_; // the first call whose module is not before index_
};

} // namespace lsys
