// A statement cut into pieces that no line end may part: a module with its arguments, a word of the
// rest with the punctuation around it. Each says what stands before it: blanks, a cell that columns
// may be lined up at, a line end of the author's, a place where a long line may be broken. The
// blanks within a piece follow one rule: `^`, `*` and `/` are tight, other binary operators are
// not.
#pragma once

#include "grammar/format/impl/lexemes.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace lsys {

/// How well a line can be broken before a piece; less is better within a class.
enum class BreakClass : std::uint8_t { Never, Poor, Fine };

struct Piece {
    std::string text;
    std::uint32_t width = 0;      // of its first line
    std::uint32_t last_width = 0; // of its last line
    bool several_lines = false;   // a comment in it has line ends
    bool blank = false;           // before it
    bool begins_cell = false;
    bool in_list = false;  // of modules, after the last colon
    bool own_line = false; // where the author put it
    BreakClass break_class = BreakClass::Never;
    std::uint32_t rank = 0;  // of breaks of one class, the least is best
    std::uint32_t depth = 0; // brackets that are open before it; `]` counts as closed
    bool ends_statement = false;
    bool semicolon_only = false; // of an empty list
};

class PieceReader {
public:
    /// `begin`: of a statement.
    PieceReader(std::string_view text, std::size_t begin);

    /// False after the last piece.
    bool next(Piece& piece);
    /// Passes over the pieces that are left; says whether a comment among them has line ends.
    bool skip_rest();
    /// After the last piece: where the statement ends.
    [[nodiscard]] std::size_t offset() const { return end_; }
    [[nodiscard]] StatementShape shape() const { return shape_; }

private:
    [[nodiscard]] bool ends_before(const Lexeme& after) const;
    [[nodiscard]] bool continues_row(const Lexeme& after) const;
    [[nodiscard]] bool begins_cell() const;
    [[nodiscard]] BreakClass break_class() const;
    void describe(Piece& piece);
    void take(Piece& piece);

    LexemeReader reader_;
    Lexeme before_;
    Lexeme now_;
    std::size_t end_ = 0;
    bool done_ = false;
    StatementShape shape_ = StatementShape::Other;
    std::uint32_t index_ = 0; // of now_ among the tokens that are no comments
    std::uint32_t colons_ = 0;
    std::uint32_t parentheses_ = 0;
    std::uint32_t brackets_ = 0;
    std::uint32_t row_ = 1; // symbols of one kind side by side, `////`
    bool in_list_ = false;
    bool has_comment_ = false;
};

/// The line ends of `comment` become `\n`.
void append_comment(std::string_view comment, std::string& out);

} // namespace lsys
