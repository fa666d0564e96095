// SPDX-License-Identifier: MIT
#include "grammar/lsys/impl/syntax_errors.h"

#include "grammar/ast/reports.h"
#include "grammar/base/characters.h"
#include "grammar/base/synonyms.h"
#include "grammar/lsys/impl/bracket_search.h"
#include "grammar/lsys/impl/lookahead.h"
#include "grammar/lsys/impl/missing_colon.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace lsys::lsys_grammar {

namespace {

using Kind = Parser::symbol_kind;

/// The unexpected token and its place.
struct Unexpected {
    Parser::symbol_kind_type token;
    SourceSpan place;
    std::span<const Parser::symbol_kind_type> expected; // tokens allowed instead
    Part part;                                          // part of the statement
    std::string_view text;                              // empty for an inserted token

    [[nodiscard]] bool expects(Parser::symbol_kind_type kind) const {
        return std::find(expected.begin(), expected.end(), kind) != expected.end();
    }
};

std::string name_expected(const ScanState& scan) {
    switch (scan.keyword) {
    case Keyword::Set:
        return "a key, as in `#set angle 30;`";
    case Keyword::Object:
    case Keyword::Include:
        return "an object, for example `SPHERE`";
    case Keyword::Decompose:
    case Keyword::Interpret:
    case Keyword::Down:
    case Keyword::Up:
        return "the name of the production";
    case Keyword::Function:
        return "the name of the function";
    case Keyword::Curve:
        return "the name of the curve";
    case Keyword::Contour:
        return "the name of the contour";
    case Keyword::Sense:
        return "the name of the environment";
    default:
        return "the name of the constant";
    }
}

std::vector<std::string> expected_in_words(const Unexpected& error, const ScanState& scan) {
    std::vector<std::string> words;
    const bool expects_value = error.expects(Kind::S_NUMBER);
    const bool expects_operator = error.expects(Kind::S_PLUS);
    const auto add = [&](bool holds, std::string text) {
        if (holds) {
            words.push_back(std::move(text));
        }
    };
    add(error.expects(Kind::S_NAMES), "a module");
    add(expects_value && error.part != Part::Setting, "a value");
    add(expects_value && error.part == Part::Setting, "a number or a word");
    const bool has_object = error.part == Part::ObjectValue && error.expects(Kind::S_SEMICOLON);
    add(!expects_value && error.expects(Kind::S_IDENTIFIER) && !has_object, name_expected(scan));
    add(error.expects(Kind::S_STRING), "a file name in quotes");
    add(expects_operator, "an operator");
    add(!expects_operator && error.expects(Kind::S_STAR), "`*`");
    add(error.expects(Kind::S_ASSIGN), "`=`");
    add(error.expects(Kind::S_TILDE), "`~` and a probability");
    add(error.expects(Kind::S_COMMA), "`,`");
    add(error.expects(Kind::S_RPAREN) || error.expects(Kind::S_CLOSE), "`)`");
    add(error.expects(Kind::S_RBRACE), "`}`");
    add(!expects_value && error.expects(Kind::S_LBRACE), "the bounds `{min, max}`");
    add(error.expects(Kind::S_CLT), "`<`");
    add(error.expects(Kind::S_CGT), "`>`");
    if (error.expects(Kind::S_COLON)) {
        const bool after_head = error.part == Part::Head;
        const bool after_condition = error.part == Part::Condition;
        words.emplace_back(after_head        ? "`:` and the condition"
                           : after_condition ? "`:` and the successor"
                                             : "`:`");
    }
    add(error.expects(Kind::S_SEMICOLON), "`;`");
    return words;
}

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i) {
        text += i == 0 ? "" : i + 1 == words.size() ? " or " : ", ";
        text += words[i];
    }
    return text;
}

std::string found_text(const Unexpected& error, const ScanState& scan) {
    if (error.text.empty()) {
        return scan.inserting == Insertion::EndOfFile ? "the end of the file"
                                                      : "the next statement";
    }
    return "`" + shown(error.text) + "`";
}

/// Whether the current `.` stands between two words: `math.sin`.
bool is_attribute(const ParseSession& session) {
    const std::string_view text = session.scanned.text;
    const ScanState& scan = session.scan;
    return scan.begin > 0 && is_word_character(text[scan.begin - 1]) && scan.end < text.size() &&
           is_letter(text[scan.end]);
}

/// Explains `random.uniform(1, 2)`: adds the .lsys equivalent of the word after the `.`.
void explain_attribute(const ParseSession& session, Diagnostic& diagnostic) {
    const std::string_view word = leading_word(session.scanned.text.substr(session.scan.end));
    const Synonym* const synonym = find_synonym(SynonymKind::Function, word);
    diagnostic.help.push_back(synonym != nullptr ? help_for(*synonym, word)
                                                 : "functions are written without a `.`: `" +
                                                       shown(word) + "(x)`");
}

