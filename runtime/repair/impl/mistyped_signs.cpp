// SPDX-License-Identifier: MIT
#include "runtime/repair/impl/mistyped_signs.h"

#include "grammar/base/characters.h"

#include <cstddef>
#include <utility>

namespace lsys::repair {

namespace {

bool is_blank_at(std::string_view text, std::size_t at) {
    return at >= text.size() || kWhitespace.find(text[at]) != std::string_view::npos;
}

/// Whether a blank or an end of the text stands before and after the character at `at`.
std::pair<bool, bool> sides_of(std::string_view text, std::size_t at) {
    return {at == 0 || is_blank_at(text, at - 1), is_blank_at(text, at + 1)};
}

/// Whether the sign at `at` is the only one of its kind in the text, another one has blanks on the
/// same sides, or it follows a `:`, as the `;` after an empty successor.
bool is_laid_out_as_others(std::string_view text, std::size_t at) {
    const std::size_t before =
        at == 0 ? std::string_view::npos : text.find_last_not_of(kWhitespace, at - 1);
    if (before != std::string_view::npos && text[before] == ':') {
        return true;
    }
    const std::pair<bool, bool> sides = sides_of(text, at);
    bool has_others = false;
    for (std::size_t other = text.find(text[at]); other != std::string_view::npos;
         other = text.find(text[at], other + 1)) {
        if (other != at && sides_of(text, other) == sides) {
            return true;
        }
        has_others = has_others || other != at;
    }
    return !has_others;
}

} // namespace

char added_sign(std::string_view added) {
    const std::size_t first = added.find_first_not_of(kWhitespace);
    return first != std::string_view::npos && added.find_last_not_of(kWhitespace) == first
               ? added[first]
               : '\0';
}

std::vector<std::string> mistyped_texts(std::string_view text, AddedText added) {
    const char sign = added_sign(text.substr(added.begin, added.end - added.begin));
    std::string without_addition(text.substr(0, added.begin));
    without_addition += text.substr(added.end);
    std::vector<std::string> texts;
    const auto add = [&](std::size_t at) {
        std::string other = without_addition;
        other[at] = sign;
        if (without_addition[at] != sign && is_laid_out_as_others(other, at)) {
            texts.push_back(std::move(other));
        }
    };
    if (sign == '\0') {
        return texts;
    }
    const std::size_t before =
        added.begin == 0 ? std::string::npos
                         : without_addition.find_last_not_of(kWhitespace, added.begin - 1);
    if (before != std::string::npos) {
        add(before);
        // The same sign before this character may have been exchanged with it.
        if (before > 0 && without_addition[before - 1] == sign) {
            std::string exchanged = without_addition;
            std::swap(exchanged[before - 1], exchanged[before]);
            texts.push_back(std::move(exchanged));
        }
    }
    const std::size_t after = without_addition.find_first_not_of(kWhitespace, added.begin);
    if (after != std::string::npos) {
        add(after);
    }
    return texts;
}

} // namespace lsys::repair
