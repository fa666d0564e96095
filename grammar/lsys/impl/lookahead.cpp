// SPDX-License-Identifier: MIT
#include "grammar/lsys/impl/lookahead.h"

#include "grammar/base/characters.h"
#include "grammar/base/diagnostic.h"
#include "grammar/base/find_any.h"
#include "grammar/base/synonyms.h"
#include "grammar/lsys/statement_names.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace lsys {

namespace {

constexpr std::array<std::string_view, 20> kSpellings{
    "",         "n",         "define",    "param",  "function", "curve", "contour",
    "material", "sense",     "module",    "object", "include",  "set",   "ignore",
    "consider", "decompose", "interpret", "down",   "up",       "w"};

/// The keys of `#set`, which compiler/bytecode/settings.def defines.
constexpr std::array<std::string_view, 35> kSettings{"turtle",
                                                     "names",
                                                     "rewriting",
                                                     "choice",
                                                     "weights",
                                                     "random",
                                                     "angle",
                                                     "step",
                                                     "width",
                                                     "sides",
                                                     "tropism",
                                                     "seed",
                                                     "spring",
                                                     "density",
                                                     "angle_scale",
                                                     "step_scale",
                                                     "width_scale",
                                                     "damping",
                                                     "at_depth",
                                                     "decompose_depth",
                                                     "interpret_depth",
                                                     "elasticity",
                                                     "load",
                                                     "height",
                                                     "pipe",
                                                     "flare",
                                                     "collar",
                                                     "tips",
                                                     "tropisms",
                                                     "width_unit",
                                                     "colour",
                                                     "width_increment",
                                                     "colour_increment",
                                                     "word_shape",
                                                     "scale"};

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

} // namespace

std::size_t comment_end(std::string_view text, std::size_t at) {
    const std::size_t close = text.find("*/", at + 2);
    return close == std::string_view::npos ? text.size() : close + 2;
}

std::size_t skip_gaps(std::string_view text, std::size_t at) {
    while (at < text.size()) {
        if (is_blank(text[at])) {
            ++at;
        } else if (text[at] == '/' && text.substr(at, 2) == "/*") {
            at = comment_end(text, at);
        } else {
            break;
        }
    }
    return std::min(at, text.size());
}

std::size_t skip_gaps_between_statements(std::string_view text, std::size_t at) {
    while (true) {
        at = skip_gaps(text, at);
        if (text.substr(at, 2) != "//") {
            return at;
        }
        at = std::min(text.find('\n', at), text.size());
    }
}

std::string_view leading_word(std::string_view text) {
    std::size_t end = 0;
    if (!text.empty() && is_letter(text[0])) {
        while (end < text.size() && is_word_character(text[end])) {
            ++end;
        }
    }
    return text.substr(0, end);
}

char next_character(std::string_view text, std::uint32_t at) {
    const std::size_t next = skip_gaps(text, at);
    return next < text.size() ? text[next] : '\0';
}

bool is_first_on_line(std::string_view text, std::uint32_t at) {
    while (at > 0 && (text[at - 1] == ' ' || text[at - 1] == '\t' || text[at - 1] == '\r')) {
        --at;
    }
    return at == 0 || text[at - 1] == '\n';
}

bool begins_statement(std::string_view text, std::uint32_t at) {
    const std::string_view word = leading_word(text.substr(at + 1));
    if (word.empty()) {
        return false;
    }
    return find_keyword(word) != Keyword::Label || is_first_on_line(text, at) ||
           next_character(text, at + 1 + static_cast<std::uint32_t>(word.size())) == ':';
}

namespace {

std::uint32_t
count_colons_up_to(std::string_view text, std::uint32_t begin, std::uint32_t max_count) {
    std::uint32_t colons = 0;
    std::size_t at = begin;
    while (colons < max_count) {
        at = find_any<';', ':', '`', '/', '#'>(text, at);
        if (at == text.size() || text[at] == ';') {
            break;
        }
        if (text[at] == '`') {
            const std::size_t close = text.find_first_of("`\n", at + 1);
            at = close == std::string_view::npos ? text.size() : close + 1;
            continue;
        }
        if (text.substr(at, 2) == "/*") {
            at = comment_end(text, at);
            continue;
        }
        if (text[at] == '#' && at != begin &&
            is_first_on_line(text, static_cast<std::uint32_t>(at))) {
            break;
        }
        colons += text[at] == ':' ? 1u : 0u;
        ++at;
    }
    return colons;
}

} // namespace

std::uint32_t count_colons(std::string_view text, std::uint32_t begin) {
    return count_colons_up_to(text, begin, std::numeric_limits<std::uint32_t>::max());
}

bool has_more_colons(std::string_view text, std::uint32_t begin, std::uint32_t count) {
    return count_colons_up_to(text, begin, count + 1) > count;
}

std::vector<std::string_view> statement_names() {
    return {kSpellings.begin() + 1, kSpellings.end()};
}

std::string_view spelling(Keyword keyword) {
    return kSpellings[static_cast<std::size_t>(keyword)];
}

Keyword find_keyword(std::string_view word) {
    const auto found = std::find(kSpellings.begin(), kSpellings.end(), word);
    return found == kSpellings.end() ? Keyword::Label
                                     : static_cast<Keyword>(found - kSpellings.begin());
}

bool is_setting(std::string_view word) {
    return std::find(kSettings.begin(), kSettings.end(), word) != kSettings.end();
}

std::optional<std::string_view> nearest_setting(std::string_view word) {
    return nearest_name(word, {kSettings.begin(), kSettings.end()});
}

bool is_synonym(std::string_view word, Keyword keyword) {
    const Synonym* const synonym = find_synonym(SynonymKind::Statement, word);
    return synonym != nullptr && keyword_of(*synonym) == keyword;
}

std::optional<Keyword> keyword_of(const Synonym& synonym) {
    if (!synonym.spelling.starts_with('#')) {
        return std::nullopt;
    }
    const Keyword keyword = find_keyword(synonym.spelling.substr(1));
    return keyword == Keyword::Label ? std::nullopt : std::optional(keyword);
}

std::optional<Keyword> nearest_keyword(std::string_view word) {
    if (word.size() < 2) {
        return std::nullopt;
    }
    // Leave out keywords of one letter, which are similar to every short word.
    std::vector<std::string_view> candidates;
    for (const std::string_view candidate : kSpellings) {
        if (candidate.size() > 1) {
            candidates.push_back(candidate);
        }
    }
    const std::optional<std::string_view> nearest = nearest_name(word, candidates);
    return nearest ? std::optional(find_keyword(*nearest)) : std::nullopt;
}

} // namespace lsys
