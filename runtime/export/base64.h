// SPDX-License-Identifier: MIT
// Bytes as Base64 (RFC 4648), with padding.
#pragma once

#include <string>
#include <string_view>

namespace lsys {

[[nodiscard]] std::string base64(std::string_view bytes);

} // namespace lsys
