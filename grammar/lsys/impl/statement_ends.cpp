// SPDX-License-Identifier: MIT
#include "grammar/lsys/impl/statement_ends.h"

#include "grammar/base/characters.h"
#include "grammar/base/synonyms.h"
#include "grammar/lsys/impl/lookahead.h"

#include <algorithm>
#include <string>
#include <vector>

namespace lsys::lsys_grammar {

namespace {

/// Maximum bytes of a text that is searched for words; in a larger text repairs are offers.
constexpr std::size_t kMaxSearchedText = std::size_t{1} << 17;
/// Maximum bytes at the end of a statement that are searched for comments.
constexpr std::size_t kMaxSearchedStatement = 4096;
/// Maximum words of a comment that are searched for in the text.
constexpr std::size_t kMaxWords = 16;

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r';
}

std::size_t line_end(std::string_view text, std::size_t at) {
    std::size_t end = std::min(text.find('\n', at), text.size());
    return end > at && text[end - 1] == '\r' ? end - 1 : end;
}

/// Whether `word` occurs in `text` outside of [begin, end) and of `//` comments.
bool occurs_elsewhere(std::string_view text,
                      std::string_view word,
                      std::size_t begin,
                      std::size_t end) {
    const auto continues_word = [&](std::size_t at) {
        return at < text.size() && is_word_character(text[at]);
    };
    for (std::size_t at = text.find(word); at != std::string_view::npos;
         at = text.find(word, at + word.size())) {
        if ((at >= begin && at < end) || (at > 0 && continues_word(at - 1)) ||
            continues_word(at + word.size())) {
            continue;
        }
        const std::size_t newline = at == 0 ? std::string_view::npos : text.rfind('\n', at - 1);
        const std::size_t line = newline == std::string_view::npos ? 0 : newline + 1;
        if (text.substr(line, at - line).find("//") == std::string_view::npos) {
            return true;
        }
    }
    return false;
}

/// Whether a word of `text`[begin, end) occurs nowhere else in the text; such a word is not the
/// name of a module.
bool has_foreign_word(std::string_view text, std::size_t begin, std::size_t end, bool letters) {
    if (text.size() > kMaxSearchedText) {
        return false;
    }
    // If letters are modules, a short sequence may be meant as modules.
    const std::size_t shortest = letters ? 3 : 2;
    std::size_t word_count = 0;
    for (std::size_t at = begin; at < end && word_count < kMaxWords;) {
        const std::size_t first = at;
        while (at < end && is_letter(text[at])) {
            ++at;
        }
        const std::string_view word = text.substr(first, at - first);
        at += word.empty() ? 1u : 0u;
        if (word.size() < shortest ||
            (letters &&
             std::none_of(word.begin(), word.end(), [](char c) { return c >= 'a' && c <= 'z'; }))) {
            continue;
        }
        ++word_count;
        if (!occurs_elsewhere(text, word, begin, end)) {
            return true;
        }
    }
    return false;
}

/// The `//` among the modules [begin, end) that may begin comments: after a blank, and before a
/// blank or, if words are modules, a letter.
std::vector<std::uint32_t>
likely_comments(std::string_view text, std::uint32_t begin, std::uint32_t end, bool letters) {
    std::vector<std::uint32_t> found;
    for (std::uint32_t at = begin; at + 1 < end;) {
        if (text[at] == '`') {
            const std::size_t close = text.find_first_of("`\n", at + 1);
            at = static_cast<std::uint32_t>(std::min<std::size_t>(close, end - 1)) + 1;
        } else if (text.substr(at, 2) == "/*") {
            at = static_cast<std::uint32_t>(std::min<std::size_t>(comment_end(text, at), end));
        } else if (text.substr(at, 2) == "//") {
            const bool after_blank = at == begin || is_blank(text[at - 1]) || text[at - 1] == '\n';
            const char next = at + 2 < text.size() ? text[at + 2] : '\n';
            if (after_blank && (is_blank(next) || next == '\n' || (!letters && is_letter(next)))) {
                found.push_back(at);
                at = static_cast<std::uint32_t>(line_end(text, at));
            } else {
                while (at < end && text[at] == '/') {
                    ++at;
                }
            }
        } else {
            ++at;
        }
    }
    return found;
}

bool is_number_part(char c) {
    return is_digit(c) || c == '.';
}

/// Whether the statement may end before the current `//`, and the next statement or the end of the
/// file follows the comment.
bool lacks_only_semicolon(const ParseSession& session) {
    const ScanState& scan = session.scan;
    const bool is_whole = scan.part == Part::Value
                              ? scan.value_before
                              : scan.part != Part::Condition && !scan.part_empty;
    if (!is_whole || !scan.open.empty()) {
        return false;
    }
    const std::string_view text = session.scanned.text;
    const std::size_t next = skip_gaps_between_statements(text, scan.begin);
    return next == text.size() ||
           (text[next] == '#' && begins_statement(text, static_cast<std::uint32_t>(next)));
}

} // namespace

