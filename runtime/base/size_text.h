// SPDX-License-Identifier: MIT
// Numbers and sizes in messages.
#pragma once

#include "grammar/base/result.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace lsys {

/// Decimal digits in groups: 1,234,567.
[[nodiscard]] std::string grouped_digits(std::uint64_t value);
/// A size with a binary unit: 640 B, 1.5 KiB, 3.2 GiB.
[[nodiscard]] std::string byte_size_text(std::uint64_t bytes);
/// The error (ErrorKind::Limit) that `subject`, such as "its mesh", needs more than the `left`
/// bytes that remain of the memory limit.
[[nodiscard]] Error memory_error(std::string_view subject, std::uint64_t left);

} // namespace lsys
