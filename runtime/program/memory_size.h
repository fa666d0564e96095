// The memory of the machine, or of the container that the process runs in: what the default of
// --max-memory is made from.
#pragma once

#include <cstdint>
#include <filesystem>

namespace lsys {

/// The least limit that cgroups set to the memory of this process, in bytes: memory.max of cgroup
/// v2 and memory.limit_in_bytes of v1, of its own group and of all above. 2^64 - 1: none. `root`:
/// the folder that holds proc/ and sys/.
[[nodiscard]] std::uint64_t cgroup_memory(const std::filesystem::path& root);

/// Half of the physical memory, or of cgroup_memory() where that is less, in bytes.
[[nodiscard]] std::uint64_t half_of_memory();

} // namespace lsys
