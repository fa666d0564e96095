// SPDX-License-Identifier: MIT
#include "grammar/lsys/impl/statement_tokens.h"

#include "grammar/ast/reports.h"
#include "grammar/base/characters.h"
#include "grammar/base/local_values.h"
#include "grammar/base/synonyms.h"
#include "grammar/lsys/impl/bracket_search.h"
#include "grammar/lsys/impl/lookahead.h"
#include "grammar/lsys/impl/module_tokens.h"
#include "grammar/lsys/impl/normalized_text.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace lsys::lsys_grammar {

namespace {

constexpr const char* kFourParts =
    "a production has four parts: `#name : predecessor : condition : successor;`, with `*` for no "
    "condition";

/// Tokens by Keyword.
constexpr std::array<Token::Kind, 20> kKeywordTokens{
    Parser::token::TOK_LABEL,     Parser::token::TOK_N,         Parser::token::TOK_DEFINE,
    Parser::token::TOK_PARAM,     Parser::token::TOK_FUNCTION,  Parser::token::TOK_CURVE,
    Parser::token::TOK_CONTOUR,   Parser::token::TOK_MATERIAL,  Parser::token::TOK_SENSE,
    Parser::token::TOK_MODULE,    Parser::token::TOK_OBJECT,    Parser::token::TOK_INCLUDE,
    Parser::token::TOK_SET,       Parser::token::TOK_IGNORE,    Parser::token::TOK_CONSIDER,
    Parser::token::TOK_DECOMPOSE, Parser::token::TOK_INTERPRET, Parser::token::TOK_DOWN,
    Parser::token::TOK_UP,        Parser::token::TOK_W};

Token keyword_token(ParseSession& session, std::string_view word, SourceSpan span) {
    const Keyword keyword = session.scan.keyword;
    return keyword == Keyword::Label
               ? Token(Parser::token::TOK_LABEL, session.builder.intern(word), span)
               : Token(kKeywordTokens[static_cast<std::size_t>(keyword)], span);
}

/// The part after `#word`, where `next` is the next character.
Part part_after(Keyword keyword, char next) {
    if (next != ':') {
        if (keyword == Keyword::Module) {
            return Part::Declaration;
        }
        if (keyword == Keyword::Object || keyword == Keyword::Include) {
            return Part::ObjectName;
        }
        if (keyword == Keyword::Material) {
            return Part::Setting;
        }
    }
    return Part::Opening;
}

/// Resets what the scanner knows of the previous statement.
void open_statement(ParseSession& session, Keyword keyword) {
    ScanState& scan = session.scan;
    scan.keyword = keyword;
    scan.statement_open = true;
    scan.statement_begin = scan.begin;
    scan.has_locals = false;
    scan.colons.reset();
    scan.skipping = false;
    scan.sign_explained = false;
    session.failed = false;
    scan.semicolon_inserted = false;
    scan.open.clear();
    scan.open_braces = 0;
    scan.chain = 0;
    scan.depth = 0;
}

/// The number of `:` of the statement, counted once per statement.
std::uint32_t colons_of_statement(ParseSession& session) {
    ScanState& scan = session.scan;
    if (!scan.colons) {
        scan.colons = count_colons(session.scanned.text, scan.statement_begin);
    }
    return *scan.colons;
}

/// The text after the `;` at `at`, up to the next `;` or statement.
std::string_view text_after_semicolon(std::string_view text, std::size_t at) {
    const std::size_t begin = at + 1;
    constexpr std::size_t kMaxLength = 4096;
    const std::string_view rest = text.substr(begin, kMaxLength);
    return rest.substr(0, rest.find_first_of(";#"));
}

/// Whether the `;` at `at` is a mistyped `:`: the text up to the next `;` begins with neither a
/// statement nor a comment and has exactly `missing` colons.
bool is_mistyped_colon(std::string_view text, std::size_t at, std::ptrdiff_t missing) {
    const std::string_view rest = text_after_semicolon(text, at);
    const std::size_t first = rest.find_first_not_of(kWhitespace);
    const bool is_ended = at + 1 + rest.size() < text.size() && text[at + 1 + rest.size()] == ';';
    return is_ended && first != std::string_view::npos && rest.substr(first, 2) != "//" &&
           rest.substr(first, 2) != "/*" && std::count(rest.begin(), rest.end(), ':') == missing;
}

/// Whether a `;` follows the `#word` in place of its `:`.
bool lacks_first_colon(const ParseSession& session) {
    const std::string_view text = session.scanned.text;
    const std::size_t next = text.find_first_not_of(kWhitespace, session.scan.end);
    if (next == std::string_view::npos || text[next] != ';') {
        return false;
    }
    const Keyword keyword = session.scan.keyword;
    return keyword == Keyword::Label ? is_mistyped_colon(text, next, 2)
                                     : is_mistyped_colon(text, next, 0);
}

/// Enters the part that follows the `#word`, before the character `next`.
Token begin_parts(ParseSession& session, std::string_view word, char next) {
    ScanState& scan = session.scan;
    const SourceSpan span = session.token();
    scan.enter(part_after(scan.keyword, next));
    return keyword_token(session, word, span);
}

/// `#angle 30;`: reports the missing `set` and continues after the `#`.
Token setting_without_set(ParseSession& session, std::string_view word) {
    ScanState& scan = session.scan;
    const std::uint32_t key_begin = scan.end - static_cast<std::uint32_t>(word.size());
    if (session.wants(DiagnosticCode::UnknownStatement)) {
        const SourceSpan span = session.match();
        const std::string name(word);
        Diagnostic& diagnostic = session.report(DiagnosticCode::UnknownStatement, span,
                                                "there is no statement `#" + name + "`");
        const SourceSpan place{span.file, session.scanned.source_begin(key_begin),
                               session.scanned.source_begin(key_begin)};
        const std::string_view text = session.scanned.text;
        const char next = next_character(text, scan.end);
        if (next == '=' || next == ':') {
            const auto sign = static_cast<std::uint32_t>(text.find(next, scan.end));
            const std::size_t value =
                std::min(text.find_first_not_of(" \t", sign + 1), text.size());
            const std::size_t end = std::min(text.find_first_of(";\n", value), text.size());
            const SourceSpan gap =
                session.scanned.span(scan.end, static_cast<std::uint32_t>(value));
            diagnostic.fixes.push_back({"a setting is written `#set " + name + " " +
                                            std::string(text.substr(value, end - value)) + ";`",
                                        {{place, "set "}, {gap, " "}},
                                        true});
            scan.sign_explained = true;
        } else {
            add_fix(diagnostic, "a setting is written `#set " + name + "`", place, "set ", true);
        }
    }
    scan.keyword = Keyword::Set;
    scan.end = key_begin; // reads the key again
    return begin_parts(session, spelling(Keyword::Set), word.front());
}

/// The key of the `#set` statement that replaces a word of another program; empty if there is none.
std::string_view meant_setting(const Synonym* synonym) {
    constexpr std::string_view kSet = "#set ";
    return synonym != nullptr && synonym->spelling.starts_with(kSet)
               ? synonym->spelling.substr(kSet.size())
               : std::string_view{};
}

/// Explains `#homomorphism;`, which begins a part of the file in other programs.
void explain_section(const ParseSession& session, Keyword meant, Diagnostic& diagnostic) {
    const std::string_view text = session.scanned.text;
    const std::size_t hash = text.find('#', session.scan.end);
    const std::size_t begin =
        hash == std::string_view::npos ? text.size() : text.find_first_not_of(" \t", hash + 1);
    const std::size_t end =
        std::min(text.find_first_of(";\n", std::min(begin, text.size())), text.size());
    const std::string name = "#" + std::string(spelling(meant));
    const std::string_view next =
        begin < end ? text.substr(begin, end - begin) : std::string_view("p : A : * : B");
    diagnostic.help.push_back("a file has no parts: remove this line, and write the productions "
                              "after it `" +
                              name + " " + std::string(next) + ";`");
}

/// Reports `#word`, which is not a statement; returns the keyword that is meant, if that is
/// certain.
std::optional<Keyword> report_unknown_statement(ParseSession& session, std::string_view word) {
    const Synonym* const synonym = find_synonym(SynonymKind::Statement, word);
    const std::string_view setting = meant_setting(synonym);
    std::optional<Keyword> meant;
    if (synonym != nullptr) {
        meant = keyword_of(*synonym);
    } else {
        meant = nearest_keyword(word);
    }
    const bool is_section = meant && names_production(*meant) && synonym != nullptr &&
                            next_character(session.scanned.text, session.scan.end) == ';';
    if (!session.wants(DiagnosticCode::UnknownStatement)) {
        return is_section ? std::nullopt : meant;
    }
    const SourceSpan span = session.match();
    const std::string written = "#" + shown(word);
    Diagnostic& diagnostic = session.report(DiagnosticCode::UnknownStatement, span,
                                            "there is no statement `" + written + "`");
    if (is_section) {
        explain_section(session, *meant, diagnostic);
        return std::nullopt;
    }
    if (meant) {
        const std::string name = "#" + std::string(spelling(*meant));
        // In `#defin ed 5` and `#definee d 5` the blank may be in the wrong place.
        const bool may_be_moved =
            spelling(*meant) == word.substr(0, word.size() - 1) ||
            spelling(*meant) ==
                std::string(word) + next_character(session.scanned.text, session.scan.end);
        add_fix(diagnostic,
                synonym == nullptr || synonym->source.empty() ? "did you mean `" + name + "`?"
                                                              : help_for(*synonym, written),
                span, name, !may_be_moved);
    } else if (!setting.empty()) {
        add_fix(diagnostic, help_for(*synonym, written), span, std::string(synonym->spelling),
                false);
    } else if (synonym != nullptr) {
        diagnostic.help.push_back(help_for(*synonym, written));
    } else if (const std::optional<std::string_view> key = nearest_setting(word)) {
        const std::string name = "#set " + std::string(*key);
        add_fix(diagnostic, "did you mean `" + name + "`?", span, name, false);
    } else {
        diagnostic.help.emplace_back(
            "statements are `#n`, `#define`, `#param`, `#function`, "
            "`#curve`, `#contour`, `#material`, `#sense`, `#module`, "
            "`#object`, `#include`, `#set`, `#ignore :`, `#consider :`, `#w :`, "
            "`#decompose`, `#interpret`, `#down`, `#up` and productions, "
            "`#name : ...`");
    }
    return meant;
}

/// The token of a `#word` that is neither a keyword nor followed by `:`.
Token unknown_statement(ParseSession& session, std::string_view word, char next) {
    ScanState& scan = session.scan;
    if (colons_of_statement(session) >= 2 || lacks_first_colon(session)) {
        return begin_parts(session, word,
                           next); // the missing or mistyped `:` is reported where it is scanned
    }
    if (is_setting(word) && session.scanned.text[scan.begin] == '#') {
        return setting_without_set(session, word);
    }
    const std::optional<Keyword> meant = report_unknown_statement(session, word);
    if (!meant) {
        return discard_statement(session);
    }
    scan.keyword = *meant;
    return begin_parts(session, spelling(*meant), next);
}

/// Whether the statement is an axiom under another name: `#axiom : ...;` has only one `:`.
bool is_axiom_by_another_name(ParseSession& session, std::string_view word) {
    return is_synonym(word, Keyword::Axiom) && colons_of_statement(session) == 1;
}

/// Whether the next character is the only `:` of the statement, and a number, which cannot begin a
/// predecessor, follows it.
bool is_number_after_colon(ParseSession& session) {
    const std::string_view text = session.scanned.text;
    const std::size_t colon = text.find(':', session.scan.end);
    if (colons_of_statement(session) != 1 || colon == std::string_view::npos) {
        return false;
    }
    const char next = next_character(text, static_cast<std::uint32_t>(colon) + 1);
    return is_digit(next) || next == '.' || next == '(';
}

Token start_with_keyword(ParseSession& session, std::string_view word) {
    ScanState& scan = session.scan;
    open_statement(session, find_keyword(word));
    const char next = next_character(session.scanned.text, scan.end);
    if (scan.keyword == Keyword::Label && next != ':') {
        return unknown_statement(session, word, next);
    }
    if (scan.keyword == Keyword::Label && is_setting(word) &&
        session.scanned.text[scan.begin] == '#' && is_number_after_colon(session)) {
        return setting_without_set(session, word);
    }
    if (scan.keyword == Keyword::Label && is_axiom_by_another_name(session, word)) {
        if (session.wants(DiagnosticCode::UnknownStatement)) {
            const SourceSpan span = session.match();
            Diagnostic& diagnostic = session.report(DiagnosticCode::UnknownStatement, span,
                                                    "there is no statement `#" + shown(word) + "`");
            add_fix(diagnostic, "the axiom is `#w`", span, "#w", true);
        }
        scan.keyword = Keyword::Axiom;
    }
    return begin_parts(session, word, next);
}

} // namespace

