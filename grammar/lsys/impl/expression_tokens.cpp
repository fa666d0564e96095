// SPDX-License-Identifier: MIT
#include "grammar/lsys/impl/expression_tokens.h"

#include "grammar/ast/number.h"
#include "grammar/ast/reports.h"
#include "grammar/base/characters.h"
#include "grammar/base/contract.h"
#include "grammar/base/synonyms.h"
#include "grammar/lsys/impl/bracket_search.h"
#include "grammar/lsys/impl/lookahead.h"
#include "grammar/lsys/impl/missing_colon.h"
#include "grammar/lsys/impl/statement_insertions.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>

namespace lsys::lsys_grammar {

namespace {

/// Whether the text has digit groups as in other languages: `1_000`.
bool has_digit_groups(std::string_view text) {
    const std::size_t group = text.find('_');
    return group != std::string_view::npos && group > 0 && group + 1 < text.size() &&
           is_digit(text[group - 1]) && is_digit(text[group + 1]);
}

/// Whether all digit groups have three digits, the first one at most three.
bool has_groups_of_three(std::string_view text) {
    std::size_t digit_count = 0;
    bool is_first = true;
    for (std::size_t i = 0; i <= text.size(); ++i) {
        if (i < text.size() && is_digit(text[i])) {
            ++digit_count;
        } else if (digit_count == 0 || digit_count > 3 || (!is_first && digit_count != 3) ||
                   (i < text.size() && text[i] != '_')) {
            return false;
        } else {
            is_first = false;
            digit_count = 0;
        }
    }
    return true;
}

} // namespace

namespace {

/// Whether the `%` at `at` ends a percentage: no operand follows it.
bool ends_percentage(std::string_view text, std::size_t at) {
    const char next = next_character(text, static_cast<std::uint32_t>(at) + 1);
    return next == '\0' || std::string_view(":;),~}&|").find(next) != std::string_view::npos;
}

/// A number as authors write it, without trailing zeros.
std::string number_text(double value) {
    std::string text = std::to_string(value);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.ends_with('.')) {
        text.pop_back();
    }
    return text;
}

/// Reports `50%` and returns its value; nullopt if the current number is not a percentage.
std::optional<float> percentage(ParseSession& session, std::string_view text) {
    const ScanState& scan = session.scan;
    const std::string_view all = session.scanned.text;
    const std::size_t at = all.find_first_not_of(" \t", scan.end);
    const bool in_expression = scan.part == Part::Condition || scan.part == Part::Probability ||
                               scan.part == Part::Value || !scan.open.empty();
    if (!in_expression || at == std::string_view::npos || all[at] != '%' ||
        !ends_percentage(all, at)) {
        return std::nullopt;
    }
    const double value = static_cast<double>(read_literal(text).value) / 100.0;
    if (session.wants(DiagnosticCode::MalformedNumber)) {
        const SourceSpan span =
            session.scanned.span(scan.begin, static_cast<std::uint32_t>(at) + 1);
        Diagnostic& diagnostic =
            session.report(DiagnosticCode::MalformedNumber, span,
                           scan.part == Part::Condition || scan.part == Part::Probability
                               ? "there are no percentages: a probability is a number from 0 to 1"
                               : "there are no percentages");
        // If the percentage is the whole condition, its `~` is missing as well.
        const bool lacks_tilde = scan.part == Part::Condition && scan.open.empty() &&
                                 all.substr(scan.part_begin, scan.begin - scan.part_begin)
                                         .find_first_not_of(kWhitespace) == std::string_view::npos;
        const std::string replacement = (lacks_tilde ? "* ~ " : "") + number_text(value);
        add_fix(diagnostic, "write `" + replacement + "`", span, replacement, false);
    }
    return static_cast<float>(value);
}

/// A unit of measure and its length in metres; 0 for units of other quantities.
struct Unit {
    std::string_view word;
    double metres;
};
constexpr std::array<Unit, 22> kUnits{{
    {"cm", 0.01},   {"mm", 0.001},  {"km", 1000},       {"metres", 1},      {"meters", 1},
    {"metre", 1},   {"meter", 1},   {"inch", 0.0254},   {"inches", 0.0254}, {"deg", 0},
    {"degree", 0},  {"degrees", 0}, {"years", 0},       {"year", 0},        {"days", 0},
    {"weeks", 0},   {"months", 0},  {"generations", 0}, {"iterations", 0},  {"times", 0},
    {"percent", 0}, {"px", 0},
}};

const Unit* find_unit(std::string_view word) {
    const auto* const found = std::find_if(kUnits.begin(), kUnits.end(),
                                           [&](const Unit& unit) { return unit.word == word; });
    return found == kUnits.end() ? nullptr : found;
}

/// The number at the end of `text`, `2.5e-3` in `F(2.5e-3`; empty if there is none, as in `1..5`.
std::string_view trailing_number(std::string_view text) {
    const std::size_t before = text.find_last_not_of("0123456789.eE+-");
    for (std::size_t begin = before == std::string_view::npos ? 0 : before + 1; begin < text.size();
         ++begin) {
        const char last = begin > 0 ? text[begin - 1] : ' ';
        const std::string_view number = text.substr(begin);
        if (last != '.' && !is_word_character(last) && literal_length(number) == number.size()) {
            return number;
        }
    }
    return {};
}

/// Explains a number that a unit follows.
void explain_unit(Diagnostic& diagnostic,
                  std::string_view number,
                  const Unit& unit,
                  SourceSpan whole) {
    double value = static_cast<double>(read_literal(number).value);
    value *= unit.metres == 0 ? 1.0 : unit.metres;
    value /= unit.word == "percent" ? 100.0 : 1.0;
    const std::string text =
        unit.metres == 0 && unit.word != "percent" ? std::string(number) : number_text(value);
    if (unit.metres != 0) {
        diagnostic.help.emplace_back("lengths are in metres, or in another unit that is the same "
                                     "everywhere");
    }
    add_fix(diagnostic, "write `" + text + "`", whole, text, false);
}

} // namespace

