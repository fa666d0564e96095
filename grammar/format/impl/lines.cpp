// SPDX-License-Identifier: MIT
#include "grammar/format/impl/lines.h"

#include <algorithm>

namespace lsys {

namespace {

constexpr std::uint32_t kIndent = 4;
constexpr std::uint32_t kMaxIndentLevel = 4;
/// Lines are not broken left of this column if they can be broken right of it.
constexpr std::uint32_t kShortLine = 40;

} // namespace

std::uint32_t line_indent(std::uint32_t depth) {
    return kIndent * (1 + std::min(depth, kMaxIndentLevel));
}

void LineWriter::add(const Piece& piece, std::uint32_t blanks, bool may_break) {
    if (piece.begins_line) {
        new_line(piece.depth);
    }
    if (!at_begin_) {
        if (may_break && piece.break_class != BreakClass::Never) {
            breaks_.push_back({line_.size(), line_.size() + blanks, column_, column_ + blanks,
                               piece.rank, piece.depth, piece.break_class});
        }
        if (blanks > 0) {
            line_.append(blanks, ' ');
            column_ += blanks;
        }
    }
    at_begin_ = false;
    line_ += piece.text;
    column_ += piece.width;
    while (column_ > kColumns && !breaks_.empty()) {
        break_line();
    }
    if (piece.has_several_lines) {
        out_ += line_;
        line_.clear();
        breaks_.clear();
        column_ = piece.last_width;
        one_line_ = false;
    }
}

void LineWriter::finish() {
    out_ += line_;
    line_.clear();
    breaks_.clear();
}

void LineWriter::new_line(std::uint32_t depth) {
    out_ += line_;
    out_ += '\n';
    column_ = line_indent(depth);
    line_.assign(column_, ' ');
    breaks_.clear();
    at_begin_ = true;
    one_line_ = false;
}

std::size_t LineWriter::best_break() const {
    std::size_t best = breaks_.size();
    std::size_t last_short = breaks_.size();
    for (std::size_t i = 0; i < breaks_.size() && breaks_[i].end_column <= kColumns; ++i) {
        last_short = i;
        const LineBreak& candidate = breaks_[i];
        if (candidate.begin_column < kShortLine) {
            continue;
        }
        const auto is_worse = [&](const LineBreak& other) {
            return candidate.break_class != other.break_class
                       ? candidate.break_class < other.break_class
                       : candidate.rank > other.rank;
        };
        if (best == breaks_.size() || !is_worse(breaks_[best])) {
            best = i;
        }
    }
    if (best != breaks_.size()) {
        return best;
    }
    return last_short != breaks_.size() ? last_short : 0;
}

void LineWriter::break_line() {
    const std::size_t index = best_break();
    const LineBreak chosen = breaks_[index];
    const std::uint32_t indent = line_indent(chosen.depth);
    out_.append(line_, 0, chosen.end);
    out_ += '\n';
    line_.replace(0, chosen.begin, indent, ' ');
    breaks_.erase(breaks_.begin(), breaks_.begin() + static_cast<std::ptrdiff_t>(index) + 1);
    for (LineBreak& later : breaks_) {
        later.end = later.end - chosen.begin + indent;
        later.begin = later.begin - chosen.begin + indent;
        later.end_column = later.end_column - chosen.begin_column + indent;
        later.begin_column = later.begin_column - chosen.begin_column + indent;
    }
    column_ = column_ - chosen.begin_column + indent;
    one_line_ = false;
}

} // namespace lsys