std::optional<LikelyComment>
comment_after_modules(std::string_view text, std::uint32_t begin, std::uint32_t end, bool letters) {
    if (end - begin > kMaxSearchedStatement) {
        begin = static_cast<std::uint32_t>(end - kMaxSearchedStatement);
    }
    const std::vector<std::uint32_t> comments = likely_comments(text, begin, end, letters);
    if (comments.empty() || line_end(text, comments.back()) < end) {
        return std::nullopt;
    }
    // Comment lines belong to the comment before them.
    std::size_t first = comments.size() - 1;
    while (first > 0 && is_first_on_line(text, comments[first])) {
        const std::size_t previous_end = line_end(text, comments[first - 1]);
        if (text.find_first_not_of(kWhitespace, previous_end) != comments[first]) {
            break;
        }
        --first;
    }
    const std::uint32_t comment = comments[first];
    const std::size_t before =
        comment == 0 ? std::string_view::npos : text.find_last_not_of(kWhitespace, comment - 1);
    if (before == std::string_view::npos || before + 1 < begin) {
        return std::nullopt;
    }
    // The comment is uncertain if its line has parentheses or `/* ... */`, whose words name no
    // modules, or brackets or several rolls, `////`, which are modules.
    const std::string_view line = text.substr(comment, line_end(text, comment) - comment);
    const bool may_be_modules = line.find_first_of("()[]{}") != std::string_view::npos ||
                                line.find("/*") != std::string_view::npos ||
                                line.starts_with("////");
    return LikelyComment{comment, first == 0 && !may_be_modules &&
                                      has_foreign_word(text, comment, end, letters)};
}

void report_missing_semicolon(ParseSession& session) {
    if (!session.wants(DiagnosticCode::MissingSemicolon)) {
        return;
    }
    const ScanState& scan = session.scan;
    const std::string_view text = session.scanned.text;
    std::optional<LikelyComment> comment;
    if (scan.ended_part == Part::Successor || scan.ended_part == Part::Axiom) {
        comment = comment_after_modules(text, scan.part_begin, scan.last_end,
                                        session.builder.module_names() != ModuleNames::Words);
    }
    SourceSpan place = session.insertion_place();
    if (comment) {
        session.builder.remove_slashes(comment->begin);
        const std::size_t last = text.find_last_not_of(kWhitespace, comment->begin - 1);
        place = session.scanned.after(static_cast<std::uint32_t>(last) + 1);
    }
    Diagnostic& diagnostic = session.report(DiagnosticCode::MissingSemicolon, place,
                                            "`;` is missing at the end of a statement");
    if (scan.inserting != Insertion::EndOfFile) {
        diagnostic.labels.push_back(
            {session.scanned.span(scan.next_statement, scan.next_statement + 1),
             "the next statement begins here"});
    }
    if (!comment) {
        add_fix(diagnostic, "add `;`", place, ";", true);
        return;
    }
    diagnostic.labels.push_back(
        {session.scanned.span(comment->begin, comment->begin + 2),
         comment->certain ? "a comment begins here" : "a comment may begin here"});
    add_fix(diagnostic, "add `;` before the comment", place, ";", comment->certain);
    if (!comment->certain) {
        add_fix(diagnostic, "if no comment is meant, add `;` at the end", session.insertion_place(),
                ";", false);
    }
}

bool is_quotient(std::string_view text, std::uint32_t at) {
    const auto skip_blanks = [&](std::size_t from) {
        while (from < text.size() && is_blank(text[from])) {
            ++from;
        }
        return from;
    };
    const std::size_t begin = skip_blanks(at);
    std::size_t end = begin;
    while (end < text.size() && (is_letter(text[end]) || is_number_part(text[end]))) {
        ++end;
    }
    if (begin == end) {
        return false;
    }
    const std::size_t next = skip_blanks(end);
    const bool is_last = next == text.size() || text[next] == '\n';
    return is_digit(text[begin]) ? is_last || !is_letter(text[next])
                                 : !is_last && std::string_view(")};:*/^+<>=&|").find(text[next]) !=
                                                   std::string_view::npos;
}

void report_quotient(ParseSession& session) {
    if (session.wants(DiagnosticCode::SyntaxError)) {
        Diagnostic& diagnostic =
            session.report(DiagnosticCode::SyntaxError, "there is no operator `//`");
        diagnostic.help.push_back(help_for(*find_synonym(SynonymKind::Operator, "//"), "//"));
        diagnostic.help.emplace_back("a comment inside a statement is `/* ... */`");
    }
}

void report_comment_in_statement(ParseSession& session) {
    if (lacks_only_semicolon(session) || !session.wants(DiagnosticCode::SyntaxError)) {
        return;
    }
    const ScanState& scan = session.scan;
    const std::string_view text = session.scanned.text;
    const SourceSpan slashes = session.match();
    Diagnostic& diagnostic =
        session.report(DiagnosticCode::SyntaxError, slashes,
                       "a comment with `//` is allowed only between statements");
    const std::size_t end = line_end(text, scan.begin);
    const std::string_view comment = text.substr(scan.begin, end - scan.begin);
    if (comment.find("*/") != std::string_view::npos) {
        diagnostic.help.emplace_back("write `/* ... */` here, or put the comment after the `;`");
        return;
    }
    diagnostic.fixes.push_back(
        {"write `/* ... */`",
         {{slashes, "/*"}, {session.scanned.after(static_cast<std::uint32_t>(end)), " */"}},
         comment.find(';') == std::string_view::npos}); // a `;` may end the statement
}

} // namespace lsys::lsys_grammar