bool report_hash_comment(ParseSession& session, std::string_view text) {
    const ScanState& scan = session.scan;
    const std::size_t name_begin = text.find_first_not_of(" \t", 1);
    const std::string_view word = text.substr(name_begin);
    const std::string_view all = session.scanned.text;
    const char next = next_character(all, scan.end);
    if (name_begin == 1 || find_keyword(word) != Keyword::Label || next == ':' || next == '=') {
        return false;
    }
    const std::string_view line = all.substr(scan.begin, all.find('\n', scan.begin) - scan.begin);
    if (line.find_first_of(":;") != std::string_view::npos) {
        return false; // a statement is more likely
    }
    if (!session.silent && session.context.diagnostics.admits(DiagnosticCode::UnknownStatement)) {
        const SourceSpan hash = session.scanned.span(scan.begin, scan.begin + 1);
        Diagnostic& diagnostic = session.report(DiagnosticCode::UnknownStatement, hash,
                                                "`#` begins a statement, not a comment");
        add_fix(diagnostic, "a comment begins with `//`", hash, "//", false);
    }
    return true;
}

Token start_statement(ParseSession& session, std::string_view text) {
    session.scan.first_diagnostic = session.context.diagnostics.all().size();
    normalize_after_word(session);
    const std::size_t name_begin = text.find_first_not_of(" \t", 1);
    if (name_begin > 1) {
        const ScanState& scan = session.scan;
        if (!session.silent && session.context.diagnostics.admits(DiagnosticCode::SplitOperator)) {
            Diagnostic& diagnostic = session.report(DiagnosticCode::SplitOperator,
                                                    "there is a blank between `#` and its word");
            add_fix(diagnostic, "remove the blank",
                    session.scanned.span(scan.begin + 1,
                                         scan.begin + static_cast<std::uint32_t>(name_begin)),
                    "", true);
        }
    }
    return start_with_keyword(session, text.substr(name_begin));
}

