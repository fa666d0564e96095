// SPDX-License-Identifier: MIT
#include "grammar/lsys/impl/module_tokens.h"

#include "grammar/ast/reports.h"
#include "grammar/base/characters.h"
#include "grammar/base/message_levels.h"
#include "grammar/base/utf8.h"
#include "grammar/lsys/impl/bracket_search.h"
#include "grammar/lsys/impl/lookahead.h"
#include "grammar/lsys/impl/missing_colon.h"
#include "grammar/lsys/impl/statement_insertions.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace lsys::lsys_grammar {

namespace {

constexpr std::size_t kMaxQuotedNameLength = 16;

/// A symbol of other programs and its replacement in this language.
struct ForeignSymbol {
    char symbol;
    std::string_view meaning;
};
constexpr std::array<ForeignSymbol, 9> kForeignSymbols{{
    {'@',
     "in Houdini `@` divides the angle, in Fractint it scales the step, in .sys files it turns: "
     "write `\"(factor)` for the step, `+(angle)` or `-(angle)` for a turn"},
    {'*', "in .l++ files `*` draws a leaf (`#object L LEAF;` and `L`), in Houdini it rolls by 180 "
          "degrees (`\\(180)`)"},
    {'~', "in Houdini `~(a)` turns at random (`+({-10, 10})`), in cpfg `~` places a surface "
          "(`#object`)"},
    {'=', "in .l++ files `=(p)` sets the thickness (`!(width)`); a production is "
          "`#name : A : * : B;`"},
    {'?', "in Houdini `?` divides the width (`!(width)`), in cpfg it asks for the turtle's state"},
    {'<', "`<` separates a left context from the predecessor; in .l files it rolls (`\\` and `/`), "
          "in .l++ files it changes the width (`!(width)`), in .sys files it turns (`+` and `-`)"},
    {'>', "`>` separates the predecessor from a right context; in .l files it rolls (`\\` and "
          "`/`), in .l++ files it changes the width (`!(width)`), in .sys files it turns (`+` and "
          "`-`)"},
    {'#', "`#` begins a statement; in Houdini `#` steps the texture"},
    {';',
     "`;` ends the statement; in cpfg it sets the colour (`'(index)`), in Houdini it multiplies "
     "the angle"},
}};

/// Counts one more bracket search; returns false beyond kMaxBracketSearches.
bool claim_search(ParseSession& session) {
    return session.scan.bracket_searches++ < kMaxBracketSearches;
}

/// Reports a `)` without `(`. `branch`: the place of a `[` that may be meant as the `(`.
void report_missing_open(ParseSession& session,
                         std::uint32_t at,
                         std::optional<std::uint32_t> branch) {
    if (!session.wants(DiagnosticCode::ExtraParenthesis)) {
        return;
    }
    const SourceSpan place = session.scanned.span(at, at + 1);
    Diagnostic& diagnostic =
        session.report(DiagnosticCode::ExtraParenthesis, place, "`)` closes no `(`");
    if (!branch) {
        diagnostic.help.emplace_back("write the `(` that it closes, or remove it");
        return;
    }
    const SourceSpan open = session.scanned.span(*branch, *branch + 1);
    diagnostic.labels.push_back({open, "this branch is still open"});
    const std::string_view text = session.scanned.text;
    const char before = *branch == 0 ? '\0' : text[*branch - 1];
    const char inside = next_character(text, *branch + 1);
    const bool may_be_call = std::string_view(" \t\r\n[]):").find(before) == std::string_view::npos;
    const bool has_value = (inside >= 'a' && inside <= 'z') || (inside >= '0' && inside <= '9') ||
                           inside == '{' || inside == '.';
    if (may_be_call && has_value) {
        add_fix(diagnostic, "open the arguments with `(`", open, "(", false);
    }
    add_fix(diagnostic, "close the branch with `]`", place, "]", false);
}

/// Reports an argument without its `(`. Returns whether the current character belongs to one.
bool report_argument_without_open(ParseSession& session) {
    const ScanState& scan = session.scan;
    if (!claim_search(session)) {
        return false;
    }
    const std::string_view text = session.scanned.text;
    const std::optional<std::uint32_t> close = unmatched_parenthesis(text, scan.end);
    if (close) {
        report_missing_open(session, *close, unmatched_branch(text, scan.part_begin, *close));
    }
    return close.has_value();
}

StrayHandling report_stray_number(ParseSession& session, std::string_view text) {
    const ScanState& scan = session.scan;
    const std::string_view all = session.scanned.text;
    const char before = scan.last_end > 0 ? all[scan.last_end - 1] : '\0';
    if (before == '{') {
        if (session.wants(DiagnosticCode::BadRange)) {
            Diagnostic& diagnostic = session.report(
                DiagnosticCode::BadRange, "a random range is allowed only in parentheses");
            diagnostic.help.emplace_back(
                "outside of them `{` and `}` are modules that make a polygon");
        }
        return StrayHandling::SkipRange;
    }
    if (report_argument_without_open(session)) {
        return StrayHandling::Discard;
    }
    if (session.wants(DiagnosticCode::SyntaxError)) {
        Diagnostic& diagnostic =
            session.report(DiagnosticCode::SyntaxError, "a number is not a module");
        const bool after_turn =
            scan.last_end == scan.begin &&
            std::string_view("+-/\\&^!\"'").find(before) != std::string_view::npos;
        if (after_turn) {
            add_fix(diagnostic, "put the argument in parentheses", diagnostic.span,
                    "(" + std::string(text) + ")", true);
        } else {
            diagnostic.help.emplace_back("an argument is written in parentheses: `F(2)`, `+(30)`");
        }
    }
    return StrayHandling::Skip;
}

} // namespace