/// Reports `math.sqrt`, a function of a library; returns whether it did.
bool report_library(ParseSession& session) {
    const std::string_view text = session.scanned.text;
    const ScanState& scan = session.scan;
    std::uint32_t begin = scan.begin;
    while (begin > 0 && is_word_character(text[begin - 1])) {
        --begin;
    }
    const std::string_view library = text.substr(begin, scan.begin - begin);
    const std::string_view function = leading_word(text.substr(scan.end));
    if ((library != "math" && library != "Math" && library != "np" && library != "numpy") ||
        find_synonym(SynonymKind::Function, function) != nullptr ||
        text.substr(scan.end + function.size(), 1) != "(") {
        return false;
    }
    const auto end = static_cast<std::uint32_t>(scan.end + function.size());
    Diagnostic& diagnostic =
        session.report(DiagnosticCode::SyntaxError, session.scanned.span(begin, end),
                       "there is no `" + std::string(library) + "`: functions are built in");
    add_fix(diagnostic, "write `" + std::string(function) + "`",
            session.scanned.span(begin, scan.end), "", false);
    return true;
}

/// Offers quotes around the file name that contains the current `.`.
void offer_quotes(const ParseSession& session, Diagnostic& diagnostic) {
    const std::string_view text = session.scanned.text;
    constexpr std::string_view kEnds = " \t\r\n;\"";
    std::uint32_t begin = session.scan.begin;
    while (begin > 0 && kEnds.find(text[begin - 1]) == std::string_view::npos) {
        --begin;
    }
    const auto end = static_cast<std::uint32_t>(
        std::min(text.find_first_of(kEnds, session.scan.begin), text.size()));
    const std::string name(text.substr(begin, end - begin));
    add_fix(diagnostic, "the name of a file is quoted: `\"" + shown(name) + "\"`",
            session.scanned.span(begin, end), '"' + name + '"', false);
}

/// The parameter of the current `#param` with bounds: `x 30 {0, 60}`.
std::string param_text(const ParseSession& session) {
    const std::string_view text = session.scanned.text;
    constexpr std::string_view kBlanks = " \t\r\n=:";
    const std::size_t begin = std::min(
        text.find_first_not_of(kBlanks, text.find("param", session.scan.statement_begin) + 5),
        text.size());
    const std::string name(leading_word(text.substr(begin)));
    const std::size_t value =
        std::min(text.find_first_not_of(kBlanks, begin + name.size()), text.size());
    const std::string_view number =
        text.substr(value, text.find_first_not_of("0123456789.", value) - value);
    if (name.empty() || number.empty() || number.find('.') != std::string_view::npos ||
        number.size() > 6 || value + number.size() > session.scan.end) {
        return "NAME value {min, max}";
    }
    const int twice = 2 * std::stoi(std::string(number));
    return name + " " + std::string(number) + " {0, " + std::to_string(twice) + "}";
}

