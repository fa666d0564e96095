#include "grammar/format/impl/lines.h"

#include <algorithm>

namespace lsys {

namespace {

constexpr std::uint32_t kIndent = 4;
constexpr std::uint32_t kDeepestLevel = 4;
/// Lines are not broken left of this column if they can be broken right of it.
constexpr std::uint32_t kShortLine = 40;

std::uint32_t indent_of(std::uint32_t depth) {
    return kIndent * (1 + std::min(depth, kDeepestLevel));
}

} // namespace

void LineWriter::add(const Piece& piece, std::uint32_t blanks, bool may_break) {
    if (piece.own_line) {
        new_line(piece.depth);
    }
    if (!at_begin_) {
        if (may_break && piece.break_class != BreakClass::Never) {
            places_.push_back({line_.size(), line_.size() + blanks, column_, column_ + blanks,
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
    while (column_ > kColumns && !places_.empty()) {
        break_line();
    }
    if (piece.several_lines) {
        out_ += line_;
        line_.clear();
        places_.clear();
        column_ = piece.last_width;
        one_line_ = false;
    }
}

void LineWriter::finish() {
    out_ += line_;
    line_.clear();
    places_.clear();
}

void LineWriter::new_line(std::uint32_t depth) {
    out_ += line_;
    out_ += '\n';
    column_ = indent_of(depth);
    line_.assign(column_, ' ');
    places_.clear();
    at_begin_ = true;
    one_line_ = false;
}

/// The best place that makes the line short enough, of equals the last; else the first place.
std::size_t LineWriter::best_place() const {
    std::size_t best = places_.size();
    std::size_t last_short = places_.size();
    for (std::size_t i = 0; i < places_.size() && places_[i].end_column <= kColumns; ++i) {
        last_short = i;
        const Place& place = places_[i];
        if (place.begin_column < kShortLine) {
            continue;
        }
        const auto is_worse = [&](const Place& than) {
            return place.break_class != than.break_class ? place.break_class < than.break_class
                                                         : place.rank > than.rank;
        };
        if (best == places_.size() || !is_worse(places_[best])) {
            best = i;
        }
    }
    if (best != places_.size()) {
        return best;
    }
    return last_short != places_.size() ? last_short : 0;
}

void LineWriter::break_line() {
    const std::size_t chosen = best_place();
    const Place place = places_[chosen];
    const std::uint32_t indent = indent_of(place.depth);
    out_.append(line_, 0, place.end);
    out_ += '\n';
    line_.replace(0, place.begin, indent, ' ');
    places_.erase(places_.begin(), places_.begin() + static_cast<std::ptrdiff_t>(chosen) + 1);
    for (Place& later : places_) {
        later.end = later.end - place.begin + indent;
        later.begin = later.begin - place.begin + indent;
        later.end_column = later.end_column - place.begin_column + indent;
        later.begin_column = later.begin_column - place.begin_column + indent;
    }
    column_ = column_ - place.begin_column + indent;
    one_line_ = false;
}

} // namespace lsys
