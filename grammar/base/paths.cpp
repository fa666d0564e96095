// SPDX-License-Identifier: MIT
#include "grammar/base/paths.h"

#include "grammar/base/utf8.h"

#include <algorithm>

namespace lsys {

namespace {

constexpr bool kHasDrives = std::filesystem::path::preferred_separator == '\\';

bool is_separator(char c) {
    return c == '/' || (kHasDrives && c == '\\');
}

} // namespace

std::filesystem::path path_of(std::string_view text) {
    if constexpr (!kHasDrives) {
        return text;
    } else {
        std::u32string characters; // a path made of bytes that are not UTF-8 would throw
        while (!text.empty()) {
            const CodePoint next = decode_utf8(text);
            characters += next.value;
            text.remove_prefix(next.length);
        }
        return characters;
    }
}

std::string path_text(const std::filesystem::path& path) {
    std::string text = path.string();
    if (kHasDrives) {
        std::replace(text.begin(), text.end(), '\\', '/');
    }
    return text;
}

bool is_absolute_path(std::string_view path) {
    const bool has_drive = kHasDrives && path.size() > 2 && path[1] == ':' && is_separator(path[2]);
    return has_drive || (!path.empty() && is_separator(path.front()));
}

bool names_folder(std::string_view path) {
    return !path.empty() && is_separator(path.back());
}

std::string_view folder_of_path(std::string_view path) {
    const auto after = std::find_if(path.rbegin(), path.rend(), is_separator).base();
    return path.substr(0, static_cast<std::size_t>(after - path.begin()));
}

std::string_view name_of_path(std::string_view path) {
    return path.substr(folder_of_path(path).size());
}

} // namespace lsys
