// SPDX-License-Identifier: MIT
#include "grammar/lsys/impl/expression_tokens.h"

#include "grammar/ast/reports.h"
#include "grammar/base/characters.h"
#include "grammar/base/contract.h"
#include "grammar/base/synonyms.h"
#include "grammar/lsys/impl/bracket_search.h"
#include "grammar/lsys/impl/lookahead.h"
#include "grammar/lsys/impl/statement_insertions.h"

#include <optional>
#include <string>

namespace lsys::lsys_grammar {

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