bool is_percent_sign(const ParseSession& session) {
    const std::string_view text = session.scanned.text;
    return session.scan.value_before && is_digit(character_before(text, session.scan.begin)) &&
           ends_percentage(text, session.scan.begin);
}

bool report_unit_word(ParseSession& session, std::string_view word) {
    const ScanState& scan = session.scan;
    const std::string_view text = session.scanned.text;
    const Unit* const unit = find_unit(word);
    if (!scan.value_before || scan.name_before || unit == nullptr || scan.last_end == 0 ||
        !(is_digit(text[scan.last_end - 1]) || text[scan.last_end - 1] == '.') ||
        next_character(text, scan.end) == '(') {
        return false;
    }
    if (session.wants(DiagnosticCode::MalformedNumber)) {
        const std::string_view number = trailing_number(text.substr(0, scan.last_end));
        Diagnostic& diagnostic =
            session.report(DiagnosticCode::MalformedNumber, "numbers have no unit");
        if (!number.empty()) {
            const auto length = static_cast<std::uint32_t>(number.size());
            explain_unit(diagnostic, number, *unit,
                         session.scanned.span(scan.last_end - length, scan.end));
        }
    }
    return true;
}

namespace {

std::string_view without_line_ends(std::string_view text) {
    return text.substr(0, text.find_first_of("\r\n"));
}

} // namespace

Token foreign_value(ParseSession& session, std::string_view text) {
    ScanState& scan = session.scan;
    if (session.wants(DiagnosticCode::UnknownName)) {
        const bool is_call = text.ends_with(')');
        const std::string_view name = is_call ? leading_word(text) : text;
        const Synonym* const synonym =
            find_synonym(is_call ? SynonymKind::Function : SynonymKind::Name, name);
        Diagnostic& diagnostic = session.report(
            DiagnosticCode::UnknownName,
            is_call ? "there is no function `" + std::string(name) + "`, and no text in expressions"
                    : "there is no variable `" + std::string(text) + "`");
        if (synonym != nullptr) {
            diagnostic.help.push_back(help_for(*synonym, name));
            if (synonym->spelling == "step()") {
                add_fix(diagnostic, "write `step()`", diagnostic.span, "step()", false);
            }
        } else if (!is_call) {
            diagnostic.help.emplace_back("the age of the word is `step()`, and the values of a "
                                         "module are its parameters");
        }
        const std::string_view all = session.scanned.text;
        const std::string statement(
            without_line_ends(all.substr(scan.statement_begin, scan.begin - scan.statement_begin)));
        const bool is_frame = synonym != nullptr && synonym->spelling.empty() && !is_call;
        diagnostic.help.push_back(
            is_frame ? "the age of the word is `step()`"
            : scan.part == Part::Setting
                ? "write a number, `" + statement +
                      "25;`, or one that is set from outside: `#param " +
                      "VALUE 25 {0, 90};` and `" + statement + "VALUE;`"
                : std::string("a value that is set from outside is `#param NAME 1 {0, 10};`, and "
                              "`-D NAME=2` on the command line"));
    }
    const SourceSpan span = session.token();
    scan.value_before = true;
    scan.name_before = false;
    return Token(Parser::token::TOK_BAD_VALUE, span);
}

