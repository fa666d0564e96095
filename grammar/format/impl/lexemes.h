// SPDX-License-Identifier: MIT
// The tokens of a .lsys text without errors, for the formatter, with comments and the blanks before
// them. Tokens are read one by one, because a text may have a hundred million.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace lsys {

enum class LexemeKind : std::uint8_t {
    LineComment,  // between statements
    BlockComment, // anywhere
    Keyword,      // `#name`
    Module,       // a name or symbol of a module list
    Open,         // the `(` after a module
    Close,        // the `)` of Open
    Context,      // `<` or `>` of a production's head
    Colon,
    Semicolon,
    Word, // a name in an expression or value
    Number,
    Quoted,   // "file"
    Operator, // in an expression; also `~` of a condition
    Any,      // the condition `*`
    Unary,    // `-` or `!` before its operand
    Left,     // `(` or `{` of an expression
    Right,    // `)` or `}`
    Comma,
};

struct Lexeme {
    LexemeKind kind{};
    std::string_view text;
    std::uint32_t newlines_before = 0; // number of line ends before the token
    bool has_blank_before = false;
    bool opens_call = false;   // for Left: the `(` of a function call
    bool opens_bounds = false; // for Left: the `{` after the value of a `#param`
    bool ends_head = false;    // for Colon of a production: the successor is next
};

/// The form of a statement for its layout.
enum class StatementShape : std::uint8_t {
    Production,  // three colons, then modules
    List,        // `#w`, `#ignore`, `#consider`: a colon, then modules
    Definition,  // `#define` and `#param`: a name, a value, bounds
    Setting,     // `#set`: a name, values
    Keyed,       // `#material` and `#sense`: an index or a name, keys with values
    Declaration, // `#object`, `#module`, `#include NAME OBJECT`
    Other,
};

[[nodiscard]] inline bool is_comment(const Lexeme& lexeme) {
    return lexeme.kind == LexemeKind::LineComment || lexeme.kind == LexemeKind::BlockComment;
}

/// Reads tokens; begins between two statements.
class LexemeReader {
public:
    LexemeReader(std::string_view text, std::size_t begin) : text_(text), at_(begin) {}

    /// Reads the next token; returns false at the end of the text.
    bool next(Lexeme& lexeme);
    /// The end of the last token.
    [[nodiscard]] std::size_t offset() const { return at_; }
    /// The shape of the current statement.
    [[nodiscard]] StatementShape shape() const { return shape_; }

private:
    /// Kind of the text at the current place: between statements; modules; value of #object; values
    /// of #set; a name before an expression; an expression.
    enum class Area : std::uint8_t { Between, Modules, Object, Set, Name, Expression };

    [[nodiscard]] bool starts(char first, char second) const {
        return bytes_left() >= 2 && text_[at_] == first && text_[at_ + 1] == second;
    }
    [[nodiscard]] std::size_t bytes_left() const { return text_.size() - at_; }
    [[nodiscard]] std::size_t word_length(std::size_t from) const;
    [[nodiscard]] std::size_t number_length() const;
    /// The next character outside of blanks and comments; NUL at the end.
    [[nodiscard]] char next_character() const;
    /// Skips blanks and counts line ends; returns false at the end of the text.
    bool skip_blanks();
    /// Makes the next `length` bytes the current token.
    void take(LexemeKind kind, std::size_t length);
    void read_line_comment();
    void read_keyword();
    /// Enters the next part of a production, `#name :` head `:` condition `:` successor, or of an
    /// axiom, `#w ~` probability `:` modules.
    void enter_next_part();
    void read_token();
    void read_module();
    void read_quoted();
    void read_value(LexemeKind kind, std::size_t length);
    void read_expression();
    void read_operation();

    std::string_view text_;
    std::size_t at_;
    Lexeme lexeme_;
    std::uint32_t newlines_ = 0; // line ends before the next token
    bool blank_ = false;         // blanks stand before the next token
    Area area_ = Area::Between;
    StatementShape shape_ = StatementShape::Other;
    // Part of a production: 1 name, 2 head, 3 condition and local values, 4 successor; else 0.
    std::uint32_t part_ = 0;
    bool has_locals_ = false;     // the local values of the production have begun
    bool in_probability_ = false; // in the probability of an axiom
    bool in_formals_ = false;     // in the name or the formals of a #function
    std::uint32_t depth_ = 0;     // open parentheses and braces
    bool after_value_ = false;    // the last token ends a value: `-` is binary, `(` begins a call
    LexemeKind previous_ = LexemeKind::Semicolon;
};

/// The tokens of a text.
[[nodiscard]] std::vector<Lexeme> lexemes_of(std::string_view text);

} // namespace lsys
