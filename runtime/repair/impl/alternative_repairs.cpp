// SPDX-License-Identifier: MIT
#include "runtime/repair/impl/alternative_repairs.h"

#include "grammar/ast/ast_dump.h"
#include "grammar/base/characters.h"
#include "grammar/lsys/parse.h"

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <utility>

namespace lsys::repair {

namespace {

/// The result of parsing a statement without errors.
struct ParsedStatement {
    std::string tree; // dump of the syntax tree, which leaves out redundant parentheses
    std::size_t redundant_groups = 0; // number of pairs of redundant parentheses
};

/// The text of the statement `#set names` of a file; empty if there is none.
std::string find_names_setting(std::string_view text) {
    for (std::size_t at = text.find("#set"); at != std::string_view::npos;
         at = text.find("#set", at + 1)) {
        const std::string_view rest = text.substr(at, std::min<std::size_t>(text.size() - at, 200));
        const std::size_t key = rest.find_first_not_of(kWhitespace, 4);
        if (key != std::string_view::npos && rest.substr(key, 5) == "names") {
            const std::string_view setting = rest.substr(0, rest.find(';'));
            return std::string(setting) + ";\n";
        }
    }
    return {};
}

/// Number of pairs of parentheses around a single value. They make a repair less plausible.
std::size_t count_redundant_groups(const Ast& ast) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < ast.expressions.size(); ++i) {
        const Expression& group = ast.expressions[i];
        if (group.kind == ExpressionKind::Grouping) {
            const ExpressionKind inner = ast.expression(group.left).kind;
            count += inner == ExpressionKind::Number || inner == ExpressionKind::Name ||
                             inner == ExpressionKind::Call || inner == ExpressionKind::Grouping ||
                             inner == ExpressionKind::Range
                         ? 1u
                         : 0u;
        }
    }
    return count;
}

std::optional<ParsedStatement> parse_statement(const std::string& setting,
                                               std::string_view statement) {
    SourceMap sources;
    Names names;
    Diagnostics diagnostics;
    const FileLoader load = [](const std::string& path) -> Result<std::string> {
        return Error{"`" + path + "` is not read here"};
    };
    const FileId file = sources.add("statement", setting + std::string(statement));
    const Ast ast = parse_lsys(file, {sources, names, diagnostics, load});
    if (diagnostics.has_errors()) {
        return std::nullopt;
    }
    return ParsedStatement{dump_ast(ast, names, sources), count_redundant_groups(ast)};
}

/// Quick test before parsing: false for unbalanced parentheses and for `)(`, which never parse.
bool may_parse(std::string_view text) {
    std::int64_t open = 0;
    char before = '\0';
    for (const char c : text) {
        if (c == ' ' || c == '\t' || c == '\r' || c == '\n') {
            continue;
        }
        open += c == '(' ? 1 : c == ')' ? -1 : 0;
        if (open < 0 || (c == '(' && before == ')')) {
            return false;
        }
        before = c;
    }
    return open == 0;
}

/// Whether a text has as many `[` as `]`, and as many `{` as `}`.
bool has_balanced_modules(std::string_view text) {
    return std::count(text.begin(), text.end(), '[') == std::count(text.begin(), text.end(), ']') &&
           std::count(text.begin(), text.end(), '{') == std::count(text.begin(), text.end(), '}');
}

/// Whether a number follows `place`, where a comma was added. If so, no `*` can be missing at
/// `place`.
bool is_before_number(std::string_view text, std::size_t place) {
    const std::size_t next = text.find_first_not_of(kWhitespace, place);
    return next != std::string_view::npos &&
           ((text[next] >= '0' && text[next] <= '9') || text[next] == '.');
}

bool is_bracket(char c) {
    return std::string_view("()[]{}").find(c) != std::string_view::npos;
}

bool is_number_part(char c) {
    return (c >= '0' && c <= '9') || c == '.';
}

/// If the blank at the place of a missing comma splits a number, adds the text without the blank
/// and the text with a `.` in its place.
void add_joined_numbers(const StatementRepair& repair, std::vector<std::string>& texts) {
    const std::string_view text = repair.broken;
    const std::size_t begin = repair.place;
    const std::size_t end = text.find_first_not_of(kWhitespace, begin);
    if (begin == 0 || end == std::string_view::npos || end == begin ||
        !is_number_part(text[begin - 1]) || !is_number_part(text[end])) {
        return;
    }
    for (const std::string_view joint : {"", "."}) {
        texts.emplace_back(text);
        texts.back().replace(begin, end - begin, joint);
    }
}

/// Adds the texts without the word before and without the word after a missing comma, for words of
/// one character, which may have been typed by mistake.
void add_without_letters(const StatementRepair& repair, std::vector<std::string>& texts) {
    const std::string_view text = repair.broken;
    const std::size_t before = repair.place;
    const std::size_t after = text.find_first_not_of(kWhitespace, before);
    const auto remove = [&](std::size_t at) {
        const bool is_alone = is_word_character(text[at]) &&
                              (at == 0 || !is_word_character(text[at - 1])) &&
                              (at + 1 == text.size() || !is_word_character(text[at + 1]));
        if (is_alone) {
            texts.emplace_back(text);
            texts.back().erase(at, 1);
        }
    };
    if (before > 0) {
        remove(before - 1);
    }
    if (after != std::string_view::npos) {
        remove(after);
    }
}