bool report_compound_assignment(ParseSession& session) {
    const ScanState& scan = session.scan;
    const std::string_view text = session.scanned.text;
    const char before = scan.begin == 0 ? '\0' : text[scan.begin - 1];
    if (scan.open.empty() || scan.last_end != scan.begin ||
        std::string_view("+-*/").find(before) == std::string_view::npos) {
        return false;
    }
    if (session.wants(DiagnosticCode::AssignmentInExpression)) {
        Diagnostic& diagnostic = session.report(
            DiagnosticCode::AssignmentInExpression, session.scanned.span(scan.begin - 1, scan.end),
            std::string("there is no `") + before + "=`: the new value is written");
        add_fix(diagnostic, std::string("write `") + before + "`", session.match(), "", false);
    }
    return true;
}

void report_quoted_expression(ParseSession& session) {
    if (!session.wants(DiagnosticCode::SyntaxError)) {
        return;
    }
    const ScanState& scan = session.scan;
    const std::string_view text = session.scanned.text;
    Diagnostic& diagnostic =
        session.report(DiagnosticCode::SyntaxError, "expressions have no back quotes");
    const std::size_t close = text.find_first_of("`\n", scan.end);
    if (close != std::string_view::npos && text[close] == '`') {
        const auto end = static_cast<std::uint32_t>(close);
        diagnostic.fixes.push_back(
            {"write `" + std::string(text.substr(scan.end, end - scan.end)) + "`",
             {{session.match(), ""}, {session.scanned.span(end, end + 1), ""}},
             false});
    }
}

Token number(ParseSession& session, std::string_view text, SourceSpan span) {
    if (const std::optional<float> value = percentage(session, text)) {
        return Token(Parser::token::TOK_NUMBER, *value, span);
    }
    const Literal literal = read_literal(text);
    if (literal.range != LiteralRange::Normal && session.wants_reports()) {
        report_literal_range(session.context.diagnostics, literal, text, span);
    }
    if (literal.range == LiteralRange::Overflow) {
        return Token(Parser::token::TOK_BAD_VALUE, span);
    }
    return Token(Parser::token::TOK_NUMBER, literal.value, span);
}

void report_malformed_number(ParseSession& session, std::string_view text, SourceSpan span) {
    if (!session.wants(DiagnosticCode::MalformedNumber)) {
        return;
    }
    Diagnostic& diagnostic = session.report(DiagnosticCode::MalformedNumber, span,
                                            "`" + shown(text) + "` is not a number");
    const std::size_t length = literal_length(text);
    const std::string_view rest = text.substr(length);
    if (const Unit* const unit = find_unit(rest)) {
        diagnostic.message = "numbers have no unit";
        explain_unit(diagnostic, text.substr(0, length), *unit, span);
        return;
    }
    if (rest == "f" || rest == "F") {
        // `2f` may be a product, `2.0f` is a number of C.
        add_fix(diagnostic, "numbers have no suffix; remove it",
                {span.file, span.end - 1, span.end}, "",
                text.substr(0, length).find('.') != std::string_view::npos);
    } else if (has_digit_groups(text)) {
        std::string digits(text);
        std::erase(digits, '_');
        if (literal_length(digits) == digits.size()) {
            add_fix(diagnostic, "numbers are written without `_`", span, digits,
                    has_groups_of_three(text));
        }
    } else if (text.starts_with("0x") || text.starts_with("0X")) {
        diagnostic.help.emplace_back("there are no hexadecimal numbers");
    }
    diagnostic.help.emplace_back("numbers are written `3`, `3.14`, `.5`, `1.` or `1e-3`");
}

