// SPDX-License-Identifier: MIT
// The path with which a FileLoader (parse_context.h) lists the files of a folder.
#pragma once

#include <string>
#include <string_view>

namespace lsys {

/// Ends such a path. No name in a grammar contains a line end, so a grammar includes no list in
/// place of a file.
inline constexpr char kListEnd = '\n';

/// The path that lists a folder: empty, or `FOLDER/`.
[[nodiscard]] inline std::string list_of(std::string_view folder) {
    return std::string(folder.empty() ? "./" : folder) + kListEnd;
}

} // namespace lsys
