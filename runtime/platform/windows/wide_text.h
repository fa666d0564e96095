// SPDX-License-Identifier: MIT
// Text of the Win32 functions (UTF-16) from and to UTF-8.
#pragma once

#include <string>
#include <string_view>

namespace lsys::platform {

/// Bytes that are not UTF-8 become replacement characters, which no file has in its name.
[[nodiscard]] std::wstring wide_text(std::string_view text);
[[nodiscard]] std::string utf8_text(std::wstring_view text);

} // namespace lsys::platform
