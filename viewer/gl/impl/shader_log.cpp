// SPDX-License-Identifier: MIT
#include "viewer/gl/impl/shader_log.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <system_error>

namespace lsys::view {

std::string name_files(std::string_view log, std::span<const std::string> files) {
    std::string result;
    for (std::size_t at = 0; at < log.size();) {
        const std::size_t end = std::min(log.find('\n', at), log.size());
        std::string_view row = log.substr(at, end - at);
        at = end + 1;
        if (!result.empty()) {
            result += '\n';
        }
        std::size_t file = 0;
        const auto [stop, problem] = std::from_chars(row.data(), row.data() + row.size(), file);
        const auto digits = static_cast<std::size_t>(stop - row.data());
        if (problem == std::errc() && digits < row.size() &&
            (row[digits] == ':' || row[digits] == '(') && file < files.size()) {
            result += files[file];
            row.remove_prefix(digits);
        }
        result += row;
    }
    return result;
}

} // namespace lsys::view
