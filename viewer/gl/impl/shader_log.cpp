// SPDX-License-Identifier: MIT
#include "viewer/gl/impl/shader_log.h"

#include <fmt/format.h>

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
        const auto number = [](std::string_view text, std::size_t& value) {
            const auto [stop, problem] =
                std::from_chars(text.data(), text.data() + text.size(), value);
            return problem == std::errc() ? static_cast<std::size_t>(stop - text.data()) : 0;
        };
        std::size_t file = 0;
        const std::size_t digits = number(row, file);
        if (digits != 0 && digits < row.size() && file < files.size()) {
            std::size_t line = 0;
            const std::string_view rest = row.substr(digits + 1);
            const std::size_t line_digits = number(rest, line);
            if (row[digits] == ':') {
                result += files[file];
                row.remove_prefix(digits);
            } else if (row[digits] == '(' && line_digits != 0 &&
                       rest.substr(line_digits).starts_with(") :")) {
                result += fmt::format("{}:{}", files[file], line);
                row.remove_prefix(digits + line_digits + 3);
            }
        }
        result += row;
    }
    return result;
}

} // namespace lsys::view