std::size_t number_before_name(std::string_view text) {
    const std::size_t length = literal_length(text);
    const std::string_view name = text.substr(length);
    if (length == 0 || name.empty() || (name[0] >= '0' && name[0] <= '9') ||
        name.find('.') != std::string_view::npos) {
        return 0;
    }
    // `1e`, `1f`, `1e5F` and `0x10` are numbers of other languages.
    const bool is_suffix = name == "f" || name == "F" || name == "e" || name == "E";
    const bool is_hexadecimal =
        text.substr(0, length) == "0" && (name[0] == 'x' || name[0] == 'X') && name.size() > 1;
    const bool has_group = name.size() > 1 && name[0] == '_' && is_digit(name[1]);
    const bool has_exponent = text.substr(0, length).find_first_of("eE") != std::string_view::npos;
    return is_suffix || is_hexadecimal || has_group || has_exponent ? 0 : length;
}

namespace {

/// The word that ends at `end` if it is `if`, `then` or `else`.
std::optional<TextRange> conditional_word(std::string_view text, std::uint32_t end) {
    std::uint32_t begin = end;
    while (begin > 0 && is_word_character(text[begin - 1])) {
        --begin;
    }
    const std::string_view word = text.substr(begin, end - begin);
    return word == "if" || word == "then" || word == "else" ? std::optional(TextRange{begin, end})
                                                            : std::nullopt;
}

void report_conditional(ParseSession& session, TextRange word) {
    if (session.wants(DiagnosticCode::SyntaxError)) {
        Diagnostic& diagnostic =
            session.report(DiagnosticCode::SyntaxError, session.scanned.span(word.begin, word.end),
                           "a conditional value is written `if(condition, a, b)`");
        diagnostic.help.emplace_back("it is `a` where the condition holds, else `b`");
    }
}

/// Whether a comma is the certain fix between two values. False if several blanks separate the
/// values, since an operator may have stood there, or if the values are equal, since one may be a
/// repetition.
bool lacks_comma(std::string_view text,
                 std::uint32_t before_end,
                 std::uint32_t begin,
                 std::uint32_t end) {
    const std::string_view gap = text.substr(before_end, begin - before_end);
    const std::string_view value = text.substr(begin, end - begin);
    const std::string_view before = text.substr(0, before_end);
    return (gap == " " || gap.find('\n') != std::string_view::npos) &&
           !(before.ends_with(value) &&
             (before.size() == value.size() ||
              !is_word_character(before[before.size() - value.size() - 1])));
}

/// Whether `text` is a condition: a comparison outside of parentheses, or `*`.
bool is_condition(std::string_view text) {
    int depth = 0;
    for (std::size_t at = 0; at < text.size(); ++at) {
        const char c = text[at];
        depth += c == '(' ? 1 : c == ')' ? -1 : 0;
        if (depth == 0 && (c == '>' || c == '<' || c == '=')) {
            return true;
        }
    }
    return text.find_first_not_of(" \t\r\n*") == std::string_view::npos && !text.empty();
}

/// Reports a production whose successor stands before its condition.
bool report_exchanged_parts(ParseSession& session) {
    ScanState& scan = session.scan;
    const std::string_view text = session.scanned.text;
    if (scan.part != Part::Condition || !scan.open.empty() ||
        scan.bracket_searches++ >= kMaxBracketSearches) {
        return false;
    }
    const std::size_t colon = text.find_first_of(":;#", scan.begin);
    if (colon == std::string_view::npos || text[colon] != ':') {
        return false;
    }
    const std::size_t end = text.find_first_of(":;#~", colon + 1);
    if (end == std::string_view::npos || text[end] == ':' || text[end] == '#') {
        return false;
    }
    const std::size_t stop = std::min(text.find(';', end), text.size());
    const std::string_view first = text.substr(scan.part_begin, colon - scan.part_begin);
    const std::string_view second = text.substr(colon + 1, end - colon - 1);
    if (!is_condition(second) || is_condition(first)) {
        return false;
    }
    if (session.wants(DiagnosticCode::SyntaxError)) {
        const auto trimmed = [&](std::size_t from, std::size_t to) {
            const std::size_t begin = text.find_first_not_of(kWhitespace, from);
            const std::size_t last = text.find_last_not_of(kWhitespace, to - 1);
            return session.scanned.span(static_cast<std::uint32_t>(begin),
                                        static_cast<std::uint32_t>(last) + 1);
        };
        const SourceSpan successor = trimmed(scan.part_begin, colon);
        const SourceSpan condition = trimmed(colon + 1, stop);
        Diagnostic& diagnostic = session.report(DiagnosticCode::SyntaxError, successor,
                                                "the successor is before the condition");
        diagnostic.labels.push_back({condition, "this is the condition"});
        if (successor.begin < successor.end && condition.begin < condition.end) {
            diagnostic.fixes.push_back(
                {"exchange them",
                 {{successor, std::string(session.context.sources.text(condition))},
                  {condition, std::string(session.context.sources.text(successor))}},
                 false});
        }
    }
    return true;
}

/// Reports a name without its `(`: values follow the name, and a later `)` closes nothing.
bool report_lost_open(ParseSession& session) {
    ScanState& scan = session.scan;
    if (!scan.name_before || scan.bracket_searches++ >= kMaxBracketSearches) {
        return false;
    }
    std::uint32_t at = scan.begin;
    for (std::size_t level = 0; level <= scan.open.size(); ++level) {
        const std::optional<std::uint32_t> close = unmatched_parenthesis(session.scanned.text, at);
        if (!close) {
            return false;
        }
        at = *close + 1;
    }
    if (session.wants(DiagnosticCode::ExtraParenthesis)) {
        const SourceSpan place = session.insertion_place();
        Diagnostic& diagnostic =
            session.report(DiagnosticCode::ExtraParenthesis, session.scanned.span(at - 1, at),
                           "`)` closes no `(`");
        diagnostic.labels.push_back({place, "a `(` may be missing here"});
        add_fix(diagnostic, "add `(`", place, "(", false);
    }
    return true;
}

/// Reports the arguments of a module that lack their `)`: the current value belongs to the next
/// module.
bool report_lost_close(ParseSession& session) {
    ScanState& scan = session.scan;
    if (scan.open.empty() || scan.open.front().kind != OpenBracket::Kind::Module ||
        scan.open_braces != 0 || scan.bracket_searches++ >= kMaxBracketSearches) {
        return false;
    }
    const std::size_t end = session.scanned.text.find(';', scan.begin);
    if (end == std::string_view::npos || end - scan.begin > kMaxSearchedBytes) {
        return false;
    }
    std::uint32_t at = scan.begin;
    for (std::size_t level = 0; level < scan.open.size(); ++level) {
        const std::optional<std::uint32_t> close = unmatched_parenthesis(session.scanned.text, at);
        if (!close) {
            break;
        }
        if (level + 1 == scan.open.size()) {
            return false;
        }
        at = *close + 1;
    }
    if (session.wants(DiagnosticCode::UnclosedParenthesis)) {
        const std::uint32_t open = scan.open.back().begin;
        Diagnostic& diagnostic =
            session.report(DiagnosticCode::UnclosedParenthesis,
                           session.scanned.span(open, open + 1), "`(` is never closed");
        diagnostic.labels.push_back({session.match(), "this begins another value"});
        add_fix(diagnostic, "add `)`", session.insertion_place(), ")", false);
    }
    return true;
}

/// Reports `#define f(x) ...`, a macro of other languages.
bool report_macro(ParseSession& session) {
    const ScanState& scan = session.scan;
    const std::string_view text = session.scanned.text;
    if (scan.keyword != Keyword::Define || !scan.open.empty() || text[scan.last_end - 1] != ')') {
        return false;
    }
    const std::string_view written =
        text.substr(scan.statement_begin, scan.last_end - scan.statement_begin);
    const std::size_t open = written.find('(');
    const std::size_t close = written.find(')');
    if (open == 0 || open == std::string_view::npos || close + 1 != written.size() ||
        !is_word_character(written[open - 1])) {
        return false;
    }
    if (session.wants(DiagnosticCode::SyntaxError)) {
        Diagnostic& diagnostic = session.report(
            DiagnosticCode::SyntaxError,
            session.scanned.span(scan.statement_begin + static_cast<std::uint32_t>(open),
                                 scan.last_end),
            "a constant has no parameters");
        diagnostic.help.emplace_back("`#define NAME expr;` names a value that is the same "
                                     "everywhere");
        if (find_keyword("function") != Keyword::Label) {
            add_fix(diagnostic, "functions are `#function`",
                    session.scanned.span(scan.statement_begin, scan.statement_begin + 7),
                    "#function", false);
        }
    }
    return true;
}

/// Whether the current name begins a local value, `b = 2`, without a `,` before it.
bool begins_next_local(const ParseSession& session) {
    const ScanState& scan = session.scan;
    const std::string_view text = session.scanned.text;
    std::uint32_t end = scan.begin;
    while (end < text.size() && is_word_character(text[end])) {
        ++end;
    }
    const std::size_t sign = text.find('=', end);
    return scan.part == Part::Locals && scan.open.empty() && next_character(text, end) == '=' &&
           text.substr(sign, 2) != "==";
}

/// Reports two values without an operator between them. Returns the operator or `,` that is most
/// likely missing, or discards the statement.
Token between_values(ParseSession& session) {
    ScanState& scan = session.scan;
    if (report_macro(session) || report_exchanged_parts(session) || report_lost_open(session) ||
        report_lost_close(session)) {
        return discard_statement(session);
    }
    scan.after_operator();
    const SourceSpan place = session.insertion_place();
    const std::string_view text = session.scanned.text;
    const bool begins_local = begins_next_local(session);
    const bool in_list =
        begins_local || (!scan.open.empty() && scan.open.back().kind != OpenBracket::Kind::Group);
    const bool adjacent = scan.begin == scan.last_end;
    for (const std::uint32_t word_end : {scan.last_end, scan.end}) {
        if (const std::optional<TextRange> word = conditional_word(text, word_end)) {
            report_conditional(session, *word);
            return discard_statement(session);
        }
    }
    if (!in_list && report_missing_colon(session, "")) {
        return discard_statement(session);
    }
    if (in_list && !adjacent) {
        if (session.wants(DiagnosticCode::MissingComma)) {
            Diagnostic& diagnostic = session.report(DiagnosticCode::MissingComma, place,
                                                    "two values without a `,` between them");
            add_fix(diagnostic, "add `,`", place, ",",
                    lacks_comma(text, scan.last_end, scan.begin, scan.end));
        }
        if (begins_local) {
            scan.next_in_locals = NextInLocals::Name;
        }
        return Token(Parser::token::TOK_COMMA, place).as_inserted();
    }
    const bool joins_conditions = scan.part == Part::Condition && scan.open.empty() && !adjacent;
    if (session.wants(DiagnosticCode::MissingOperator)) {
        Diagnostic& diagnostic = session.report(DiagnosticCode::MissingOperator, place,
                                                "two values without an operator between them");
        if (adjacent) {
            // `2x` is a product in mathematics, but may as well lack another operator: `2/x`.
            add_fix(diagnostic, "a product is written with `*`", place, "*", false);
        } else {
            std::uint32_t end = scan.end;
            while (end < text.size() && is_word_character(text[end])) {
                ++end;
            }
            const std::string_view word = text.substr(scan.begin, end - scan.begin);
            diagnostic.labels.push_back({session.match(), "this begins another value"});
            const Synonym* const synonym = find_synonym(SynonymKind::Operator, word);
            diagnostic.help.push_back(synonym != nullptr ? help_for(*synonym, word)
                                      : joins_conditions
                                          ? "two conditions are joined with `&&` or `||`"
                                          : "a product is written with `*`");
        }
    }
    return (joins_conditions ? Token(Parser::token::TOK_AND, place)
                             : Token(Parser::token::TOK_STAR, place))
        .as_inserted();
}

} // namespace