namespace {

/// The `//` of a likely comment that contains the current character: before it on its line, in the
/// same module list, and followed by a blank.
std::optional<std::uint32_t> comment_before(const ParseSession& session) {
    const ScanState& scan = session.scan;
    const std::string_view text = session.scanned.text;
    constexpr std::uint32_t kMaxLine = 4096;
    const std::uint32_t first = scan.begin - std::min(scan.begin, kMaxLine);
    const std::size_t newline = text.substr(first, scan.begin - first).rfind('\n');
    const std::size_t begin = std::max<std::size_t>(
        scan.part_begin, newline == std::string_view::npos ? first : first + newline + 1);
    const std::size_t slashes = text.substr(0, scan.begin).find("// ", begin);
    return slashes == std::string_view::npos ? std::nullopt
                                             : std::optional(static_cast<std::uint32_t>(slashes));
}

/// Whether only blanks stand between the current character and the `#` of the next statement or the
/// end of the file.
bool is_before_statement(const ParseSession& session) {
    const std::string_view text = session.scanned.text;
    const std::size_t next = text.find_first_not_of(kWhitespace, session.scan.end);
    return next == std::string_view::npos || text[next] == '#';
}

} // namespace

bool report_likely_comment(ParseSession& session) {
    const std::optional<std::uint32_t> slashes = comment_before(session);
    if (slashes && session.wants_reports()) {
        const SourceSpan span = session.scanned.span(*slashes, *slashes + 2);
        const std::string_view all = session.context.sources.file(span.file).text();
        std::string_view line = all.substr(span.begin, all.find('\n', span.begin) - span.begin);
        line = line.substr(0, line.find_last_not_of(" \t\r") + 1);
        report_stray_comment(session.context.diagnostics, line, span, false);
    }
    return slashes.has_value();
}

StrayHandling report_stray_in_modules(ParseSession& session, std::string_view text) {
    const char first = text[0];
    const ScanState& scan = session.scan;
    const bool has_modules = scan.part == Part::Successor || scan.part == Part::Axiom;
    if (has_modules && report_likely_comment(session)) {
        return StrayHandling::Skip;
    }
    if (scan.part == Part::Head) {
        const bool begins_condition = (first == '*' || first == '~') && !scan.part_empty;
        if (report_missing_colon(session, begins_condition ? ": " : "")) {
            return begins_condition ? StrayHandling::InsertColon : StrayHandling::Discard;
        }
    }
    if ((first >= '0' && first <= '9') || first == '.') {
        return report_stray_number(session, text);
    }
    if (first == ',') {
        if (report_argument_without_open(session)) {
            return StrayHandling::Discard;
        }
        const bool ends_statement = has_modules && is_before_statement(session);
        if (session.wants(DiagnosticCode::SyntaxError)) {
            Diagnostic& diagnostic =
                session.report(DiagnosticCode::SyntaxError,
                               ends_statement ? "a statement ends with `;`, not with `,`"
                                              : "modules are written side by side, without commas");
            add_fix(diagnostic, ends_statement ? "write `;`" : "remove it", diagnostic.span,
                    ends_statement ? ";" : "", true);
        }
        return ends_statement ? StrayHandling::EndStatement : StrayHandling::Skip;
    }
    report_foreign_symbol(session, first);
    return StrayHandling::ReadAsModule;
}

