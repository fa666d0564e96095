// SPDX-License-Identifier: MIT
#include "grammar/lsys/impl/statement_facts.h"

#include "grammar/base/characters.h"
#include "grammar/base/local_values.h"
#include "grammar/lsys/impl/lookahead.h"

#include <algorithm>

namespace lsys::lsys_grammar {

namespace {

/// The text after the `;` at `at`, up to the next `;` or statement.
std::string_view text_after_semicolon(std::string_view text, std::size_t at) {
    const std::size_t begin = at + 1;
    constexpr std::size_t kMaxLength = 4096;
    const std::string_view rest = text.substr(begin, kMaxLength);
    return rest.substr(0, rest.find_first_of(";#"));
}

} // namespace

std::uint32_t colons_of_statement(ParseSession& session) {
    ScanState& scan = session.scan;
    if (!scan.colons) {
        scan.colons = count_colons(session.scanned.text, scan.statement_begin);
    }
    return *scan.colons;
}

bool is_mistyped_colon(std::string_view text, std::size_t at, std::ptrdiff_t missing) {
    const std::string_view rest = text_after_semicolon(text, at);
    const std::size_t first = rest.find_first_not_of(kWhitespace);
    const bool is_ended = at + 1 + rest.size() < text.size() && text[at + 1 + rest.size()] == ';';
    return is_ended && first != std::string_view::npos && rest.substr(first, 2) != "//" &&
           rest.substr(first, 2) != "/*" && std::count(rest.begin(), rest.end(), ':') == missing;
}

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

} // namespace lsys::lsys_grammar