Token insert_before_value(ParseSession& session) {
    Token token = between_values(session);
    session.scan.end = session.scan.begin;
    return token;
}

bool begins_bounds(const ScanState& scan) {
    return scan.value_before && scan.part == Part::Value && scan.keyword == Keyword::Param &&
           scan.open.empty();
}

namespace {

/// Reports a `)` or `}` that closes nothing, or a `}` in place of the `)` of the innermost `(`.
void report_closing(ParseSession& session, char character, bool is_doubled, bool for_parenthesis) {
    const bool is_brace = character == '}';
    const auto code = is_brace ? DiagnosticCode::BadRange : DiagnosticCode::ExtraParenthesis;
    if (!session.wants(code)) {
        return;
    }
    Diagnostic& diagnostic =
        session.report(code, is_brace ? "`}` closes no `{`" : "`)` closes no `(`");
    if (for_parenthesis) {
        const std::uint32_t open = session.scan.open.back().begin;
        diagnostic.labels.push_back(
            {session.scanned.span(open, open + 1), "this `(` is still open"});
        add_fix(diagnostic, "write `)`", diagnostic.span, ")", true);
    } else if (is_doubled) {
        add_fix(diagnostic, "remove it", diagnostic.span, "", true);
    } else {
        diagnostic.help.emplace_back(is_brace ? "write the `{` that it closes, or remove it"
                                              : "write the `(` that it closes, or remove it");
    }
}

} // namespace

