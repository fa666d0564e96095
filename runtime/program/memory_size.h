// The memory of the machine or container, for the default of --max-memory.
#pragma once

#include <cstdint>
#include <filesystem>

namespace lsys {

/// The min memory limit of the cgroups of this process in bytes, 2^64 - 1 without any: memory.max
/// of cgroup v2 and memory.limit_in_bytes of v1, of its group and all parents. `root`: the folder
/// with proc/ and sys/.
[[nodiscard]] std::uint64_t cgroup_memory(const std::filesystem::path& root);

/// Half of the physical memory or of cgroup_memory(), whichever is less, in bytes.
[[nodiscard]] std::uint64_t half_of_memory();

} // namespace lsys