Token start_without_hash(ParseSession& session, std::string_view word) {
    ScanState& scan = session.scan;
    const std::string_view text = session.scanned.text;
    const Keyword keyword = find_keyword(word);
    const char next = word.empty() ? '\0' : next_character(text, scan.end);
    const bool takes_words =
        keyword == Keyword::Define || keyword == Keyword::Param || keyword == Keyword::Function ||
        keyword == Keyword::Curve || keyword == Keyword::Contour || keyword == Keyword::Set ||
        keyword == Keyword::Material || keyword == Keyword::Sense || keyword == Keyword::Object ||
        keyword == Keyword::Include || keyword == Keyword::Module || names_production(keyword);
    const bool is_statement = !word.empty() && (next == ':' || takes_words ||
                                                (keyword == Keyword::Generations && next == '='));
    const bool after_statement = // on the line of a statement, after its `;`
        scan.part == Part::Between && scan.last_end != 0 &&
        text.substr(scan.last_end, scan.begin - scan.last_end).find('\n') == std::string_view::npos;
    const bool after_modules =
        after_statement && (scan.keyword == Keyword::Label || scan.keyword == Keyword::Axiom);
    // Text after a `;` may belong to the statement before it; then the `;` and the fixes of that
    // statement are wrong. So first_diagnostic stays the index of the first diagnostic of that
    // statement, whose fixes become offers if this text is an error. A statement after a statement
    // with an error may belong to it, too.
    if (!after_statement || (is_statement && !session.context.diagnostics.has_doubtful_error_from(
                                                 scan.first_diagnostic))) {
        scan.first_diagnostic = session.context.diagnostics.all().size();
    }
    if (!session.silent && session.context.diagnostics.admits(DiagnosticCode::MissingHash)) {
        const SourceSpan span = session.match();
        const bool is_nameless = text[scan.begin] == '#' && next_character(text, scan.end) == ':';
        Diagnostic& diagnostic =
            session.report(DiagnosticCode::MissingHash, span,
                           is_nameless ? "a production has a name between `#` and `:`"
                                       : "a statement begins with `#`");
        if (is_nameless) {
            add_fix(diagnostic, "give it a name, for example `p`", {span.file, span.end, span.end},
                    "p", false);
        } else if (is_statement) {
            add_fix(diagnostic, "write `#" + shown(word) + "`", {span.file, span.begin, span.begin},
                    "#", true);
        } else if (after_modules) {
            diagnostic.labels.push_back({session.scanned.span(scan.last_end - 1, scan.last_end),
                                         "this `;` ends the statement"});
            diagnostic.help.emplace_back("if it is meant as a module, as in other programs, write "
                                         "it in back quotes: `` `;` ``");
        } else {
            diagnostic.help.emplace_back(
                "for example `#w : F;` or `#grow : F : * : F F;`; a comment is `// ...` or "
                "`/* ... */`");
        }
    }
    if (is_statement) {
        return start_with_keyword(session, word);
    }
    open_statement(session, Keyword::Label);
    return discard_statement(session);
}

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