Token read_as_module(ParseSession& session, std::string_view name) {
    const SourceSpan span = session.token();
    return Token(Parser::token::TOK_QUOTED, session.builder.intern(name), span);
}

namespace {

/// Explains `~(20)` and `~L`, whose meaning in other programs is clear; returns false for other
/// texts.
bool explain_parameters_or_object(const ParseSession& session,
                                  char symbol,
                                  Diagnostic& diagnostic) {
    const ScanState& scan = session.scan;
    const std::string_view text = session.scanned.text;
    const std::string_view rest = text.substr(scan.end);
    if (rest.empty() || symbol != '~') {
        return false;
    }
    if (rest[0] == '(') {
        const std::size_t close = rest.find_first_of("(),;", 1);
        if (close == std::string_view::npos || rest[close] != ')') {
            return false;
        }
        const std::string angle(rest.substr(1, close - 1));
        const bool is_plain =
            angle.find_first_not_of(
                "0123456789.abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_") ==
            std::string::npos;
        const std::string range =
            "({-" + (is_plain ? angle : "(" + angle + ")") + ", " + angle + "})";
        const SourceSpan span =
            session.scanned.span(scan.begin, scan.end + static_cast<std::uint32_t>(close) + 1);
        diagnostic.help = {"`~(a)` of Houdini turns at random; `+`, `&` and `/` turn about the "
                           "three axes"};
        add_fix(diagnostic, "write `+" + range + " &" + range + " /" + range + "`", span,
                "+" + range + " &" + range + " /" + range, false);
        return true;
    }
    const std::string_view name = leading_word(rest);
    if (name.empty()) {
        return false;
    }
    diagnostic.help = {"`~` of cpfg places a surface; an object bound by `#object " +
                       std::string(name) + " ...;` is placed by its name alone"};
    add_fix(diagnostic, "write `" + std::string(name) + "`", diagnostic.span, "", false);
    return true;
}

} // namespace

void report_foreign_symbol(ParseSession& session, char symbol) {
    if (!session.wants(DiagnosticCode::UnknownCharacter)) {
        return;
    }
    Diagnostic& diagnostic =
        session.report(DiagnosticCode::UnknownCharacter,
                       std::string("`") + symbol + "` is not a module of this language");
    for (const ForeignSymbol& foreign : kForeignSymbols) {
        if (foreign.symbol == symbol) {
            diagnostic.help.emplace_back(foreign.meaning);
        }
    }
    if (symbol == '>' && session.scan.begin > 0 &&
        session.scanned.text[session.scan.begin - 1] == '-') {
        diagnostic.help = {"there is no arrow here: a production is "
                           "`#name : predecessor : condition : successor;`"};
        return;
    }
    if (explain_parameters_or_object(session, symbol, diagnostic)) {
        return;
    }
    const std::string_view text = session.scanned.text;
    const ScanState& scan = session.scan;
    const auto is_gap = [&](char c) {
        return std::string_view(" \t\r\n[]:;").find(c) != std::string_view::npos;
    };
    // Only a symbol that stands alone may be meant as a module.
    const bool stands_alone = scan.begin > 0 && is_gap(text[scan.begin - 1]) &&
                              (scan.end >= text.size() || is_gap(text[scan.end])) &&
                              symbol != '=' && next_character(text, scan.end) != '(';
    if (stands_alone) {
        add_fix(diagnostic, "as a module without meaning of its own, write it in back quotes",
                diagnostic.span, std::string("`") + symbol + "`", false);
    }
}

