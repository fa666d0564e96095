// SPDX-License-Identifier: MIT
// SHA-256 (FIPS 180-4), for comparing long words with published digests.
#pragma once

#include <string>
#include <string_view>

namespace lsys::tests {

/// The digest of a text as 64 hexadecimal digits.
[[nodiscard]] std::string sha256(std::string_view bytes);

} // namespace lsys::tests
