// SPDX-License-Identifier: MIT
#include "compiler/program/module_text.h"

#include <cstdint>

namespace lsys {

std::size_t skip_blanks(std::string_view text, std::size_t at) {
    while (at < text.size()) {
        const char c = text[at];
        if (c == ' ' || c == '\t' || c == '\n' || c == '\r') {
            ++at;
        } else if (c == '/' && text.substr(at, 2) == "/*") {
            const std::size_t end = text.find("*/", at + 2);
            at = end == std::string_view::npos ? text.size() : end + 2;
        } else {
            break;
        }
    }
    return at;
}

std::size_t end_of_arguments(std::string_view text, std::size_t name_end) {
    std::uint64_t depth = 0;
    for (std::size_t at = skip_blanks(text, name_end); at < text.size();
         at = skip_blanks(text, at + 1)) {
        const char c = text[at];
        if (c == '(' || c == '{') {
            ++depth;
        } else if (depth == 0 || c == ';') {
            break;
        } else if (c == ')' || c == '}') {
            if (--depth == 0) {
                return at + 1;
            }
        }
    }
    return name_end;
}

} // namespace lsys
