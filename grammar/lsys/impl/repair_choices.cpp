// SPDX-License-Identifier: MIT
#include "grammar/lsys/impl/statement_repair.h"

#include <string>

namespace lsys::lsys_grammar {

void StatementRepair::choices() {
    const auto question = find('?', body_);
    if (question == std::string_view::npos) {
        return;
    }
    std::size_t begin = question;
    int depth = 0;
    std::size_t min_begin = body_;
    if (keyword_ == Keyword::Function) {
        min_begin = text().find(')', body_) + 1;
    } else if (keyword_ == Keyword::Define) {
        min_begin = skip_gaps(text(), body_);
        min_begin += leading_word(text().substr(min_begin)).size();
    }
    bool is_inside = false;
    std::size_t range = std::string_view::npos; // begin of the innermost `{` around the `?`
    while (begin > min_begin) {
        const char c = char_at(begin - 1);
        if (c == ')' || c == '}') {
            ++depth;
        } else if (depth > 0 && (c == '(' || c == '{')) {
            --depth;
        } else if (c == '(') {
            is_inside = true;
            break;
        } else if (c == '{') { // a range within an argument or a value, else a polygon
            range = range == std::string_view::npos ? begin : range;
        } else if (depth == 0 && (c == ',' || c == ':' || c == '=')) {
            const bool compares =
                c == '=' && begin >= 2 &&
                std::string_view("=<>!").find(char_at(begin - 2)) != std::string_view::npos;
            const bool is_first = c == '=' && begin < text().size() && char_at(begin) == '=';
            if (!compares && !is_first) {
                is_inside = c != ':';
                break;
            }
        }
        --begin;
    }
    const bool has_value = keyword_ == Keyword::Function || keyword_ == Keyword::Define;
    if (!is_inside && !has_value) {
        return;
    }
    begin = range != std::string_view::npos ? range : begin;
    std::size_t end = question + 1;
    depth = 0;
    int pending = 1; // count of `:` to come
    for (; end < statement_.end; ++end) {
        const char c = char_at(end);
        if (is_opening(c)) {
            ++depth;
        } else if (is_closing(c) && depth-- == 0) {
            break;
        } else if (depth == 0 && c == '?') {
            ++pending;
        } else if (depth == 0 && c == ':') {
            if (pending-- == 0) {
                break;
            }
        } else if (depth == 0 && c == ',') {
            break;
        }
    }
    const Piece all = trimmed(text(), begin, end);
    const std::string call = choice_text(all);
    if (call.empty()) {
        return;
    }
    Diagnostic& diagnostic =
        report({question, question + 1}, "there is no operator `? :`: a choice is `if(condition, "
                                         "a, b)`");
    add_fix(diagnostic, "write `" + call + "`", draft_.span(all.begin, all.end), call, false);
    // Any value serves, since the statement has an error.
    draft_.blank(all.begin, all.end);
    draft_.put(all.begin, '1');
    choices();
}

std::string StatementRepair::choice_text(Piece piece) const {
    std::string result;
    std::string closing;
    for (int i = 0; i < 16; ++i) {
        const std::vector<Piece> sides = split(text(), piece.begin, piece.end, '?', true);
        if (sides.size() < 2) {
            return result.empty() ? result : result + copy_of(draft_.text, piece) + closing;
        }
        std::size_t colon = sides[0].end;
        int pending = 0;
        int depth = 0;
        for (; colon < piece.end; ++colon) {
            const char c = char_at(colon);
            depth += is_opening(c) ? 1 : is_closing(c) ? -1 : 0;
            pending += depth == 0 && c == '?' ? 1 : 0;
            if (depth == 0 && c == ':' && --pending == 0) {
                break;
            }
        }
        if (colon >= piece.end) {
            return {};
        }
        Piece condition = sides[0];
        const std::size_t question = text().find('?', condition.end);
        const Piece chosen = trimmed(text(), question + 1, colon);
        if (text_of(text(), chosen).find('?') != std::string_view::npos) {
            return {};
        }
        if (char_at(condition.begin) == '(' &&
            closing_of(text(), condition.begin, condition.end) + 1 == condition.end) {
            condition = trimmed(text(), condition.begin + 1, condition.end - 1);
        }
        result +=
            "if(" + copy_of(draft_.text, condition) + ", " + copy_of(draft_.text, chosen) + ", ";
        closing += ')';
        piece = trimmed(text(), colon + 1, piece.end);
    }
    return {};
}

} // namespace lsys::lsys_grammar
