// SPDX-License-Identifier: MIT
#include "grammar/base/synonyms.h"

#include <algorithm>
#include <cctype>
#include <iterator>

namespace lsys {

namespace {

constexpr Synonym kSynonyms[] = {
#define LSYS_SYNONYM(kind, word, source, spelling, advice)                                         \
    {SynonymKind::kind, word, source, spelling, advice},
#include "grammar/base/synonyms.def"
#undef LSYS_SYNONYM
};

bool is_same_word(std::string_view a, std::string_view b) {
    if (a.size() == 1) {
        return a == b;
    }
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
        return std::tolower(static_cast<unsigned char>(x)) ==
               std::tolower(static_cast<unsigned char>(y));
    });
}

/// The function that a spelling calls: `mod` for `mod(a, b)`; empty if the spelling calls no
/// function.
std::string_view called_function(std::string_view spelling) {
    const std::size_t open = std::min(spelling.find('('), spelling.size());
    const std::string_view name = spelling.substr(0, open);
    const bool is_name =
        open != spelling.size() && std::all_of(name.begin(), name.end(), [](char c) {
            return std::isalnum(static_cast<unsigned char>(c)) != 0;
        });
    return is_name ? name : std::string_view{};
}

} // namespace

const Synonym* find_synonym(SynonymKind kind, std::string_view word, const FunctionTest& exists) {
    const auto* const found =
        std::find_if(std::begin(kSynonyms), std::end(kSynonyms), [&](const Synonym& row) {
            const std::string_view name = row.word.substr(0, row.word.find('('));
            if (row.kind != kind || !is_same_word(name, word)) {
                return false;
            }
            const std::string_view function = called_function(row.spelling);
            return function.empty() || exists(function);
        });
    return found == std::end(kSynonyms) ? nullptr : found;
}

const Synonym* find_synonym(SynonymKind kind, std::string_view word) {
    return find_synonym(kind, word, [](std::string_view) { return true; });
}

std::string help_for(const Synonym& synonym, std::string_view word) {
    std::string text;
    if (synonym.spelling.empty()) {
        return std::string(synonym.advice);
    }
    text += '`';
    text += word;
    text += '`';
    if (!synonym.source.empty()) {
        text += " of ";
        text += synonym.source;
    }
    text += " is `";
    text += synonym.spelling;
    text += "` here";
    if (!synonym.advice.empty()) {
        text += ": ";
        text += synonym.advice;
    }
    return text;
}

} // namespace lsys