void report_expected(ParseSession& session, const Unexpected& error) {
    if (!session.wants(DiagnosticCode::SyntaxError)) {
        return;
    }
    const ScanState& scan = session.scan;
    if (error.text == "." && error.part != Part::ObjectValue && is_attribute(session) &&
        report_library(session)) {
        return;
    }
    const std::vector<std::string> words = expected_in_words(error, scan);
    const std::string found = found_text(error, scan);
    Diagnostic& diagnostic =
        session.report(DiagnosticCode::SyntaxError, error.place,
                       words.empty() ? found + " cannot stand here"
                                     : "expected " + joined(words) + ", found " + found);
    if (scan.keyword == Keyword::Param && error.expects(Kind::S_LBRACE) &&
        !error.expects(Kind::S_NUMBER)) {
        diagnostic.help.push_back("a parameter has bounds: `#param " + param_text(session) + ";`");
    } else if (error.part == Part::Setting && error.token == Kind::S_OTHER && error.text == ",") {
        const std::string_view text = session.scanned.text;
        const char next = scan.end < text.size() ? text[scan.end] : '\0';
        diagnostic.help.emplace_back(
            "values are written side by side, without commas: `" +
            std::string(scan.keyword == Keyword::Material ? "#material 3 colour 0.4 0.3 0.2;"
                        : scan.keyword == Keyword::Sense  ? "#sense ground solid plane 0 1 0 0;"
                                                          : "#set tropism 0 -1 0 0.2;") +
            "`");
        if (is_digit(text[scan.begin - 1]) && is_digit(next)) {
            add_fix(diagnostic, "a decimal point is written `.`", error.place, ".", false);
        }
    } else if (takes_file_names(scan.keyword) && error.part == Part::Setting &&
               (error.text == "=" || error.text == ":")) {
        diagnostic.help.emplace_back(
            scan.keyword == Keyword::Material
                ? "a value comes right after its key: `#material 3 roughness 0.9;`"
                : "a value comes right after its key: `#sense light shadow cell 0.5;`");
    } else if (takes_file_names(scan.keyword) && error.part == Part::Setting && error.text == ".") {
        offer_quotes(session, diagnostic);
    } else if (error.part == Part::Setting && !error.text.empty() && error.text != ";") {
        diagnostic.help.emplace_back(
            error.text == "\"" ? "the words of a setting have no quotes"
            : scan.keyword == Keyword::Material
                ? "an expression is in parentheses here: `#material (base + 1) roughness (1 / 3);`"
            : scan.keyword == Keyword::Sense
                ? "an expression is in parentheses here: `#sense light shadow cell (size / 3);`"
                : "an expression is in parentheses here: `#set angle (360 / 7);`");
    } else if (error.text == "." && error.part != Part::ObjectValue && is_attribute(session)) {
        explain_attribute(session, diagnostic);
    } else if (error.expects(Kind::S_NUMBER) && error.token == Kind::S_RPAREN &&
               character_before(session.scanned.text, scan.begin) == ',') {
        diagnostic.help.emplace_back("there is no comma after the last argument");
    } else if (error.text == "?") {
        diagnostic.help.emplace_back(
            "there is no operator `? :`: a choice is `if(condition, a, b)`");
    } else if (error.part == Part::ObjectValue && error.token == Kind::S_OTHER &&
               error.text == ".") {
        offer_quotes(session, diagnostic);
    } else if (error.token == Kind::S_COMMA && scan.open.empty()) {
        diagnostic.help.emplace_back("a comma is allowed only between arguments in parentheses");
    }
}

/// Whether the text after the current character closes all open brackets.
bool are_brackets_closed(const ParseSession& session) {
    const ScanState& scan = session.scan;
    std::uint32_t at = scan.end;
    for (std::size_t level = 0; level < scan.open.size(); ++level) {
        const std::optional<std::uint32_t> close = unmatched_parenthesis(session.scanned.text, at);
        if (!close) {
            return false;
        }
        at = *close + 1;
    }
    return true;
}

/// Reports `[` or another module in place of a value: the `(` before it is never closed.
bool report_modules_in_parentheses(ParseSession& session, const Unexpected& error) {
    const ScanState& scan = session.scan;
    if (error.token != Kind::S_OTHER || scan.open.empty() ||
        scan.open.front().kind != OpenBracket::Kind::Module || error.text.size() != 1 ||
        std::string_view("[]$\"'\\").find(error.text[0]) == std::string_view::npos) {
        return false;
    }
    if (error.text != "]" && are_brackets_closed(session)) {
        return false; // the character is the mistake
    }
    if (session.wants(DiagnosticCode::UnclosedParenthesis)) {
        const std::uint32_t open = scan.open.front().begin;
        Diagnostic& diagnostic =
            session.report(DiagnosticCode::UnclosedParenthesis,
                           session.scanned.span(open, open + 1), "`(` is never closed");
        diagnostic.labels.push_back(
            {error.place, "`" + std::string(error.text) + "` is not part of an argument"});
        if (scan.open.size() == 1) {
            const std::size_t last =
                session.scanned.text.find_last_not_of(kWhitespace, scan.begin - 1);
            add_fix(diagnostic, "add `)` before `" + std::string(error.text) + "`",
                    session.scanned.after(static_cast<std::uint32_t>(last) + 1), ")", false);
        }
    }
    return true;
}

bool report_empty_condition(ParseSession& session, const Unexpected& error) {
    const std::string_view text = session.scanned.text;
    const std::size_t before = session.scan.begin == 0
                                   ? std::string_view::npos
                                   : text.find_last_not_of(kWhitespace, session.scan.begin - 1);
    if (error.token != Kind::S_COLON || error.part != Part::Successor ||
        before == std::string_view::npos || text[before] != ':') {
        return false;
    }
    if (session.wants(DiagnosticCode::SyntaxError)) {
        Diagnostic& diagnostic =
            session.report(DiagnosticCode::SyntaxError, error.place, "the condition is missing");
        add_fix(diagnostic, "`*` is the condition that always holds",
                {error.place.file, error.place.begin, error.place.begin}, "* ", true);
    }
    return true;
}

