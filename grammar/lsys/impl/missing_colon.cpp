// SPDX-License-Identifier: MIT
#include "grammar/lsys/impl/missing_colon.h"

#include "grammar/base/characters.h"
#include "grammar/lsys/impl/lookahead.h"
#include "grammar/lsys/impl/statement_facts.h"

#include <algorithm>
#include <string>

namespace lsys::lsys_grammar {

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
            // The head may end with a condition, `A x > 1 ~ 0.5`: then the `:` belongs before it.
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