namespace {

/// The part after the `:` that ends at scan.end.
Part part_after_colon(const ParseSession& session) {
    const ScanState& scan = session.scan;
    switch (scan.part) {
    case Part::Probability:
        return Part::Axiom;
    case Part::Head:
        return Part::Condition;
    case Part::Condition:
        return begins_local_values(session.scanned.text, scan.end) ? Part::Locals : Part::Successor;
    default:
        return Part::Successor;
    }
}

} // namespace

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

namespace {

void report_unclosed(ParseSession& session) {
    const ScanState& scan = session.scan;
    if (!session.wants(DiagnosticCode::UnclosedParenthesis)) {
        return;
    }
    const OpenBracket& inner = scan.open.back();
    const auto character = [](const OpenBracket& bracket) {
        return bracket.kind == OpenBracket::Kind::Brace ? '{' : '(';
    };
    Diagnostic& diagnostic = session.report(
        DiagnosticCode::UnclosedParenthesis, session.scanned.span(inner.begin, inner.begin + 1),
        std::string("`") + character(inner) + "` is never closed");
    if (scan.open.size() > 1) {
        diagnostic.notes.push_back(std::to_string(scan.open.size()) +
                                   " brackets are open here, one inside the other");
    }
    std::string closing;
    constexpr std::size_t kMaxInserted = 100;
    for (std::size_t i = scan.open.size(); i > 0 && closing.size() < kMaxInserted; --i) {
        closing += scan.open[i - 1].kind == OpenBracket::Kind::Brace ? '}' : ')';
    }
    if (closing.size() == scan.open.size()) {
        add_fix(diagnostic, "add `" + closing + "`", session.insertion_place(), closing, true);
    }
}

/// Whether the predecessor of the current production is one module without contexts, with nothing
/// else before the `:` or `~` after it.
bool has_plain_head(const ParseSession& session) {
    const std::string_view text = session.scanned.text;
    const std::size_t first = text.find(':', session.scan.statement_begin);
    std::size_t at = text.find_first_not_of(kWhitespace, first + 1);
    const std::string_view word = leading_word(text.substr(std::min(at, text.size())));
    at = text.find_first_not_of(kWhitespace, at + std::max<std::size_t>(word.size(), 1));
    if (at != std::string_view::npos && text[at] == '(') {
        at = text.find(')', at);
        at = at == std::string_view::npos ? at : text.find_first_not_of(kWhitespace, at + 1);
    }
    return at != std::string_view::npos && (text[at] == ':' || text[at] == '~');
}

/// Reports an arrow of other languages in the head of a production. Returns whether there is one.
bool report_arrow(const ParseSession& session, Diagnostics& diagnostics) {
    const ScanState& scan = session.scan;
    const std::string_view head =
        session.scanned.text.substr(scan.part_begin, scan.last_end - scan.part_begin);
    for (const std::string_view arrow : {"-->", "==>", "->", "=>"}) {
        const std::size_t at = head.find(arrow);
        if (at != std::string_view::npos && head.find(arrow, at + 1) == std::string_view::npos) {
            const auto begin = static_cast<std::uint32_t>(scan.part_begin + at);
            const SourceSpan span =
                session.scanned.span(begin, begin + static_cast<std::uint32_t>(arrow.size()));
            Diagnostic& diagnostic =
                diagnostics.add(DiagnosticCode::MissingColon, span,
                                "`" + std::string(arrow) + "` of other programs is `: * :` here");
            diagnostic.help.emplace_back(kFourParts);
            add_fix(diagnostic, "write `: * :`", span, ": * :", false);
            return true;
        }
    }
    return false;
}

/// Reports the end of a production before its successor.
void report_missing_parts(ParseSession& session) {
    const ScanState& scan = session.scan;
    if (!session.wants(DiagnosticCode::MissingColon)) {
        return;
    }
    const SourceSpan place = session.insertion_place();
    Diagnostics& diagnostics = session.context.diagnostics;
    if (scan.part == Part::Head) {
        if (report_arrow(session, diagnostics)) {
            return;
        }
        Diagnostic& diagnostic =
            diagnostics.add(DiagnosticCode::MissingColon, place,
                            "the production ends before its condition and its successor");
        diagnostic.help.emplace_back(kFourParts);
        if (scan.keyword == Keyword::Generations) {
            diagnostic.help.emplace_back("the number of generations is `#n = 6;`");
        }
        return;
    }
    if (scan.part == Part::Locals) {
        Diagnostic& diagnostic = diagnostics.add(DiagnosticCode::MissingColon, place,
                                                 "the production ends before its successor");
        diagnostic.help.emplace_back("local values are between two `:`, as in `#grow : A(x) : * "
                                     ": let l = x / 2 : F(l) A(l);`");
        return;
    }
    const std::string_view part =
        session.scanned.text.substr(scan.part_begin, scan.last_end - scan.part_begin);
    const bool is_condition = part.find_first_of("<>=!~&|") != std::string_view::npos ||
                              part.find_first_not_of(" \t\r\n*") == std::string_view::npos;
    if (is_condition) {
        Diagnostic& diagnostic = diagnostics.add(DiagnosticCode::MissingColon, place,
                                                 "the production ends before its successor");
        diagnostic.help.emplace_back(kFourParts);
        return;
    }
    const std::uint32_t first =
        scan.part_begin + static_cast<std::uint32_t>(part.find_first_not_of(kWhitespace));
    Diagnostic& diagnostic =
        diagnostics.add(DiagnosticCode::MissingColon, session.scanned.span(first, scan.last_end),
                        "the production has three parts, not four");
    diagnostic.help.emplace_back(kFourParts);
    const std::uint32_t at = session.scanned.source_begin(first);
    add_fix(diagnostic, "if this is the successor, add the condition `*`",
            {session.scanned.file, at, at}, "* : ", has_plain_head(session));
}

} // namespace