StrayHandling report_extra_parenthesis(ParseSession& session) {
    const ScanState& scan = session.scan;
    const std::string_view text = session.scanned.text;
    const std::optional<std::uint32_t> branch =
        claim_search(session) ? unmatched_branch(text, scan.part_begin, scan.begin) : std::nullopt;
    if (branch) {
        report_missing_open(session, scan.begin, branch);
        // In a head, reading the `)` as `]` would make a branch of the predecessor: illegal.
        return scan.part == Part::Head ? StrayHandling::Discard : StrayHandling::ReadAsModule;
    }
    if (character_before(text, scan.begin) != ')') {
        report_missing_open(session, scan.begin, std::nullopt);
        return StrayHandling::Discard;
    }
    if (session.wants(DiagnosticCode::ExtraParenthesis)) {
        const bool is_one = scan.end - scan.begin == 1;
        Diagnostic& diagnostic =
            session.report(DiagnosticCode::ExtraParenthesis,
                           is_one ? "`)` closes no `(`" : "these `)` close no `(`");
        add_fix(diagnostic, is_one ? "remove it" : "remove them", diagnostic.span, "", true);
    }
    return StrayHandling::Skip;
}

bool report_colour_symbol(ParseSession& session) {
    const ScanState& scan = session.scan;
    if ((scan.part != Part::Successor && scan.part != Part::Axiom) || scan.skipping ||
        !scan.open.empty() || next_character(session.scanned.text, scan.end) != '(') {
        return false;
    }
    if (session.wants(DiagnosticCode::StraySemicolon)) {
        Diagnostic& diagnostic = session.report(DiagnosticCode::StraySemicolon,
                                                "`;` ends the statement, but parameters follow");
        const std::string_view rest = session.scanned.text.substr(scan.end);
        const std::string arguments(rest.substr(0, std::min(rest.find(')'), rest.size() - 1) + 1));
        add_fix(diagnostic, "`;` of cpfg and L-Py sets the colour: write `'" + arguments + "`",
                diagnostic.span, "'", false);
    }
    return true;
}

void check_quoted_text(ParseSession& session, std::string_view text) {
    for (std::size_t at = 0; at < text.size();) {
        const CodePoint point = decode_utf8(text.substr(at));
        if ((point.value < 0x20 || (point.value >= 0x7F && point.value <= 0xA0)) &&
            session.wants(DiagnosticCode::BadQuotedName)) {
            const auto begin = session.scan.begin + static_cast<std::uint32_t>(at);
            session.report(DiagnosticCode::BadQuotedName,
                           session.scanned.span(begin, begin + point.length),
                           "a control character is not a module");
            return;
        }
        at += point.length;
    }
}

NameId quoted_name(ParseSession& session, std::string_view text, SourceSpan span) {
    const std::string_view name = text.substr(1, text.size() - 2);
    std::size_t count = 0;
    bool printable = true;
    for (std::size_t at = 0; at < name.size() && count <= kMaxQuotedNameLength;) {
        const CodePoint point = decode_utf8(name.substr(at));
        printable =
            printable && point.value > 0x20 && !(point.value >= 0x7F && point.value <= 0xA0);
        at += point.length;
        ++count;
    }
    if ((count == 0 || count > kMaxQuotedNameLength || !printable) &&
        session.wants(DiagnosticCode::BadQuotedName)) {
        Diagnostic& diagnostic = session.report(
            DiagnosticCode::BadQuotedName, span,
            count == 0   ? "there is no name between the back quotes"
            : !printable ? "a name in back quotes has no blanks and no control characters"
                         : "a name in back quotes has at most 16 characters");
        diagnostic.help.emplace_back("back quotes are for symbols that only other programs have, "
                                     "such as `` `;` ``");
    }
    return session.builder.intern(name);
}

void report_unclosed_back_quote(ParseSession& session) {
    if (session.wants(DiagnosticCode::UnclosedQuote)) {
        Diagnostic& diagnostic = session.report(DiagnosticCode::UnclosedQuote,
                                                "this back quote is not closed on its line");
        diagnostic.help.emplace_back("put a symbol of another program between two of them: "
                                     "`` `;` ``");
    }
}

Token unclosed_quote(ParseSession& session) {
    if (session.wants(DiagnosticCode::UnclosedQuote)) {
        Diagnostic& diagnostic =
            session.report(DiagnosticCode::UnclosedQuote, "this name is not closed on its line");
        const std::string_view text = session.scanned.text;
        const std::size_t line_end = std::min(text.find('\n', session.scan.end), text.size());
        const std::size_t semicolon = text.rfind(';', line_end);
        if (semicolon != std::string_view::npos && semicolon > session.scan.end) {
            const SourceSpan place = session.scanned.after(static_cast<std::uint32_t>(semicolon));
            add_fix(diagnostic, "add `\"`", place, "\"", false);
        }
    }
    return discard_statement(session);
}

