// SPDX-License-Identifier: MIT
#include "grammar/base/characters.h"
#include "grammar/lsys/impl/statement_repair.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

namespace lsys::lsys_grammar {

std::size_t StatementRepair::production() {
    const std::size_t colon = find(':', body_);
    if (colon == std::string_view::npos) {
        return after();
    }
    choices();
    local_values();
    arrow(colon);
    const std::vector<Piece> parts = split(text(), colon + 1, statement_.end, ':', false);
    if (parts.size() >= 2) {
        const std::size_t open = text().find('(', parts[0].begin);
        if (open != std::string_view::npos && open < parts[0].end) {
            const std::size_t close = closing_of(text(), open, parts[0].end);
            if (close != std::string_view::npos) {
                formals(open, close);
            }
        }
    }
    timed_modules();
    if (parts.size() == 3) {
        conditional_successor(colon, parts);
    }
    return after();
}

void StatementRepair::local_values() {
    std::size_t let = find("let", body_);
    while (let != std::string_view::npos &&
           (is_word_character(char_at(let + 3)) || is_word_character(char_at(let - 1)) ||
            char_at(std::min(text().find_last_not_of(kWhitespace, let - 1), let)) != ':')) {
        let = find("let", let + 3);
    }
    if (let == std::string_view::npos) {
        return;
    }
    // Replaces the `;` between local values by `,`, as in `let a = 1; b = 2 :`.
    for (int i = 0; i < 16 && statement_.end < text().size() && char_at(statement_.end) == ';';
         ++i) {
        const bool has_colon =
            text().substr(let, statement_.end - let).find(':') != std::string_view::npos;
        std::size_t next = skip_gaps(text(), statement_.end + 1);
        const std::string_view first = leading_word(text().substr(next));
        if (is_type(first)) {
            next = skip_gaps(text(), next + first.size());
        }
        const std::string_view name = leading_word(text().substr(next));
        const std::size_t sign = skip_gaps(text(), next + name.size());
        const bool is_local =
            !name.empty() && text().substr(sign, 1) == "=" && text().substr(sign, 2) != "==";
        const bool is_end = text().substr(next, 1) == ":";
        if (has_colon || (!is_local && !is_end)) {
            break;
        }
        Diagnostic& diagnostic =
            report({statement_.end, statement_.end + 1},
                   is_end ? "there is no `;` after local values"
                          : "local values are separated by `,`, not by `;`, which ends the "
                            "statement");
        add_fix(diagnostic, is_end ? "remove it" : "write `,`",
                draft_.span(statement_.end, statement_.end + 1), is_end ? "" : ",", false);
        draft_.put(statement_.end, is_end ? ' ' : ',');
        statement_ = statement_at(text(), statement_.begin);
    }
    const std::size_t end = std::min(find(':', let), statement_.end);
    const std::vector<Piece> locals = split(text(), let + 3, end, ',', true);
    unpacked(let, end);
    for (const Piece& local : locals) {
        const std::string_view first = leading_word(text_of(text(), local));
        const std::size_t name = skip_gaps(text(), local.begin + first.size());
        if (name >= local.end || !is_type(first) || !is_letter(char_at(name))) {
            continue;
        }
        Diagnostic& diagnostic = report({local.begin, local.begin + first.size()},
                                        "values have no types: every value is a number");
        add_fix(diagnostic, "write `" + std::string(leading_word(text().substr(name))) + " = ...`",
                draft_.span(local.begin, name), "", false);
        diagnostic.fixes.back().title = "leave the type out";
        draft_.blank(local.begin, name);
    }
}

void StatementRepair::unpacked(std::size_t let, std::size_t end) {
    const std::size_t sign = find('=', let);
    if (sign >= end) {
        return;
    }
    const std::vector<Piece> names = split(text(), let + 3, sign, ',', true);
    const std::vector<Piece> values = split(text(), sign + 1, end, ',', true);
    if (names.size() < 2 || names.size() != values.size()) {
        return;
    }
    std::string plain; // the text that the fix offers
    std::string dense; // the same values without blanks, which fit into their place
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (!is_word(text_of(text(), names[i])) ||
            text_of(text(), values[i]).find('=') != std::string_view::npos) {
            return;
        }
        plain += (i == 0 ? "" : ", ") + copy_of(draft_.text, names[i]) + " = " +
                 copy_of(draft_.text, values[i]);
        dense += (i == 0 ? " " : ",") + copy_of(draft_.text, names[i]) + "=" +
                 copy_of(draft_.text, values[i]);
    }
    const Piece all = trimmed(text(), let + 3, end);
    Diagnostic& diagnostic = report(all, "each local value has its own `=`");
    add_fix(diagnostic, "write `let " + plain + "`", draft_.span(all.begin, all.end), plain, false);
    static_cast<void>(draft_.replace(let + 3, end, dense));
}