/// Reports `t++`; returns whether the current `+` is the second `+` of such an increment.
bool report_increment(ParseSession& session) {
    const ScanState& scan = session.scan;
    const std::string_view text = session.scanned.text;
    const char next = next_character(text, scan.end);
    if (scan.begin == 0 || text[scan.begin - 1] != '+' ||
        std::string_view("),;:").find(next) == std::string_view::npos) {
        return false;
    }
    if (session.wants(DiagnosticCode::SyntaxError)) {
        const SourceSpan span = session.scanned.span(scan.begin - 1, scan.end);
        std::size_t begin = scan.begin - 1;
        while (begin > 0 && is_word_character(text[begin - 1])) {
            --begin;
        }
        const std::string name(text.substr(begin, scan.begin - 1 - begin));
        Diagnostic& diagnostic =
            session.report(DiagnosticCode::SyntaxError, span, "there is no operator `++`");
        add_fix(diagnostic, "write `" + name + " + 1`", span, " + 1", false);
    }
    return true;
}

/// Reports `t--)`; returns whether it did.
bool report_decrement(ParseSession& session, const Unexpected& error) {
    const std::string_view text = session.scanned.text;
    const std::uint32_t end = session.scan.last_end;
    if (error.token != Kind::S_RPAREN && error.token != Kind::S_CLOSE &&
        error.token != Kind::S_COMMA) {
        return false;
    }
    if (end < 3 || text.substr(end - 2, 2) != "--" || !is_word_character(text[end - 3])) {
        return false;
    }
    if (session.wants(DiagnosticCode::SyntaxError)) {
        std::size_t begin = end - 2;
        while (begin > 0 && is_word_character(text[begin - 1])) {
            --begin;
        }
        const SourceSpan span = session.scanned.span(end - 2, end);
        Diagnostic& diagnostic =
            session.report(DiagnosticCode::SyntaxError, span, "there is no operator `--`");
        add_fix(diagnostic, "write `" + std::string(text.substr(begin, end - 2 - begin)) + " - 1`",
                span, " - 1", false);
    }
    return true;
}

bool report_unary_plus(ParseSession& session, const Unexpected& error) {
    if (error.token != Kind::S_PLUS || !error.expects(Kind::S_NUMBER)) {
        return false;
    }
    if (report_increment(session)) {
        return true;
    }
    if (session.wants(DiagnosticCode::SyntaxError)) {
        Diagnostic& diagnostic =
            session.report(DiagnosticCode::SyntaxError, error.place, "expected a value, found `+`");
        // A `+` before a blank is more likely an operator without its first operand.
        const std::string_view text = session.scanned.text;
        const bool is_sign =
            session.scan.end < text.size() &&
            std::string_view(" \t\r\n/").find(text[session.scan.end]) == std::string_view::npos;
        add_fix(diagnostic, "a positive number has no sign; remove the `+`", error.place, "",
                is_sign);
    }
    return true;
}

bool report_context_sign(ParseSession& session, const Unexpected& error) {
    const bool is_arrow = error.token == Kind::S_CLT || error.token == Kind::S_CGT;
    if (error.part != Part::Head || !is_arrow) {
        return false;
    }
    if (report_missing_colon(session, "")) {
        return true;
    }
    if (session.wants(DiagnosticCode::SyntaxError)) {
        Diagnostic& diagnostic =
            session.report(DiagnosticCode::SyntaxError, error.place,
                           "a second `" + std::string(error.text) + "` cannot stand here");
        diagnostic.help.emplace_back("contexts are written `left < predecessor > right`");
    }
    return true;
}

} // namespace

void report_unexpected_token(ParseSession& session,
                             Parser::symbol_kind_type token,
                             SourceSpan place,
                             std::span<const Parser::symbol_kind_type> expected) {
    ScanState& scan = session.scan;
    const bool is_inserted = session.token_inserted;
    // Inserted tokens have been reported already, except for a `;`.
    if (session.wants_reports() && (!is_inserted || token == Kind::S_SEMICOLON)) {
        const Part part = scan.statement_open ? scan.part : scan.ended_part;
        const std::string_view text = is_inserted ? std::string_view{} : session.match_text();
        const Unexpected error{token, place, expected, part, text};
        const bool in_production = part == Part::Head || part == Part::Condition;
        const bool reported = report_modules_in_parentheses(session, error) ||
                              report_empty_condition(session, error) ||
                              report_context_sign(session, error) ||
                              (in_production && scan.open.empty() && !is_inserted &&
                               report_missing_colon(session, "")) ||
                              report_unary_plus(session, error) || report_decrement(session, error);
        if (!reported) {
            report_expected(session, error);
        }
    }
    session.failed = true;
}

} // namespace lsys::lsys_grammar