int run_before_star(std::string_view text) {
    std::size_t length = text.size() - 1;
    if (text[length - 1] == '/') {
        --length;
        while (length > 0 && (text[length - 1] == ' ' || text[length - 1] == '\t' ||
                              text[length - 1] == '\r' || text[length - 1] == '\n')) {
            --length;
        }
    }
    return static_cast<int>(length);
}

void control_characters(ParseSession& session) {
    ScanState& scan = session.scan;
    const bool continues = scan.control_end == scan.begin && scan.begin != 0;
    scan.control_end = scan.end;
    if (continues || session.silent ||
        !session.context.diagnostics.admits(DiagnosticCode::UnknownCharacter)) {
        return;
    }
    const std::string_view text = session.match_text();
    session.report(DiagnosticCode::UnknownCharacter,
                   "a control character, `" + shown(text) + "`, has no meaning in a grammar");
}

void report_unclosed_comment(ParseSession& session) {
    ScanState& scan = session.scan;
    if (!session.silent && session.context.diagnostics.admits(DiagnosticCode::UnclosedComment)) {
        Diagnostic& diagnostic =
            session.report(DiagnosticCode::UnclosedComment,
                           session.scanned.span(scan.comment_begin, scan.comment_begin + 2),
                           "this comment is never closed");
        const std::string_view text = session.scanned.text;
        const std::size_t line = std::min(text.find('\n', scan.comment_begin), text.size());
        const std::size_t last = text.find_last_not_of(" \t\r", line - 1);
        diagnostic.help.emplace_back("a comment ends with `*/`; everything after this one is lost");
        if (text[last] == '*' && last > scan.comment_begin + 1) {
            add_fix(diagnostic, "is this `*` meant to be its end?",
                    session.scanned.after(static_cast<std::uint32_t>(last) + 1), "/", false);
        }
    }
    session.builder.mark_incomplete();
    session.failed = true;
}

namespace {

/// The next word of `text`, between blanks, commas and line ends; removes it.
std::string_view take_word(std::string_view& text) {
    constexpr std::string_view kGaps = " \t\r\n,";
    text.remove_prefix(std::min(text.find_first_not_of(kGaps), text.size()));
    const std::string_view word = text.substr(0, text.find_first_of(kGaps));
    text.remove_prefix(word.size());
    return word;
}

/// Reads `lsc: allow CODE, CODE` of a comment.
void read_allowances(ParseSession& session) {
    const std::uint32_t begin = session.scan.comment_begin;
    const std::string_view comment = session.scanned.text.substr(begin, session.scan.end - begin);
    std::string_view rest = comment.substr(std::min<std::size_t>(2, comment.size()));
    if (comment.starts_with("/*") && rest.ends_with("*/")) {
        rest.remove_suffix(2);
    }
    if (take_word(rest) != "lsc:" || take_word(rest) != "allow") {
        return;
    }
    std::size_t count = 0;
    for (std::string_view word = take_word(rest); !word.empty(); word = take_word(rest), ++count) {
        const std::optional<std::string> reason = reason_against_level(word);
        if (!reason) {
            session.allowed.push_back(*find_diagnostic_code(word));
        } else if (session.context.diagnostics.admits(DiagnosticCode::UnknownCode)) {
            const std::uint32_t at =
                static_cast<std::uint32_t>(word.data() - session.scanned.text.data());
            Diagnostic& diagnostic = session.context.diagnostics.add(
                DiagnosticCode::UnknownCode,
                session.scanned.span(at, at + static_cast<std::uint32_t>(word.size())), *reason);
            diagnostic.help.emplace_back("messages end with their code, for example "
                                         "`[idle-module]`; `lsc explain` lists all");
        }
    }
    if (count == 0 && session.context.diagnostics.admits(DiagnosticCode::UnknownCode)) {
        session.context.diagnostics.add(DiagnosticCode::UnknownCode,
                                        session.scanned.span(begin, session.scan.end),
                                        "this comment allows nothing: a code is missing");
    }
}

} // namespace

void keep_comment(ParseSession& session) {
    if (!session.silent) {
        read_allowances(session);
    }
    if (session.comments != nullptr) {
        session.comments->push_back({session.scan.comment_begin, session.scan.end});
    }
}

} // namespace lsys::lsys_grammar