void StatementRepair::arrow(std::size_t colon) {
    const std::vector<Piece> parts = split(text(), colon + 1, statement_.end, ':', false);
    if (parts.size() != 2) {
        return;
    }
    int depth = 0;
    for (std::size_t at = parts[1].begin; at < parts[1].end; ++at) {
        const char c = char_at(at);
        depth += c == '(' ? 1 : c == ')' ? -1 : 0;
        if (depth != 0) {
            continue;
        }
        std::size_t length = 0;
        for (const std::string_view sign : {"-->", "==>", "->", "=>"}) {
            length = length == 0 && text().substr(at).starts_with(sign) ? sign.size() : length;
        }
        if (length == 0 && c == '=' && char_at(at + 1) != '=' &&
            std::string_view("=<>!").find(char_at(at - 1)) == std::string_view::npos) {
            length = 1;
        }
        if (length == 0) {
            continue;
        }
        const Piece successor = trimmed(text(), at + length, statement_.end);
        const std::string_view before =
            stripped(text().substr(parts[1].begin, at - parts[1].begin));
        // `t = 1` in a production of three parts is a comparison rather than an arrow.
        if (length == 1 && (successor.empty() || is_digit(char_at(successor.begin)) ||
                            before.find_first_of("<>=") == std::string_view::npos)) {
            continue;
        }
        const std::string sign(text().substr(at, length));
        const std::string replacement = before.empty() ? "* :" : ":";
        Diagnostic& diagnostic = report(
            {at, at + length},
            "`" + sign + "` of " + (length == 1 ? "Houdini" : "cpfg and L-Py") + " is `:` here");
        add_fix(diagnostic, "write `" + replacement + "`", draft_.span(at, at + length),
                replacement, false);
        static_cast<void>(draft_.replace(at, at + length, ":"));
        return;
    }
}

