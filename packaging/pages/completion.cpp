// SPDX-License-Identifier: MIT
#include "packaging/pages/completion.h"

namespace lsys::pages {

std::string short_text(const std::string& description) {
    std::string text;
    bool in_code = false;
    for (const char c : description) {
        if (c == '`') {
            in_code = !in_code;
            continue;
        }
        if (!in_code && (c == ';' || c == ':')) {
            break;
        }
        text += c;
    }
    return text;
}

std::string name_pattern(const std::vector<std::string>& extensions) {
    std::string pattern;
    for (const std::string& extension : extensions) {
        pattern += pattern.empty() ? "" : "|";
        for (const char c : extension) {
            pattern += c == '+' ? "[+]" : std::string(1, c);
        }
    }
    return pattern.empty() ? pattern : "[.](" + pattern + ")$";
}

} // namespace lsys::pages