Token begin_insertion(ParseSession& session, Insertion kind, SourceSpan written) {
    ScanState& scan = session.scan;
    scan.inserting = kind;
    scan.pending_span = written;
    if (!scan.skipping && !scan.open.empty()) {
        report_unclosed(session);
    }
    if (kind != Insertion::Colon &&
        (scan.part == Part::Head || scan.part == Part::Condition || scan.part == Part::Locals)) {
        if (!scan.skipping) {
            report_missing_parts(session);
        }
        session.failed = true;
        session.builder.discard_statement();
    }
    return insert_token(session);
}

Token insert_token(ParseSession& session) {
    ScanState& scan = session.scan;
    if (!scan.open.empty()) {
        const SourceSpan place = session.insertion_place();
        switch (scan.pop()) {
        case OpenBracket::Kind::Module:
            return Token(Parser::token::TOK_CLOSE, place).as_inserted();
        case OpenBracket::Kind::Brace:
            return Token(Parser::token::TOK_RBRACE, place).as_inserted();
        case OpenBracket::Kind::Call:
        case OpenBracket::Kind::Group:
            return Token(Parser::token::TOK_RPAREN, place).as_inserted();
        }
    }
    if (scan.inserting == Insertion::Colon) {
        const SourceSpan colon = scan.pending_span;
        scan.inserting = Insertion::None;
        scan.last_end = scan.end;
        scan.enter(part_after_colon(session));
        return Token(Parser::token::TOK_COLON, colon);
    }
    if (scan.part == Part::Condition || scan.part == Part::Locals) {
        scan.enter(Part::Successor);
        return Token(Parser::token::TOK_COLON, session.insertion_place()).as_inserted();
    }
    if (scan.part == Part::Head) {
        scan.enter(Part::Successor); // an empty successor
        return Token(Parser::token::TOK_YYerror, session.insertion_place()).as_inserted();
    }
    if (scan.statement_open) {
        const SourceSpan place = session.insertion_place();
        scan.statement_open = false;
        scan.skipping = false;
        scan.ended_part = std::exchange(scan.part, Part::Between);
        if (scan.inserting == Insertion::Semicolon) {
            scan.inserting = Insertion::None;
            scan.last_end = scan.end;
            return Token(Parser::token::TOK_SEMICOLON, scan.pending_span);
        }
        if (scan.inserting == Insertion::NextStatement) {
            scan.inserting = Insertion::None;
        }
        scan.semicolon_inserted = true;
        return Token(Parser::token::TOK_SEMICOLON, place).as_inserted();
    }
    return Token(Parser::token::TOK_END, session.insertion_place()).as_inserted();
}