void StatementRepair::timed_modules() {
    const std::size_t colon = text().find(':', body_);
    if (colon == std::string_view::npos || colon >= statement_.end) {
        return;
    }
    Diagnostic* diagnostic = nullptr;
    Fix fix{"", {}, false};
    std::optional<Edit> value_edit; // edit of the condition
    const bool is_production = keyword_ != Keyword::Axiom;
    std::size_t colons = 1;
    bool begins_part = true; // after a `:`, `<`, `>` or repaired module
    for (std::size_t at = colon + 1; at < statement_.end; ++at) {
        const char c = char_at(at);
        if (kWhitespace.find(c) != std::string_view::npos) {
            continue;
        }
        if (c == ':') {
            ++colons;
            begins_part = true;
            continue;
        }
        const bool in_condition = is_production && colons == 2;
        if (c != '(' || !begins_part || in_condition) {
            if (c == '(') {
                const std::size_t close = closing_of(text(), at, statement_.end);
                at = close == std::string_view::npos ? statement_.end : close;
            }
            begins_part = c == '<' || c == '>';
            continue;
        }
        const std::size_t close = closing_of(text(), at, statement_.end);
        if (close == std::string_view::npos) {
            return;
        }
        const std::size_t name = skip_gaps(text(), at + 1);
        const std::string word(leading_word(text().substr(name)));
        const std::size_t comma = skip_gaps(text(), name + word.size());
        if (word.empty() || comma == close || char_at(comma) != ',') {
            return;
        }
        const Piece arguments = comma == close ? Piece{} : trimmed(text(), comma + 1, close);
        const std::string inside = copy_of(draft_.text, arguments);
        const std::string module = inside.empty() ? word : word + "(" + inside + ")";
        if (diagnostic == nullptr) {
            diagnostic =
                &report({at, close + 1}, "the name of a module comes before its parentheses");
        }
        const bool is_head = is_production && colons == 1;
        const bool is_value = is_head && is_number_text(inside);
        fix.edits.push_back({draft_.span(at, close + 1), is_value ? word + "(t)" : module});
        if (is_value) {
            diagnostic->help.push_back("parameters of a predecessor are names, and their value "
                                       "is a condition: `" +
                                       word + "(t) : t >= " + inside + "`");
            diagnostic->help.push_back("ages do not grow by themselves: add `#age_" + word + " : " +
                                       word + "(t) : t < " + inside + " : " + word + "(t + 1);`");
            const std::size_t star = text().find_first_not_of(
                kWhitespace, std::min(text().find(':', close), statement_.end) + 1);
            if (star < statement_.end && char_at(star) == '*') {
                value_edit = Edit{draft_.span(star, star + 1), "t >= " + inside};
            }
        }
        if (value_edit) {
            fix.edits.push_back(*std::exchange(value_edit, std::nullopt));
        }
        static_cast<void>(draft_.replace(at, close + 1, is_value ? word + "(t)" : module));
        at = close;
        begins_part = true;
    }
    if (diagnostic != nullptr) {
        fix.title = "write `" + fix.edits.front().replacement + "`";
        diagnostic->fixes.push_back(std::move(fix));
    }
}

void StatementRepair::conditional_successor(std::size_t colon, const std::vector<Piece>& parts) {
    const std::size_t at = parts[2].begin;
    if (leading_word(text().substr(at)) != "if" || at + 2 >= statement_.end) {
        return;
    }
    const std::size_t open = skip_gaps(text(), at + 2);
    const std::size_t close =
        char_at(open) == '(' ? closing_of(text(), open, statement_.end) : std::string_view::npos;
    if (close == std::string_view::npos) {
        return;
    }
    const std::size_t brace = skip_gaps(text(), close + 1);
    const bool has_brace = char_at(brace) == '{';
    std::size_t end =
        has_brace ? closing_of(text(), brace, statement_.end) : std::string_view::npos;
    if (end == std::string_view::npos) {
        return;
    }
    const std::string label(stripped(text().substr(statement_.begin, colon - statement_.begin)));
    const std::string head = copy_of(draft_.text, parts[0]);
    const std::string condition = copy_of(draft_.text, trimmed(text(), open + 1, close));
    const auto production = [&](const std::string& suffix, const std::string& test, Piece body) {
        return label + suffix + " : " + head + " : " + test + " : " + copy_of(draft_.text, body) +
               ";";
    };
    Diagnostic& diagnostic =
        report({at, at + 2}, "a successor holds modules and no `if`: the condition of a "
                             "production chooses");
    std::string first = production("a", condition, trimmed(text(), brace + 1, end));
    std::size_t next = skip_gaps(text(), end + 1);
    std::string second;
    if (leading_word(text().substr(next)) == "else") {
        next = skip_gaps(text(), next + 4);
        const std::size_t last = next < statement_.end && char_at(next) == '{'
                                     ? closing_of(text(), next, statement_.end)
                                     : std::string_view::npos;
        if (last != std::string_view::npos) {
            second = production("b", "*", trimmed(text(), next + 1, last));
        }
    }
    if (second.empty()) {
        second = production("b", "*", {});
    }
    const std::size_t after_all = after();
    add_fix(diagnostic, "write two productions", draft_.span(statement_.begin, after_all),
            first + "\n" + second, false);
    leave_out();
}

} // namespace lsys::lsys_grammar
