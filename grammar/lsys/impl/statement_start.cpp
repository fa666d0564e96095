// SPDX-License-Identifier: MIT
#include "grammar/lsys/impl/statement_start.h"

#include "grammar/ast/reports.h"
#include "grammar/base/characters.h"
#include "grammar/base/synonyms.h"
#include "grammar/lsys/impl/lookahead.h"
#include "grammar/lsys/impl/normalized_text.h"
#include "grammar/lsys/impl/statement_facts.h"
#include "grammar/lsys/impl/statement_insertions.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>

namespace lsys::lsys_grammar {

namespace {

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
    // statement, whose fixes become offers if this text is an error. The same holds for text that
    // is a statement, if the statement before it has an error without a certain fix.
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

} // namespace lsys::lsys_grammar
