// SPDX-License-Identifier: MIT
// Paths of files as text: UTF-8 with `/` between the names. On Windows a path that a user gives may
// also have backslashes and the letter of a drive.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace lsys {

/// The path that a UTF-8 text names. On Windows, std::filesystem::path(text) would read the bytes
/// in the code page of the system.
[[nodiscard]] std::filesystem::path path_of(std::string_view text);
/// The text of a path, with `/` between the names on every system.
[[nodiscard]] std::string path_text(const std::filesystem::path& path);

/// Whether a path is absolute: it does not depend on the current folder.
[[nodiscard]] bool is_absolute_path(std::string_view path);
/// Whether a path ends in a separator.
[[nodiscard]] bool names_folder(std::string_view path);
/// The folder of a path, with the separator at its end; empty if the path has no separator.
[[nodiscard]] std::string_view folder_of_path(std::string_view path);
/// The last name of a path.
[[nodiscard]] std::string_view name_of_path(std::string_view path);

} // namespace lsys
