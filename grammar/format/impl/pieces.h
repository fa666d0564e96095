// SPDX-License-Identifier: MIT
// Pieces of a statement, which contain no line ends outside of comments: a module with its
// arguments, or another word with its punctuation. Each piece describes the place before it:
// blanks, the beginning of a cell, the author's line end, a possible line break. Within a piece the
// operators `^`, `*` and `/` have no blanks around them; other binary operators have blanks.
#pragma once

#include "grammar/format/impl/lexemes.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace lsys {

/// The quality of a line break before a piece, further ordered by Piece::rank.
enum class BreakClass : std::uint8_t { Never, Poor, Fine };

struct Piece {
    std::string text;
    std::uint32_t width = 0;        // width of the first line
    std::uint32_t last_width = 0;   // width of the last line
    bool has_several_lines = false; // a comment within has line ends
    bool has_blank_before = false;
    bool begins_cell = false; // aligned with the pieces of other statements (LayoutRow)
    bool is_in_list = false;  // in a list of modules, after the last colon
    bool begins_line = false; // the author began a line with this piece
    BreakClass break_class = BreakClass::Never;
    std::uint32_t rank = 0;  // rank among breaks of one class; the lowest is best
    std::uint32_t depth = 0; // open brackets before the piece; after the piece for a `]`
    bool ends_statement = false;
    bool is_only_semicolon = false; // the `;` of an empty list
};

class PieceReader {
public:
    /// `begin`: offset of the first byte of a statement.
    PieceReader(std::string_view text, std::size_t begin);

    /// Reads the next piece; returns false after the last.
    bool next(Piece& piece);
    /// Skips the remaining pieces; returns whether a comment among them has line ends.
    bool skip_rest();
    /// The end of the statement, after the last piece.
    [[nodiscard]] std::size_t offset() const { return end_; }
    [[nodiscard]] StatementShape shape() const { return shape_; }

private:
    /// Whether the current piece ends before the token `after`.
    [[nodiscard]] bool ends_before(const Lexeme& after) const;
    /// Whether `after` repeats the symbol before it.
    [[nodiscard]] bool continues_repeat(const Lexeme& after) const;
    /// Whether the current token begins a cell of LayoutRow.
    [[nodiscard]] bool begins_cell() const;
    /// Whether the current token is the name of a local value after the first.
    [[nodiscard]] bool begins_local() const;
    /// The quality of a line break before the current token.
    [[nodiscard]] BreakClass break_class() const;
    /// Sets the facts of a piece that begins with the current token.
    void describe(Piece& piece);
    /// Appends the current token to the piece.
    void take(Piece& piece);

    LexemeReader reader_;
    Lexeme previous_;
    Lexeme current_;
    std::size_t end_ = 0; // see offset()
    bool done_ = false;   // the last piece has been read
    StatementShape shape_ = StatementShape::Other;
    std::uint32_t index_ = 0;        // index of current_, not counting comments
    std::uint32_t colons_ = 0;       // number of `:` so far
    std::uint32_t parentheses_ = 0;  // number of open `(`
    std::uint32_t brackets_ = 0;     // number of open `[`
    std::uint32_t repeat_count_ = 1; // adjacent equal symbols, `////`
    bool is_in_list_ = false;        // the current token is in a list of modules
    bool has_comment_ = false;       // a block comment has been read
};

/// Appends `comment` with line ends `\n`.
void append_comment(std::string_view comment, std::string& out);

} // namespace lsys
