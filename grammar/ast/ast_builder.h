// SPDX-License-Identifier: MIT
// AstBuilder: builds the Ast of one file, one node per call of the parser. It reports the mistakes
// that can be found only in complete nodes: brackets nested too deep, chained comparisons, ranges
// without two values. finish_statement() keeps the nodes of a statement or rolls them back, so the
// Ast holds whole statements.
#pragma once

#include "grammar/ast/ast.h"
#include "grammar/ast/parse_context.h"
#include "grammar/ast/text_map.h"
#include "grammar/base/diagnostic.h"
#include "grammar/base/names.h"

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace lsys {

/// Maximum nesting of parentheses and brackets.
inline constexpr std::uint32_t kMaxNesting = 10'000;

/// Bytes [begin, end) of the scanned text.
struct TextRange {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
};

/// The form of module names, as set by `#set names`.
enum class ModuleNames : std::uint8_t {
    Words,
    Letters,    // each letter is a module
    Characters, // each letter, and each character of a text in back quotes, is a module
};

class AstBuilder {
public:
    AstBuilder(const ScannedText& scanned, Ast& ast, const ParseContext& context);

    void set_names(ModuleNames names) { module_names_ = names; }
    [[nodiscard]] ModuleNames module_names() const { return module_names_; }

    NameId intern(std::string_view name) { return names_.intern(name); }

    // --- expressions
    ExpressionId number(float value, SourceSpan span);
    ExpressionId name(NameId name, SourceSpan span);
    ExpressionId unary(UnaryOperation operation, ExpressionId operand, SourceSpan span);
    ExpressionId
    binary(BinaryOperation operation, ExpressionId left, ExpressionId right, SourceSpan span);
    ExpressionId grouping(ExpressionId inner, SourceSpan span);
    /// `{...}` of the last `count` arguments.
    ExpressionId range(std::uint32_t count, SourceSpan span);
    /// A function call with the last `count` arguments.
    ExpressionId call(NameId function, std::uint32_t count, SourceSpan span);
    /// `-value`; `number` is the place of the number without its sign.
    ExpressionId negated(float value, SourceSpan number, SourceSpan span);
    ExpressionId error(SourceSpan span);

    /// Adds an argument for the next range(), call() or module_arguments(); returns the new count.
    std::uint32_t argument(std::uint32_t count_before, ExpressionId value);
    /// Removes the last `count` arguments.
    void drop_arguments(std::uint32_t count);

    // --- module lists
    [[nodiscard]] ModuleList empty_modules(SourceSpan where);
    /// Appends the modules of `run`: names, blanks and arguments that are plain numbers.
    [[nodiscard]] ModuleList modules(ModuleList list, TextRange run);
    /// Appends one module with any name, for example one in back quotes.
    [[nodiscard]] ModuleList quoted_module(ModuleList list, NameId name, SourceSpan span);
    /// Appends each character of a text in back quotes as a module, and a back quote as a module
    /// between two adjacent texts.
    [[nodiscard]] ModuleList quoted_text(ModuleList list, TextRange quoted);
    /// Gives the last `count` arguments to the last module of `list`; `parentheses` is the span
    /// from `(` to `)`. Reports a second pair of parentheses, and a pair after an empty text.
    [[nodiscard]] ModuleList
    module_arguments(ModuleList list, std::uint32_t count, SourceSpan parentheses);

    /// Removes each `//` at or after `begin` of the scanned text from Ast::slashes, because another
    /// message already explains these `//`.
    void remove_slashes(std::uint32_t begin);

    // --- statements
    void generations(ExpressionId value);
    void define(NameId name, SourceSpan name_span, ExpressionId value);
    /// The bounds are the last `bound_count` arguments; reports a count other than two.
    void param(NameId name,
               SourceSpan name_span,
               ExpressionId value,
               std::uint32_t bound_count,
               SourceSpan bounds);
    /// The formals are the last `count` arguments.
    void function(NameId name,
                  SourceSpan name_span,
                  std::uint32_t count,
                  SourceSpan formals,
                  ExpressionId body);
    /// The coordinates are the last `count` arguments.
    void curve(NameId name, SourceSpan name_span, std::uint32_t count);
    void contour(NameId name, SourceSpan name_span, std::uint32_t count);
    void module_declaration(ModuleList modules);
    /// `object` is the name of an object of the library or, with `is_file`, of a file.
    void object(SourceSpan keyword, ModuleList name, NameId object, SourceSpan span, bool is_file);
    /// Adds the name of a contour to the #object added last.
    void contour_of_object(NameId contour, SourceSpan span);
    void include(NameId path, SourceSpan span);
    // set_word(), set_number() and set_file() add a value to the next set(), material() or sense().
    void set_word(NameId word, SourceSpan span);
    void set_number(ExpressionId value, SourceSpan span);
    void set_file(NameId path, SourceSpan span);
    void set(NameId key, SourceSpan key_span);
    /// Adds a #material with the values set since the last statement.
    void material(SourceSpan keyword);
    /// Adds a #sense with the values set since the last statement.
    void sense(NameId name, SourceSpan name_span);
    /// Adds an #ignore, or with `considers` a #consider.
    void ignore(SourceSpan keyword, ModuleList modules, bool considers);
    void axiom(ModuleList modules, ExpressionId probability);
    void left_context(ModuleList left, SourceSpan less);
    void predecessor(ModuleList modules);
    void right_context(SourceSpan greater, ModuleList right);
    void condition(ExpressionId condition);
    void probability(SourceSpan tilde, ExpressionId probability);
    /// Sets name and stage of the current production. `label`: place of the name, perhaps with
    /// the `#`; `condition`: place of the condition.
    void production_front(NameId name,
                          SourceSpan label,
                          SourceSpan condition,
                          Stage stage = Stage::Rewrite);
    /// Adds the next local value of the current production.
    void local(NameId name, SourceSpan name_span, ExpressionId value);
    void production(ModuleList successor);

    /// Marks the Ast as incomplete: a part of the text was not read.
    void mark_incomplete();
    /// Lets finish_statement() roll the current statement back.
    void discard_statement() { is_discarded_ = true; }
    /// Discards the current statement and its open arguments; the parser continues inside the
    /// statement.
    void recover();

    /// Ends the current statement: keeps its nodes, or rolls the nodes back and marks the Ast as
    /// incomplete. `is_complete`: the statement has no syntax error. Returns whether the statement
    /// was kept.
    bool finish_statement(SourceSpan span, bool is_complete);
    /// Protects all present nodes from rollbacks, for example the nodes of an included file.
    void set_watermark();

private:
    /// State of the last name of the current module list. Decides whether parentheses may follow
    /// it.
    enum class LastName : std::uint8_t {
        None,   // no name yet, or a character that was reported because it is not a module
        Empty,  // an empty text in back quotes
        Bare,   // a module without parentheses
        Called, // a module with parentheses
    };
    /// Sizes of the Ast without the current statement, to which a rollback returns.
    struct Watermark {
        std::size_t expressions = 0;
        std::size_t expression_lists = 0;
        std::size_t argument_lists = 0;
        std::size_t modules = 0;
        std::size_t calls = 0;
        std::size_t set_values = 0;
        std::size_t locals = 0;
    };

    ExpressionId add(const Expression& expression);
    /// Moves the last `count` arguments to Ast::expression_lists.
    ListRange take_arguments(std::uint32_t count);
    /// The set values added since the last statement.
    [[nodiscard]] ListRange new_set_values() const;
    /// Returns whether 32-bit ids suffice for one more statement, which has fewer than 2^31 nodes
    /// of each kind; reports a grammar that is too large.
    [[nodiscard]] bool check_room(SourceSpan span);
    /// Removes the nodes of the current statement.
    void rollback();
    /// Makes node `index` of this kind the node of the current statement.
    void begin_node(StatementKind kind, std::size_t index);
    void push_module(NameId name, TextRange text);
    /// Appends a module of text that was translated or edited before the scan.
    void push_module_of_edited_text(NameId name, TextRange text);
    /// Appends a module; stores the end of its name if the text of the file does not give it.
    void push_with_place(NameId name, SourceSpan span);
    /// Returns `span`; if it is in another file than the list, the last span of the list instead,
    /// because modules store offsets without files. Only statements of translations span files.
    [[nodiscard]] SourceSpan place_in_list(SourceSpan span);
    /// Extends `list` up to the last module of Ast::modules, and list.span by `span`.
    void extend_list(ModuleList& list, SourceSpan span);
    /// Begins the call of the last module and sets CallNode::module. Returns false if the module
    /// cannot take `parentheses`, which is reported here or has been reported before.
    [[nodiscard]] bool begin_call(SourceSpan parentheses, CallNode& call);
    /// Reads `(1, 2.5, -3)` at `open` for the last module; returns its end. Precondition: the
    /// scanner has matched the parentheses.
    std::uint32_t read_plain_arguments(std::uint32_t open, std::uint32_t name_end);
    ExpressionId plain_number(std::uint32_t begin, std::uint32_t end);
    /// Appends each letter as a module; reports other characters.
    void push_letters(TextRange word);
    /// Appends the sense module `?NAME` at the beginning of `run`; returns its end. Unless
    /// module names are words, NAME is one letter.
    std::uint32_t push_sense(TextRange run);
    /// Appends one character, which stands for the bytes of `text`.
    void push_character(std::string_view character, TextRange text);
    /// Names::intern() with a cache of short names.
    NameId intern_word(std::string_view word);
    /// Counts open brackets; reports branches that are nested too deep.
    void count_bracket(char bracket, SourceSpan span);
    /// Records a `//` before a word; the author may have meant a comment.
    void record_slashes(std::uint32_t slashes);
    /// The place of a name without the `#` before it.
    [[nodiscard]] SourceSpan name_without_hash(SourceSpan label) const;

    const ScannedText& scanned_;
    Ast& ast_;
    const SourceMap& sources_;
    Names& names_;
    Diagnostics& diagnostics_;
    ModuleNames module_names_ = ModuleNames::Words;
    std::uint32_t text_end_ = 0; // end of the last text in back quotes, in the scanned text

    std::array<NameId, 128> one_character_names_; // kUnset until interned; index: the character
    struct CachedWord {
        std::uint64_t key = 0; // the characters of the name
        NameId name = kNoName;
    };
    std::vector<CachedWord> word_cache_; // recent names of up to eight characters

    std::vector<ExpressionId> arguments_; // stack: arguments that no node has taken yet
    std::uint32_t open_brackets_ = 0;     // `[` of the current module list
    LastName last_name_ = LastName::None;
    /// Place of the last module of the current list in the original file; for translations only.
    SourceSpan list_place_;
    bool is_discarded_ = false; // finish_statement() rolls the current statement back
    bool has_node_ = false;     // the node of the current statement is in the Ast
    Statement statement_;
    ProductionNode production_; // the current production; parts not parsed yet are empty
    Watermark watermark_;
};

} // namespace lsys