std::optional<Token> closing_bracket(ParseSession& session, char character) {
    ScanState& scan = session.scan;
    const bool is_brace = character == '}';
    if (scan.open.empty() || (is_brace && scan.open_braces == 0)) {
        const std::string_view text = session.scanned.text;
        const bool is_doubled = character_before(text, scan.begin) == character;
        const bool for_parenthesis =
            !scan.open.empty() && !is_doubled && next_character(text, scan.end) != ')';
        report_closing(session, character, is_doubled, for_parenthesis);
        if (!for_parenthesis) {
            return std::nullopt;
        }
        const SourceSpan span = session.token();
        return Token(scan.pop() == OpenBracket::Kind::Module ? Parser::token::TOK_CLOSE
                                                             : Parser::token::TOK_RPAREN,
                     span);
    }
    if (is_brace == (scan.open.back().kind == OpenBracket::Kind::Brace)) {
        const SourceSpan span = session.token();
        const OpenBracket::Kind kind = scan.pop();
        if (scan.part == Part::FunctionHead && scan.open.empty()) {
            scan.enter(Part::Value);
        }
        return is_brace                            ? Token(Parser::token::TOK_RBRACE, span)
               : kind == OpenBracket::Kind::Module ? Token(Parser::token::TOK_CLOSE, span)
                                                   : Token(Parser::token::TOK_RPAREN, span);
    }
    // An inner bracket of the other kind must be closed first.
    const OpenBracket& inner = scan.open.back();
    const SourceSpan place = session.insertion_place();
    if (session.wants(DiagnosticCode::UnclosedParenthesis)) {
        const std::string closer = is_brace ? ")" : "}";
        Diagnostic& diagnostic = session.report(
            DiagnosticCode::UnclosedParenthesis, session.scanned.span(inner.begin, inner.begin + 1),
            std::string("`") + (is_brace ? '(' : '{') + "` is not closed before the `" + character +
                "`");
        diagnostic.labels.push_back({session.match(), "this closes a bracket around it"});
        add_fix(diagnostic, "add `" + closer + "`", place, closer, true);
    }
    if (scan.pop() == OpenBracket::Kind::Brace) {
        return Token(Parser::token::TOK_RBRACE, place).as_inserted();
    }
    return Token(Parser::token::TOK_RPAREN, place).as_inserted();
}

