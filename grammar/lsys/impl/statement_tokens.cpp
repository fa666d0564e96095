// SPDX-License-Identifier: MIT
#include "grammar/lsys/impl/statement_tokens.h"

#include "grammar/ast/reports.h"
#include "grammar/base/characters.h"
#include "grammar/lsys/impl/bracket_search.h"
#include "grammar/lsys/impl/lookahead.h"
#include "grammar/lsys/impl/module_tokens.h"
#include "grammar/lsys/impl/statement_facts.h"
#include "grammar/lsys/impl/statement_insertions.h"

#include <algorithm>
#include <string>
#include <utility>

namespace lsys::lsys_grammar {

Token opening_colon(ParseSession& session) {
    ScanState& scan = session.scan;
    if (scan.keyword == Keyword::Generations && colons_of_statement(session) == 1) {
        const char next = next_character(session.scanned.text, scan.end);
        if (is_digit(next) || next == '.' || next == '(') { // cannot begin a predecessor
            if (session.wants(DiagnosticCode::SyntaxError)) {
                const SourceSpan span = session.match();
                Diagnostic& diagnostic =
                    session.report(DiagnosticCode::SyntaxError, span, "expected `=` here, not `:`");
                add_fix(diagnostic, "write `=`", span, "=", true);
            }
            const SourceSpan span = session.token();
            scan.enter(Part::Value);
            return Token(Parser::token::TOK_ASSIGN, span);
        }
    }
    const SourceSpan span = session.token();
    after_opening_colon(session);
    return Token(Parser::token::TOK_COLON, span);
}

void after_opening_colon(ParseSession& session) {
    ScanState& scan = session.scan;
    scan.enter(scan.keyword == Keyword::Axiom ? Part::Axiom
               : scan.keyword == Keyword::Ignore || scan.keyword == Keyword::Consider
                   ? Part::Ignored
                   : Part::Head);
}

namespace {

/// Whether a `:` must be next.
bool opens_with_colon(const ScanState& scan) {
    return scan.keyword == Keyword::Axiom || scan.keyword == Keyword::Ignore ||
           scan.keyword == Keyword::Consider || scan.keyword == Keyword::Label ||
           (names_production(scan.keyword) && scan.name_before);
}

} // namespace

Token opening_sign(ParseSession& session) {
    ScanState& scan = session.scan;
    const char sign = session.scanned.text[scan.begin];
    if (scan.keyword == Keyword::Generations && sign == '=') {
        const SourceSpan span = session.token();
        scan.enter(Part::Value);
        return Token(Parser::token::TOK_ASSIGN, span);
    }
    if (opens_with_colon(scan)) {
        if (session.wants(DiagnosticCode::MissingColon)) {
            const SourceSpan span = session.match();
            Diagnostic& diagnostic =
                session.report(DiagnosticCode::MissingColon, span,
                               std::string("expected `:` here, not `") + sign + "`");
            add_fix(diagnostic, "write `:`", span, ":", true);
        }
        const SourceSpan span = session.token();
        after_opening_colon(session);
        return Token(Parser::token::TOK_COLON, span);
    }
    return Token(Parser::token::TOK_OTHER, session.token());
}

std::optional<Token> missing_opening(ParseSession& session) {
    ScanState& scan = session.scan;
    const bool wants_equals = scan.keyword == Keyword::Generations;
    if (!wants_equals && !opens_with_colon(scan)) {
        return std::nullopt;
    }
    const SourceSpan place = session.insertion_place();
    const std::string sign = wants_equals ? "=" : ":";
    const auto code = wants_equals ? DiagnosticCode::SyntaxError : DiagnosticCode::MissingColon;
    if (session.wants(code)) {
        const std::string_view written =
            session.scanned.text.substr(scan.statement_begin, scan.last_end - scan.statement_begin);
        Diagnostic& diagnostic =
            session.report(code, place, "`" + sign + "` is missing after `" + shown(written) + "`");
        add_fix(diagnostic, "add `" + sign + "`", place, " " + sign, true);
    }
    scan.end = scan.begin; // reads the match again
    if (wants_equals) {
        scan.enter(Part::Value);
        return Token(Parser::token::TOK_ASSIGN, place).as_inserted();
    }
    after_opening_colon(session);
    return Token(Parser::token::TOK_COLON, place).as_inserted();
}

bool report_needless_sign(ParseSession& session) {
    ScanState& scan = session.scan;
    const bool takes_none = scan.keyword == Keyword::Define || scan.keyword == Keyword::Param ||
                            scan.keyword == Keyword::Function || scan.keyword == Keyword::Curve ||
                            scan.keyword == Keyword::Contour || scan.keyword == Keyword::Set ||
                            scan.keyword == Keyword::Material || scan.keyword == Keyword::Sense ||
                            scan.keyword == Keyword::Generations;
    if (!scan.part_empty || !takes_none || !scan.open.empty()) {
        return false;
    }
    if (std::exchange(scan.sign_explained, false)) {
        return true;
    }
    if (session.wants(DiagnosticCode::SyntaxError)) {
        const SourceSpan span = session.match();
        const std::string sign(session.scanned.text.substr(scan.begin, 1));
        Diagnostic& diagnostic = session.report(DiagnosticCode::SyntaxError, span,
                                                "`#" + std::string(spelling(scan.keyword)) +
                                                    "` takes no `" + sign + "` here");
        add_fix(diagnostic, "remove it", span, "", true);
    }
    return true;
}

bool report_needless_question_mark(ParseSession& session) {
    const ScanState& scan = session.scan;
    const std::string_view text = session.scanned.text;
    if (scan.keyword != Keyword::Sense || text[scan.begin] != '?' || scan.end >= text.size() ||
        !is_letter(text[scan.end])) {
        return false;
    }
    if (session.wants(DiagnosticCode::SyntaxError)) {
        const std::string name(leading_word(text.substr(scan.end)));
        const SourceSpan span = session.match();
        Diagnostic& diagnostic =
            session.report(DiagnosticCode::SyntaxError, span,
                           "`#sense` names the environment without the `?` of its modules");
        add_fix(diagnostic, "write `" + shown(name) + "`", span, "", true);
    }
    return true;
}

bool report_doubled_colon(ParseSession& session) {
    ScanState& scan = session.scan;
    const std::string_view text = session.scanned.text;
    const std::uint32_t wanted = scan.part == Part::Axiom || scan.part == Part::Ignored ? 1u
                                 : scan.has_locals                                      ? 4u
                                                                                        : 3u;
    if (!scan.part_empty || !scan.open.empty() || character_before(text, scan.begin) != ':' ||
        scan.bracket_searches++ >= kMaxBracketSearches ||
        !has_more_colons(text, scan.statement_begin, wanted)) {
        return false;
    }
    if (session.wants(DiagnosticCode::ExtraColon)) {
        const SourceSpan span = session.match();
        Diagnostic& diagnostic =
            session.report(DiagnosticCode::ExtraColon, span, "a `:` is doubled");
        add_fix(diagnostic, "remove it", span, "", true);
    }
    return true;
}

namespace {

/// Reports `A : * : B : 0.6`, a probability at the end as in Houdini; returns whether it did.
bool report_probability_at_end(ParseSession& session) {
    const ScanState& scan = session.scan;
    const std::string_view text = session.scanned.text;
    const std::size_t number = std::min(text.find_first_not_of(kWhitespace, scan.end), text.size());
    const std::size_t end = std::min(text.find_first_not_of("0123456789.", number), text.size());
    const std::size_t after_number =
        std::min(text.find_first_not_of(kWhitespace, end), text.size());
    const std::size_t third_colon = text.rfind(':', scan.part_begin);
    const std::size_t second_colon = third_colon == std::string_view::npos || third_colon == 0
                                         ? third_colon
                                         : text.rfind(':', third_colon - 1);
    if (end == number || text.substr(after_number, 1) != ";" ||
        second_colon == std::string_view::npos || second_colon < scan.statement_begin) {
        return false;
    }
    const std::string_view part = text.substr(second_colon + 1, third_colon - second_colon - 1);
    const std::size_t last = part.find_last_not_of(kWhitespace);
    if (last == std::string_view::npos || part.find_first_of("~=") != std::string_view::npos) {
        return false; // the part has a probability or local values
    }
    const std::string probability(text.substr(number, end - number));
    const auto condition_end = static_cast<std::uint32_t>(second_colon + 1 + last + 1);
    const std::size_t successor_end =
        scan.begin == 0 ? 0 : text.find_last_not_of(kWhitespace, scan.begin - 1) + 1;
    Diagnostic& diagnostic = session.report(
        DiagnosticCode::ExtraColon,
        session.scanned.span(scan.begin, static_cast<std::uint32_t>(end)),
        "`: " + shown(probability) +
            "` at the end is a probability of Houdini; in .lsys it comes after the condition");
    Fix fix;
    fix.title = "write `" +
                shown(std::string(part.substr(part.find_first_not_of(kWhitespace),
                                              last + 1 - part.find_first_not_of(kWhitespace)))) +
                " ~ " + probability + "`";
    fix.edits = {{session.scanned.span(condition_end, condition_end), " ~ " + probability},
                 {session.scanned.span(static_cast<std::uint32_t>(successor_end),
                                       static_cast<std::uint32_t>(end)),
                  ""}};
    fix.machine_applicable = false;
    diagnostic.fixes.push_back(std::move(fix));
    return true;
}

} // namespace

Token colon_after_modules(ParseSession& session) {
    ScanState& scan = session.scan;
    if (scan.part == Part::Head) {
        const SourceSpan span = session.token();
        scan.enter(Part::Condition);
        return Token(Parser::token::TOK_COLON, span);
    }
    const std::string_view text = session.scanned.text;
    const std::string_view rest = text.substr(scan.end, text.find('\n', scan.end) - scan.end);
    const bool ends_line = rest.find_first_not_of(" \t\r") == std::string_view::npos;
    // At the end of a line the `:` may be a mistyped `;`.
    if ((scan.part == Part::Successor || scan.part == Part::Axiom) && !ends_line &&
        report_likely_comment(session)) {
        return discard_statement(session);
    }
    if (session.wants(DiagnosticCode::ExtraColon) &&
        !(scan.part == Part::Successor && report_probability_at_end(session))) {
        const std::string word(spelling(scan.keyword));
        Diagnostic& diagnostic =
            session.report(DiagnosticCode::ExtraColon, scan.part == Part::Successor
                                                           ? "a production has no further part"
                                                           : "`#" + word + "` has no further part");
        if (scan.part == Part::Successor) {
            diagnostic.help.emplace_back(kFourParts);
            const char next = next_character(session.scanned.text, scan.end);
            if (is_digit(next) || next == '.') {
                diagnostic.help.emplace_back(
                    "a probability comes after the condition: `#name : A : * ~ 0.5 : B;`");
            }
        } else if (scan.part == Part::Axiom) {
            diagnostic.help.emplace_back("the axiom is `#w : modules;`");
        }
    }
    return discard_statement(session);
}

Token colon_in_expression(ParseSession& session) {
    ScanState& scan = session.scan;
    const bool in_production = scan.part == Part::Probability || scan.part == Part::Head ||
                               scan.part == Part::Condition || scan.part == Part::Locals;
    if (!scan.open.empty() && in_production) {
        return begin_insertion(session, Insertion::Colon, session.match());
    }
    const SourceSpan span = session.token();
    if (in_production) {
        scan.enter(part_after_colon(session));
    }
    return Token(Parser::token::TOK_COLON, span);
}

std::optional<Token> local_value_token(ParseSession& session, std::string_view text) {
    ScanState& scan = session.scan;
    const NextInLocals place = scan.next_in_locals;
    const bool fits = place == NextInLocals::Let ||
                      (place == NextInLocals::Name && is_letter(text[0])) ||
                      (place == NextInLocals::Sign && text == "=") ||
                      (place == NextInLocals::Value && text == ",");
    if (scan.part != Part::Locals || !scan.open.empty() || !fits) {
        return std::nullopt;
    }
    const SourceSpan span = session.token();
    switch (place) {
    case NextInLocals::Let:
        scan.next_in_locals = NextInLocals::Name;
        return Token(Parser::token::TOK_LET, span);
    case NextInLocals::Name:
        scan.next_in_locals = NextInLocals::Sign;
        return Token(Parser::token::TOK_IDENTIFIER, session.builder.intern(text), span);
    case NextInLocals::Sign:
        scan.next_in_locals = NextInLocals::Value;
        return Token(Parser::token::TOK_ASSIGN, span);
    case NextInLocals::Value:
        scan.after_operator();
        scan.next_in_locals = NextInLocals::Name;
        return Token(Parser::token::TOK_COMMA, span);
    }
    return std::nullopt;
}

namespace {

/// The number of `:` that must follow the current `;` if the `;` is a mistyped `:`; nullopt if the
/// `;` ends the statement.
std::optional<std::ptrdiff_t> colons_after_semicolon(const ScanState& scan) {
    if (!scan.open.empty() || scan.skipping) {
        return std::nullopt;
    }
    switch (scan.part) {
    case Part::Opening:
        if (scan.keyword == Keyword::Axiom || scan.keyword == Keyword::Ignore ||
            scan.keyword == Keyword::Consider) {
            return 0;
        }
        return scan.keyword == Keyword::Label || names_production(scan.keyword)
                   ? std::optional<std::ptrdiff_t>(2)
                   : std::nullopt;
    case Part::Head:
        return 1;
    case Part::Condition:
        return 0;
    default:
        return std::nullopt;
    }
}

/// Whether the text before the current `;` is certainly a condition, so that only a successor can
/// follow.
bool has_condition_before(const ParseSession& session) {
    const ScanState& scan = session.scan;
    const std::string_view condition =
        session.scanned.text.substr(scan.part_begin, scan.begin - scan.part_begin);
    return condition.find_first_of("<>=!~&|") != std::string_view::npos ||
           condition.find_first_not_of(" \t\r\n*") == std::string_view::npos;
}

/// The `:` token if the current `;` is a mistyped `:`; nullopt if the `;` ends the statement.
std::optional<Token> semicolon_for_colon(ParseSession& session) {
    ScanState& scan = session.scan;
    const std::string_view text = session.scanned.text;
    const std::optional<std::ptrdiff_t> missing = colons_after_semicolon(scan);
    if (!missing || scan.bracket_searches++ >= kMaxBracketSearches ||
        !is_mistyped_colon(text, scan.begin, *missing) ||
        (scan.part == Part::Condition && !has_condition_before(session))) {
        return std::nullopt;
    }
    if (session.wants(DiagnosticCode::MissingColon)) {
        const SourceSpan span = session.match();
        Diagnostic& diagnostic =
            session.report(DiagnosticCode::MissingColon, span, "expected `:` here, not `;`");
        add_fix(diagnostic, "write `:`", span, ":", true);
    }
    const SourceSpan span = session.token();
    scan.colons = 3; // includes the `:` after this `;`
    if (scan.part == Part::Opening) {
        after_opening_colon(session);
    } else {
        scan.enter(scan.part == Part::Head ? Part::Condition : Part::Successor);
    }
    return Token(Parser::token::TOK_COLON, span);
}

} // namespace

std::optional<Token> semicolon(ParseSession& session) {
    ScanState& scan = session.scan;
    if (scan.statement_open) {
        if (std::optional<Token> colon = semicolon_for_colon(session)) {
            return colon;
        }
        return begin_insertion(session, Insertion::Semicolon, session.match());
    }
    if (!session.silent && session.context.diagnostics.admits(DiagnosticCode::StraySemicolon)) {
        const SourceSpan span = session.match();
        Diagnostic& diagnostic =
            session.report(DiagnosticCode::StraySemicolon, span, "this `;` ends no statement");
        // After a syntax error the fix is only an offer: another `;` may have ended the statement
        // too early.
        add_fix(diagnostic, "remove it", span, "", session.wants_reports());
    }
    return std::nullopt;
}

} // namespace lsys::lsys_grammar
