// SPDX-License-Identifier: MIT
#include "runtime/base/size_text.h"

#include <fmt/format.h>

#include <array>

namespace lsys {

std::string grouped_digits(std::uint64_t value) {
    std::string text = std::to_string(value);
    for (std::size_t at = text.size(); at > 3;) {
        at -= 3;
        text.insert(at, 1, ',');
    }
    return text;
}

std::string byte_size_text(std::uint64_t bytes) {
    constexpr std::array<std::string_view, 7> kUnits{"B", "KiB", "MiB", "GiB", "TiB", "PiB", "EiB"};
    auto size = static_cast<double>(bytes);
    std::size_t unit = 0;
    while (size >= 1024.0 && unit + 1 < kUnits.size()) {
        size /= 1024.0;
        ++unit;
    }
    return unit == 0 ? fmt::format("{} B", bytes) : fmt::format("{:.1f} {}", size, kUnits[unit]);
}

Error memory_error(std::string_view subject, std::uint64_t left) {
    return Error{fmt::format("{} needs more than the {} that remain of the memory limit", subject,
                             byte_size_text(left)),
                 ErrorKind::Limit};
}

} // namespace lsys
