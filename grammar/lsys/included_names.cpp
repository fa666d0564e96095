// SPDX-License-Identifier: MIT
#include "grammar/lsys/included_names.h"

#include "grammar/base/characters.h"

namespace lsys {

std::vector<std::string_view> included_names(std::string_view text) {
    constexpr std::string_view kInclude = "#include";
    std::vector<std::string_view> names;
    for (std::size_t at = text.find(kInclude); at != std::string_view::npos;
         at = text.find(kInclude, at)) {
        at += kInclude.size();
        const std::size_t quote = text.find_first_not_of(kWhitespace, at);
        if (quote == std::string_view::npos || text[quote] != '"') {
            continue;
        }
        const std::size_t end = text.find_first_of("\"\n", quote + 1);
        if (end != std::string_view::npos && text[end] == '"') {
            names.push_back(text.substr(quote + 1, end - quote - 1));
        }
    }
    return names;
}

} // namespace lsys
