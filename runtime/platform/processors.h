// SPDX-License-Identifier: MIT
// The processors of the machine.
#pragma once

#include <cstdint>
#include <vector>

namespace lsys::platform {

/// The processors on which this process may run: bit p % 64 of word p / 64 for processor p. Empty
/// if unknown.
[[nodiscard]] std::vector<std::uint64_t> allowed_processors();

} // namespace lsys::platform