Token discard_statement(ParseSession& session) {
    ScanState& scan = session.scan;
    const SourceSpan span = session.token();
    scan.skipping = true;
    session.failed = true;
    session.builder.discard_statement();
    return Token(Parser::token::TOK_YYerror, span);
}

namespace {

/// Whether `text` begins a successor. `text` stands in the place of a condition, and the character
/// `stray` after it cannot occur in a condition. True if `text` is empty and `stray` is a symbol of
/// modules, or if `text` compares nothing and begins with a capital letter, perhaps after `+`, `-`
/// or `/`.
bool begins_successor(std::string_view text, char stray) {
    const std::size_t first = text.find_first_not_of(kWhitespace);
    if (first == std::string_view::npos) {
        return std::string_view("[]+-/\\&^$\"'{}|").find(stray) != std::string_view::npos;
    }
    const std::size_t letter = text.find_first_not_of(" \t\r\n+-/", first);
    return letter != std::string_view::npos && text[letter] >= 'A' && text[letter] <= 'Z' &&
           text.find_first_of("<>=~&|!*") == std::string_view::npos;
}

/// Whether the text from `first` to the current character can only be a successor: none of its
/// words is a parameter of the predecessor, and the current character is a symbol that cannot occur
/// in a condition, without a blank before it.
bool is_surely_successor(const ParseSession& session, std::uint32_t first) {
    const ScanState& scan = session.scan;
    const std::string_view text = session.scanned.text;
    const std::string_view head =
        text.substr(scan.statement_begin, scan.part_begin - scan.statement_begin);
    const std::size_t open = std::min(head.find('('), head.size());
    const std::string_view parameters = head.substr(open);
    for (std::uint32_t at = first; at < scan.begin;) {
        const std::string_view word = leading_word(text.substr(at, scan.begin - at));
        if (text[at] == '(') { // skip arguments, which may name parameters in a successor
            at = static_cast<std::uint32_t>(std::min<std::size_t>(text.find(')', at), scan.begin));
        } else if (!word.empty() && parameters.find(word) != std::string_view::npos) {
            return false;
        }
        at += std::max(static_cast<std::uint32_t>(word.size()), 1U);
    }
    const bool adjacent =
        first == scan.begin ||
        std::string_view(" \t\r\n/").find(text[scan.begin - 1]) == std::string_view::npos;
    return adjacent &&
           std::string_view("[]$\"'").find(text[scan.begin]) != std::string_view::npos &&
           has_plain_head(session);
}

/// Reports a production of three parts whose condition is missing. The current character is the
/// first that cannot occur in a condition.
bool report_missing_condition(ParseSession& session) {
    const ScanState& scan = session.scan;
    const std::string_view text = session.scanned.text;
    const std::string_view before = text.substr(scan.part_begin, scan.begin - scan.part_begin);
    if (scan.part != Part::Condition || !scan.open.empty() || session.failed ||
        colons_of_statement(session) != 2 || !begins_successor(before, text[scan.begin])) {
        return false;
    }
    const auto first =
        scan.part_begin +
        static_cast<std::uint32_t>(std::min(before.find_first_not_of(kWhitespace), before.size()));
    std::size_t end = std::min(text.find_first_of(";\n", scan.begin), text.size());
    end = text.find_last_not_of(kWhitespace, end - 1) + 1;
    Diagnostic& diagnostic = session.report(
        DiagnosticCode::MissingColon,
        session.scanned.span(first, std::max(static_cast<std::uint32_t>(end), scan.end)),
        "the production has three parts, not four");
    diagnostic.help.emplace_back(kFourParts);
    const std::uint32_t at = session.scanned.source_begin(first);
    add_fix(diagnostic, "if this is the successor, add the condition `*`",
            {session.scanned.file, at, at}, "* : ", is_surely_successor(session, first));
    return true;
}

} // namespace

