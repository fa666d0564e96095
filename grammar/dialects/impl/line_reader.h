// SPDX-License-Identifier: MIT
// Reader of formats that are lists of lines: `key: value`, `A=B`. Splits a text into pieces, each
// with its span. The format defines the places of blanks and comments; the front end of a dialect
// defines the length of a piece and the pieces of a line.
#pragma once

#include "grammar/ast/parse_context.h"

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string_view>

namespace lsys {

enum class LinePieceKind : std::uint8_t {
    Text,    // not empty
    LineEnd, // with the blank lines after it; empty where the text ends
    TextEnd, // empty, after the last LineEnd
};

struct LinePiece {
    LinePieceKind kind{};
    SourceSpan span;
    std::string_view text;
};

struct LineFormat {
    std::string_view blanks;  // skipped between pieces; no piece is a LineEnd if `\n` is a blank
    char comment = '\0';      // first character of a comment, before a piece; NUL: none
    bool comment_nul = false; // a comment continues after a NUL character
};

struct DialectWords;

class LineReader {
public:
    /// Returns the length in bytes of the piece at the start of a text that is not empty and begins
    /// with no blank; 0 stands for a piece of one character.
    using PieceLength = std::size_t (*)(std::string_view ahead);

    /// Precondition: the sources of `context` hold `text` as long as the reader is in use.
    LineReader(SourceSpan text, const LineFormat& format, const ParseContext& context);
    /// Sets the keywords of the dialect, which messages compare with the text; may be null.
    void set_words(const DialectWords* words) { words_ = words; }

    /// Skips blanks and comments; returns the next piece.
    LinePiece next(PieceLength length);
    /// Skips blanks and comments; returns the text from the next piece on.
    [[nodiscard]] std::string_view ahead();
    /// The text after the last piece, with blanks and comments.
    [[nodiscard]] std::string_view rest() const { return text_.substr(at_); }
    /// The next `length` bytes as a piece; `length` may be 0.
    LinePiece take(std::size_t length);
    /// Returns `fits`. If not, reports that one of `wanted` was expected at `found`, and skips the
    /// line of `found`.
    bool expect(bool fits, const LinePiece& found, std::initializer_list<std::string_view> wanted);
    /// Expects the next piece to be the end of the line.
    bool expect_line_end(PieceLength length);

private:
    LinePiece piece(LinePieceKind kind, std::size_t length);

    SourceSpan span_;
    std::string_view text_;
    LineFormat format_;
    const ParseContext& context_;
    const DialectWords* words_ = nullptr;
    std::size_t at_ = 0; // offset in text_ of the next piece
    bool ended_ = false; // the last LineEnd has been taken
};

/// A file as one span.
[[nodiscard]] SourceSpan whole_file(FileId file, const ParseContext& context);

} // namespace lsys
