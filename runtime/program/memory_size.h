// The memory of the machine or container, for the default of --max-memory.
#pragma once

#include <cstdint>
#include <filesystem>

namespace lsys {

/// The min memory limit, in bytes, of the cgroup of this process and all its parents: memory.max of
/// cgroup v2 and memory.limit_in_bytes of v1. 2^64 - 1 without a limit. `root`: the folder with
/// proc/ and sys/.
[[nodiscard]] std::uint64_t cgroup_memory(const std::filesystem::path& root);

/// Half of the physical memory or of cgroup_memory(), whichever is less, in bytes.
[[nodiscard]] std::uint64_t half_of_memory();

} // namespace lsys
