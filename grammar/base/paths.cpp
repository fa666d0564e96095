// SPDX-License-Identifier: MIT
#include "grammar/base/paths.h"

#include <algorithm>

namespace lsys {

namespace {

constexpr bool kHasDrives = std::filesystem::path::preferred_separator == '\\';

bool is_separator(char c) {
    return c == '/' || (kHasDrives && c == '\\');
}

} // namespace

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
