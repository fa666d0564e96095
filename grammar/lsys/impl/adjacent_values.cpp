// SPDX-License-Identifier: MIT
#include "grammar/lsys/impl/adjacent_values.h"

#include "grammar/base/characters.h"
#include "grammar/base/synonyms.h"
#include "grammar/lsys/impl/bracket_search.h"
#include "grammar/lsys/impl/lookahead.h"
#include "grammar/lsys/impl/missing_colon.h"
#include "grammar/lsys/impl/statement_insertions.h"

#include <algorithm>
#include <optional>
#include <string>

namespace lsys::lsys_grammar {

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

} // namespace lsys::lsys_grammar
