// SPDX-License-Identifier: MIT
#include "grammar/base/characters.h"
#include "grammar/lsys/impl/statement_repair.h"

#include <string>

namespace lsys::lsys_grammar {

std::size_t StatementRepair::repair_function() {
    const std::size_t open = find('(', body_);
    if (open == std::string_view::npos) {
        return after();
    }
    const std::size_t close = closing_of(text(), open, statement_.end);
    if (close == std::string_view::npos) {
        return after();
    }
    formals(open, close);
    std::size_t at = skip_gaps(text(), close + 1);
    const std::size_t first = at;
    std::vector<Piece> needless;
    const auto take = [&](std::size_t length) {
        needless.push_back({at, at + length});
        at = skip_gaps(text(), at + length);
    };
    if (text().substr(at, 2) == "->" || text().substr(at, 2) == "=>") {
        take(2);
    } else if (at < text().size() && char_at(at) == ':') {
        take(1);
    }
    const bool has_brace = at < text().size() && char_at(at) == '{';
    const bool has_return = [&] {
        const std::size_t word = has_brace ? skip_gaps(text(), at + 1) : at;
        return leading_word(text().substr(word)) == "return";
    }();
    const bool is_block = has_brace && (has_return || is_braced_expression(at));
    if (is_block) {
        take(1);
    }
    if (has_return) {
        take(6);
    }
    if (needless.empty()) {
        choices();
        return after();
    }
    std::size_t end = after();
    if (is_block) {
        std::size_t brace = skip_gaps(text(), end);
        if (statement_.end < text().size() && brace < text().size() && char_at(brace) == '}') {
            needless.push_back({brace, brace + 1});
            end = brace + 1;
            const std::size_t second = skip_gaps(text(), end);
            if (second < text().size() && char_at(second) == ';') {
                needless.push_back({second, second + 1});
                end = second + 1;
            }
        } else {
            brace = text().rfind('}', statement_.end);
            if (brace != std::string_view::npos && brace > at) {
                needless.push_back({brace, brace + 1});
            }
        }
    }
    const Piece expression = trimmed(text(), at,
                                     text().find_first_of(";}", at) == std::string_view::npos
                                         ? statement_.end
                                         : text().find_first_of(";}", at));
    Diagnostic& diagnostic = report(
        {first,
         at == first
             ? at + 1
             : needless[is_block && has_return && needless.size() > 1 ? 1 : needless.size() - 1]
                   .end},
        "a function is a name, its parameters and one expression");
    const Piece head = trimmed(text(), statement_.begin, close + 1);
    Fix fix{"write `" + copy_of(draft_.text, head) + " " + copy_of(draft_.text, expression) + ";`",
            {},
            false};
    for (const Piece& piece : needless) {
        fix.edits.push_back({draft_.span(piece.begin, piece.end), ""});
        draft_.blank(piece.begin, piece.end);
    }
    diagnostic.fixes.push_back(std::move(fix));
    choices();
    return end;
}

bool StatementRepair::is_braced_expression(std::size_t at) const {
    const std::size_t close = closing_of(text(), at, text().size());
    return close != std::string_view::npos && close - at < 256 &&
           skip_gaps(text(), close + 1) == statement_.end &&
           split(text(), at + 1, close, ',', true).size() == 1 && close > at + 1;
}

void StatementRepair::formals(std::size_t open, std::size_t close) {
    std::size_t index = 0; // index of the formal
    for (const Piece& formal : split(text(), open + 1, close, ',', true)) {
        const std::size_t number = index++;
        const std::string_view first = leading_word(text_of(text(), formal));
        const Piece rest = trimmed(text(), formal.begin + first.size(), formal.end);
        if (first.empty() || rest.empty()) {
            continue;
        }
        const std::string_view name = leading_word(text_of(text(), rest));
        if (is_type(first) && !name.empty()) {
            Diagnostic& diagnostic = report({formal.begin, formal.begin + first.size()},
                                            "parameters have no types: every value is a number");
            add_fix(diagnostic, "write `" + std::string(name) + "`",
                    draft_.span(formal.begin, rest.begin), "", false);
            draft_.blank(formal.begin, rest.begin);
        } else if (char_at(rest.begin) == '=' && text().substr(rest.begin, 2) != "==") {
            const Piece value = trimmed(text(), rest.begin + 1, rest.end);
            Diagnostic& diagnostic = report(rest, "parameters have no default values");
            const std::string use = first_use(open, copy_of(draft_.text, value), number);
            diagnostic.help.push_back("a module has all its parameters at every place" +
                                      (use.empty() ? "" : ": write `" + use + "`"));
            add_fix(diagnostic, "write `" + std::string(first) + "`",
                    draft_.span(formal.begin + first.size(), rest.end), "", false);
            draft_.blank(rest.begin, rest.end);
        } else if (char_at(rest.begin) == ':' &&
                   is_type(stripped(text().substr(rest.begin + 1, rest.end - rest.begin - 1)))) {
            Diagnostic& diagnostic =
                report(rest, "parameters have no types: every value is a number");
            add_fix(diagnostic, "write `" + std::string(first) + "`",
                    draft_.span(rest.begin, rest.end), "", false);
            draft_.blank(rest.begin, rest.end);
        }
    }
}

std::string
StatementRepair::first_use(std::size_t open, const std::string& value, std::size_t count) const {
    std::size_t begin = open;
    while (begin > 0 && is_word_character(char_at(begin - 1))) {
        --begin;
    }
    const std::string name(text().substr(begin, open - begin));
    const std::size_t at = text().find(name + "(");
    if (name.empty() || at == std::string_view::npos || at == begin ||
        (at > 0 && is_word_character(char_at(at - 1)))) {
        return {};
    }
    const std::size_t close = closing_of(text(), at + name.size(), text().size());
    const bool fits = close != std::string_view::npos && close - at <= 64 &&
                      split(text(), at + name.size() + 1, close, ',', true).size() == count;
    return !fits ? std::string() : std::string(text().substr(at, close - at)) + ", " + value + ")";
}

} // namespace lsys::lsys_grammar