/// Whether the parenthesis at `at` may be a mistyped digit or name: `)` after a digit, as in
/// `/(6))`, or after `(`, as in `F())`, or `(` between blanks, as in `a - ( - b`, or between a
/// blank and a digit, as in `= (6`, but not in `(0.5`.
bool may_be_value(std::string_view text, std::size_t at) {
    const char before = at == 0 ? ' ' : text[at - 1];
    const char after = at + 1 == text.size() ? ' ' : text[at + 1];
    if (text[at] == ')') {
        return is_number_part(before) || before == '(';
    }
    return text[at] == '(' && before == ' ' &&
           (after == ' ' || (is_number_part(after) && text.substr(at + 1, 2) != "0."));
}

std::vector<std::string> bracket_repairs(std::string_view broken, bool is_single) {
    constexpr std::string_view kOpening = "([{";
    constexpr std::string_view kClosing = ")]}";
    std::vector<std::string> texts;
    const auto add = [&](std::size_t at, std::size_t length, std::string_view replacement) {
        std::string text(broken);
        text.replace(at, length, replacement);
        if (may_parse(text)) {
            texts.push_back(std::move(text));
        }
    };
    for (std::size_t at = 0; at <= broken.size(); ++at) {
        // Unlike other brackets, `(` is also tried inside a word: `Fsin(x))` for `F(sin(x))`.
        add(at, 0, "(");
        const bool is_in_word = at > 0 && at < broken.size() && is_word_character(broken[at - 1]) &&
                                is_word_character(broken[at]);
        for (const std::string_view inserted : {")", "{", "}"}) {
            if (!is_in_word) {
                add(at, 0, inserted);
            }
        }
        if (at == broken.size()) {
            break;
        }
        const bool is_pair = at + 1 < broken.size() && broken[at] != broken[at + 1] &&
                             is_bracket(broken[at]) && is_bracket(broken[at + 1]);
        if (is_pair) {
            add(at, 2, std::string{broken[at + 1], broken[at]});
        }
        // An opening bracket is removed only after an equal one or an operator of comparison,
        // before `;` or at the end.
        const std::size_t next = broken.find_first_not_of(kWhitespace, at + 1);
        const bool is_removable =
            (at > 0 && (broken[at - 1] == broken[at] ||
                        std::string_view("<>=").find(broken[at - 1]) != std::string_view::npos)) ||
            next == std::string_view::npos || broken[next] == ';';
        if (is_single && may_be_value(broken, at)) {
            add(at, 1, "1");
        }
        if (broken[at] == ')' || broken[at] == '}' ||
            ((broken[at] == '(' || broken[at] == '{') && is_removable)) {
            add(at, 1, "");
        }
        for (const std::string_view direction : {kOpening, kClosing}) {
            if (direction.find(broken[at]) != std::string_view::npos) {
                for (std::size_t i = 0; i < direction.size(); ++i) {
                    add(at, 1, direction.substr(i, 1));
                }
            }
        }
    }
    return texts;
}

} // namespace

bool may_have_alternatives(DiagnosticCode code) {
    return code == DiagnosticCode::UnclosedParenthesis ||
           code == DiagnosticCode::ExtraParenthesis || code == DiagnosticCode::BadRange ||
           code == DiagnosticCode::MissingComma;
}

std::vector<std::string> alternative_repairs(const StatementRepair& repair) {
    if (repair.broken.size() > kMaxComparedStatement) {
        return {};
    }
    const std::string setting = find_names_setting(repair.file_text);
    const std::optional<ParsedStatement> proposed = parse_statement(setting, repair.repaired);
    std::vector<std::string> texts;
    if (repair.code == DiagnosticCode::MissingComma) {
        // The mistake may also be a missing `*` in place of the comma.
        if (!is_before_number(repair.broken, repair.place)) {
            texts.emplace_back(repair.broken);
            texts.back().insert(repair.place, " * ");
        }
        add_joined_numbers(repair, texts);
        add_without_letters(repair, texts);
    } else {
        texts = bracket_repairs(repair.broken, repair.is_single);
    }
    const bool is_balanced = has_balanced_modules(repair.repaired);
    std::set<std::string> trees;
    std::vector<std::string> others;
    for (std::string& text : texts) {
        if (is_balanced && !has_balanced_modules(text)) {
            continue;
        }
        std::optional<ParsedStatement> parsed = parse_statement(setting, text);
        if (parsed && proposed &&
            (parsed->tree == proposed->tree ||
             parsed->redundant_groups > proposed->redundant_groups)) {
            continue;
        }
        if (parsed && trees.insert(std::move(parsed->tree)).second) {
            others.push_back(std::move(text));
        }
    }
    return others;
}

} // namespace lsys::repair