namespace {

Token too_deep(ParseSession& session) {
    if (session.wants_reports()) {
        report_too_deep(session.context.diagnostics, session.match(),
                        session.scan.chain != 0 ? "operators" : "parentheses");
    }
    return discard_statement(session);
}

} // namespace

Token opening_bracket(ParseSession& session, OpenBracket::Kind kind, Token::Kind token) {
    const SourceSpan span = session.token();
    session.scan.push(kind);
    return session.scan.depth > kMaxNesting ? too_deep(session) : Token(token, span);
}

Token nesting_operator(ParseSession& session, Token::Kind token) {
    ScanState& scan = session.scan;
    const SourceSpan span = session.token();
    scan.value_before = false;
    scan.name_before = false;
    ++scan.chain;
    return ++scan.depth > kMaxNesting ? too_deep(session) : Token(token, span);
}

void report_split_operator(ParseSession& session, std::string_view text) {
    if (!session.wants(DiagnosticCode::SplitOperator)) {
        return;
    }
    const std::string joined{text.front(), text.back()};
    Diagnostic& diagnostic = session.report(DiagnosticCode::SplitOperator,
                                            "a blank splits the operator `" + joined + "`");
    add_fix(diagnostic, "remove the blank", diagnostic.span, joined, true);
}

void report_wrong_operator(ParseSession& session, std::string_view right) {
    if (!session.wants(DiagnosticCode::SyntaxError)) {
        return;
    }
    const std::string_view text = session.match_text();
    const Synonym* const synonym = find_synonym(SynonymKind::Operator, text);
    LSYS_DCHECK(synonym != nullptr && synonym->spelling == right);
    Diagnostic& diagnostic = session.report(DiagnosticCode::SyntaxError,
                                            "there is no operator `" + std::string(text) + "`");
    // `2**x` may be a power, a product that lacks a factor, or a `*` typed twice.
    add_fix(diagnostic, help_for(*synonym, text), diagnostic.span, std::string(right),
            text != "**");
}

