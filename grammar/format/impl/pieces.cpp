// SPDX-License-Identifier: MIT
#include "grammar/format/impl/pieces.h"

#include "grammar/base/utf8.h"

#include <algorithm>

namespace lsys {

namespace {

/// Maximum number of equal symbols in a piece, as in `////`.
constexpr std::uint32_t kMaxRepeats = 16;

/// Whether the operator has no blanks around it.
bool is_tight(const Lexeme& lexeme) {
    return lexeme.kind == LexemeKind::Operator &&
           (lexeme.text == "^" || lexeme.text == "*" || lexeme.text == "/");
}

bool is_module(const Lexeme& lexeme, char symbol) {
    return lexeme.kind == LexemeKind::Module && lexeme.text[0] == symbol;
}
bool opens_bracket(const Lexeme& lexeme) {
    return is_module(lexeme, '[') || is_module(lexeme, '{');
}
bool closes_bracket(const Lexeme& lexeme) {
    return is_module(lexeme, ']') || is_module(lexeme, '}');
}

/// Whether a blank separates two tokens of a statement. Only parentheses, braces, `,` and `;` may
/// adjoin a comment: an adjacent `/` could change where the comment begins or ends.
bool blank_between(const Lexeme& before, const Lexeme& after) {
    using enum LexemeKind;
    if (before.kind == BlockComment) {
        return after.kind != Semicolon && after.kind != Comma && after.kind != Right &&
               after.kind != Close;
    }
    if (after.kind == BlockComment) {
        return before.kind != Open && before.kind != Left;
    }
    switch (after.kind) {
    case Semicolon:
        return before.kind == Colon; // an empty successor
    case Open:
    case Close:
    case Right:
    case Comma:
        return false;
    case Colon:
    case Context:
        return true;
    case Module:
        return before.kind != Module && before.kind != Close ? true : after.has_blank_before;
    case Left:
        if (after.opens_call) {
            return false;
        }
        break;
    default:
        break;
    }
    return !is_tight(after) && !is_tight(before) && before.kind != Open && before.kind != Left &&
           before.kind != Unary;
}

} // namespace

void append_comment(std::string_view comment, std::string& out) {
    for (std::size_t at = 0; at < comment.size();) {
        const std::size_t end = std::min(comment.find("\r\n", at), comment.size());
        out += comment.substr(at, end - at);
        at = end < comment.size() ? end + 1 : end;
    }
}

PieceReader::PieceReader(std::string_view text, std::size_t begin) : reader_(text, begin) {
    done_ = !reader_.next(current_);
    shape_ = reader_.shape();
}

bool PieceReader::next(Piece& piece) {
    if (done_) {
        return false;
    }
    piece.text.clear();
    describe(piece);
    for (;;) {
        take(piece);
        previous_ = current_;
        if (previous_.kind == LexemeKind::Semicolon || !reader_.next(current_)) {
            done_ = true;
            piece.ends_statement = true;
            break;
        }
        if (ends_before(current_)) {
            break;
        }
        if (blank_between(previous_, current_)) {
            piece.text += ' ';
        }
    }
    end_ = reader_.offset();
    if (piece.break_class == BreakClass::Fine && piece.text.starts_with("//")) {
        piece.break_class = BreakClass::Poor; // a line that begins with `//` looks like a comment
    }
    const std::string_view written = piece.text;
    piece.has_several_lines = has_comment_ && written.find('\n') != written.npos;
    if (piece.has_several_lines) {
        piece.width = text_width(written.substr(0, written.find('\n')));
        piece.last_width = text_width(written.substr(written.rfind('\n') + 1));
    } else {
        piece.width = text_width(written);
        piece.last_width = piece.width;
    }
    return true;
}

bool PieceReader::skip_rest() {
    bool has_several_lines = false;
    while (!done_) {
        has_several_lines = has_several_lines || (current_.kind == LexemeKind::BlockComment &&
                                                  current_.text.find('\n') != current_.text.npos);
        done_ = current_.kind == LexemeKind::Semicolon || !reader_.next(current_);
    }
    end_ = reader_.offset();
    return has_several_lines;
}

void PieceReader::describe(Piece& piece) {
    const bool first = index_ == 0;
    piece.has_blank_before = !first && blank_between(previous_, current_);
    piece.begins_cell = !first && begins_cell();
    piece.is_in_list = is_in_list_;
    const bool keeps_line = current_.kind != LexemeKind::Semicolon;
    piece.begins_line =
        (is_in_list_ || begins_local()) && keeps_line && current_.newlines_before > 0;
    piece.break_class = first ? BreakClass::Never : break_class();
    piece.depth = brackets_ - (closes_bracket(current_) && brackets_ > 0 ? 1U : 0U);
    piece.rank = 0;
    if (is_in_list_) {
        // Prefer breaks at outer levels, then at blanks, then before branches.
        piece.rank =
            brackets_ * 4 + (piece.has_blank_before ? 0 : 2) + (is_module(current_, '[') ? 0 : 1);
    } else if (current_.kind == LexemeKind::Operator) {
        piece.rank = 1; // rather between local values than within one
    }
    piece.ends_statement = false;
    piece.is_only_semicolon = current_.kind == LexemeKind::Semicolon;
}

bool PieceReader::begins_cell() const {
    if (parentheses_ > 0 || current_.kind == LexemeKind::BlockComment) {
        return false;
    }
    switch (shape_) {
    case StatementShape::Production:
        return current_.kind == LexemeKind::Colon && colons_ < 3;
    case StatementShape::Definition:
        return index_ <= 2 || current_.opens_bounds;
    case StatementShape::Setting:
    case StatementShape::Keyed:
    case StatementShape::Declaration:
        return index_ <= 2;
    case StatementShape::List:
    case StatementShape::Other:
        break;
    }
    return false;
}

bool PieceReader::begins_local() const {
    return shape_ == StatementShape::Production && !is_in_list_ && parentheses_ == 0 &&
           previous_.kind == LexemeKind::Comma;
}

BreakClass PieceReader::break_class() const {
    using enum LexemeKind;
    if (begins_local()) {
        return current_.kind == BlockComment ? BreakClass::Never : BreakClass::Fine;
    }
    if (is_in_list_) {
        if (opens_bracket(previous_) || current_.kind == BlockComment ||
            current_.kind == Semicolon) {
            return BreakClass::Never;
        }
        return closes_bracket(current_) ? BreakClass::Poor : BreakClass::Fine;
    }
    switch (current_.kind) {
    case Operator:
        return previous_.kind == Keyword || current_.text == "=" ? BreakClass::Never
                                                                 : BreakClass::Fine;
    case Context:
    case Module:
        return BreakClass::Fine;
    case Word: // a key
        return shape_ == StatementShape::Keyed && parentheses_ == 0 && index_ > 2 &&
                       previous_.text != "shape" // the value of `shape` is a word
                   ? BreakClass::Fine
                   : BreakClass::Never;
    default:
        // A cell begins after a `:`, a pair of numbers of a #curve or #contour after a `,`.
        return (previous_.kind == Colon || (previous_.kind == Comma && parentheses_ == 0)) &&
                       current_.kind != Semicolon
                   ? BreakClass::Fine
                   : BreakClass::Never;
    }
}

bool PieceReader::continues_repeat(const Lexeme& after) const {
    return after.kind == LexemeKind::Module && previous_.kind == LexemeKind::Module &&
           !after.has_blank_before && after.text[0] == previous_.text[0] &&
           after.text.size() == 1 && previous_.text.size() == 1 && !opens_bracket(after) &&
           !closes_bracket(after) && repeat_count_ < kMaxRepeats;
}

bool PieceReader::ends_before(const Lexeme& after) const {
    if (parentheses_ > 0) {
        return false;
    }
    if (is_in_list_ && after.kind == LexemeKind::Module) {
        return !continues_repeat(after);
    }
    if (is_in_list_ && after.kind == LexemeKind::Open) {
        return false;
    }
    return blank_between(previous_, after);
}

void PieceReader::take(Piece& piece) {
    repeat_count_ = !piece.text.empty() && continues_repeat(current_) ? repeat_count_ + 1 : 1;
    if (current_.kind == LexemeKind::BlockComment) {
        has_comment_ = true;
        append_comment(current_.text, piece.text);
    } else {
        piece.text += current_.text;
    }
    switch (current_.kind) {
    case LexemeKind::BlockComment:
        return;
    case LexemeKind::Open:
    case LexemeKind::Left:
        ++parentheses_;
        break;
    case LexemeKind::Close:
    case LexemeKind::Right:
        parentheses_ -= parentheses_ > 0 ? 1U : 0U;
        break;
    case LexemeKind::Colon:
        ++colons_;
        is_in_list_ = is_in_list_ || current_.ends_head || shape_ == StatementShape::List;
        break;
    case LexemeKind::Module:
        if (opens_bracket(current_)) {
            ++brackets_;
        } else if (closes_bracket(current_)) {
            brackets_ -= brackets_ > 0 ? 1U : 0U;
        }
        break;
    default:
        break;
    }
    ++index_;
}

} // namespace lsys
