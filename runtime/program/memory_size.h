// SPDX-License-Identifier: MIT
// The memory of the machine or container, for the default of --max-memory.
#pragma once

#include <cstdint>

namespace lsys {

/// Half of the physical memory or of the memory limit of the container, whichever is less, in
/// bytes.
[[nodiscard]] std::uint64_t half_of_memory();

} // namespace lsys