bool report_word_for_operator(ParseSession& session, std::string_view word) {
    const ScanState& scan = session.scan;
    if (!scan.value_before || (word != "and" && word != "or")) {
        return false;
    }
    const char next = next_character(session.scanned.text, scan.end);
    if (!is_word_character(next) &&
        std::string_view(".({-!").find(next) == std::string_view::npos) {
        return false;
    }
    if (session.wants(DiagnosticCode::SyntaxError)) {
        const Synonym& synonym = *find_synonym(SynonymKind::Operator, word);
        Diagnostic& diagnostic = session.report(DiagnosticCode::SyntaxError,
                                                "there is no operator `" + std::string(word) + "`");
        // Between arguments the word may be a name that lacks the commas around it.
        const bool in_list =
            !scan.open.empty() && scan.open.back().kind != OpenBracket::Kind::Group;
        add_fix(diagnostic, help_for(synonym, word), diagnostic.span, std::string(synonym.spelling),
                !in_list);
    }
    return true;
}

bool report_word_for_not(ParseSession& session, std::string_view word) {
    const ScanState& scan = session.scan;
    if (scan.value_before || word != "not") {
        return false;
    }
    const std::string_view text = session.scanned.text;
    const char next = next_character(text, scan.end);
    if (!is_word_character(next) && next != '(' && next != '!') {
        return false;
    }
    if (session.wants(DiagnosticCode::SyntaxError)) {
        Diagnostic& diagnostic =
            session.report(DiagnosticCode::SyntaxError, "there is no operator `not`");
        const std::size_t end = text.find_first_not_of(" \t", scan.end);
        // `not x > 1` means `!(x > 1)`, while `!x > 1` is `(!x) > 1`.
        add_fix(diagnostic,
                help_for(*find_synonym(SynonymKind::Operator, word), word) +
                    ", which goes before comparisons: `!(x > 1)`",
                session.scanned.span(scan.begin, static_cast<std::uint32_t>(end)), "!", false);
    }
    return true;
}

void report_remainder_operator(ParseSession& session) {
    if (session.wants(DiagnosticCode::SyntaxError)) {
        Diagnostic& diagnostic =
            session.report(DiagnosticCode::SyntaxError, "there is no operator `%`");
        diagnostic.help.push_back(help_for(*find_synonym(SynonymKind::Operator, "%"), "%"));
    }
}

void report_assignment(ParseSession& session) {
    if (session.wants(DiagnosticCode::AssignmentInExpression)) {
        Diagnostic& diagnostic =
            session.report(DiagnosticCode::AssignmentInExpression,
                           "`=` does not compare: it is used only in `#n = ...;`");
        add_fix(diagnostic, "compare with `==`", diagnostic.span, "==", true);
    }
}

namespace {

/// The offset of the identifier before the current character; nullopt if no argument begins there.
std::optional<std::uint32_t> argument_name(const ParseSession& session) {
    const ScanState& scan = session.scan;
    const std::string_view text = session.scanned.text;
    const std::size_t last = text.find_last_not_of(" \t", scan.begin - 1);
    if (!scan.name_before || scan.open.empty() || last == std::string_view::npos ||
        (scan.open.back().kind != OpenBracket::Kind::Module &&
         scan.open.back().kind != OpenBracket::Kind::Call)) {
        return std::nullopt;
    }
    auto first = static_cast<std::uint32_t>(last);
    while (first > 0 && is_word_character(text[first - 1])) {
        --first;
    }
    const char before = first == 0 ? '\0' : character_before(text, first);
    return before == '(' || before == ',' ? std::optional(first) : std::nullopt;
}

} // namespace

bool is_named_argument(const ParseSession& session) {
    return argument_name(session).has_value();
}

void report_named_argument(ParseSession& session) {
    if (!session.wants(DiagnosticCode::AssignmentInExpression)) {
        return;
    }
    const SourceSpan name = session.scanned.span(*argument_name(session), session.scan.end);
    Diagnostic& diagnostic = session.report(DiagnosticCode::AssignmentInExpression, name,
                                            "arguments have no names, only an order");
    add_fix(diagnostic, "leave the name out", name, "", false);
}

void report_stray_hash(ParseSession& session) {
    if (session.wants(DiagnosticCode::UnknownCharacter)) {
        Diagnostic& diagnostic =
            session.report(DiagnosticCode::UnknownCharacter, "`#` has no meaning in an expression");
        diagnostic.help.emplace_back(
            "the age of the word, which Carey's instancing rules write `#`, is `step()`");
        if (!session.scan.value_before) {
            add_fix(diagnostic, "write `step()`", diagnostic.span, "step()", false);
        }
    }
}

} // namespace lsys::lsys_grammar