bool report_missing_colon(ParseSession& session, std::string_view inserted) {
    ScanState& scan = session.scan;
    const bool in_production =
        scan.part == Part::Head || scan.part == Part::Condition || scan.part == Part::Locals;
    if (!in_production || colons_of_statement(session) >= (scan.part == Part::Locals ? 4U : 3U)) {
        return false;
    }
    if (inserted.empty() && session.wants(DiagnosticCode::MissingColon) &&
        report_missing_condition(session)) {
        return true;
    }
    if (session.wants(DiagnosticCode::MissingColon)) {
        const SourceSpan place = session.match();
        Diagnostic& diagnostic =
            session.report(DiagnosticCode::MissingColon, place,
                           inserted.empty() ? "the production lacks a `:` before this, or earlier"
                                            : "the production lacks a `:` before this");
        if (!inserted.empty()) {
            // A condition before the `~` may be part of the head.
            add_fix(diagnostic, "add `:`", {place.file, place.begin, place.begin},
                    std::string(inserted),
                    session.scanned.text[scan.begin] == '*' || has_plain_head(session));
        } else if (session.scanned.text[scan.begin] == '=' && scan.part == Part::Head &&
                   colons_of_statement(session) == 1) {
            add_fix(diagnostic, "`=` of other programs is `: * :` here",
                    session.scanned.span(scan.begin, scan.begin + 1), ": * :", false);
        }
        diagnostic.help.emplace_back(kFourParts);
    }
    return true;
}

} // namespace lsys::lsys_grammar
