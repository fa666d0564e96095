// SPDX-License-Identifier: MIT
// Memory limits of containers: the control groups (cgroups) of Linux, as files of proc/ and sys/.
#pragma once

#include <cstdint>
#include <filesystem>

namespace lsys::platform {

/// The min memory limit, in bytes, of the cgroup of this process and all its parents: memory.max of
/// cgroup v2 and memory.limit_in_bytes of v1. 2^64 - 1 without a limit, and on systems without
/// cgroups. `root`: the folder with proc/ and sys/.
[[nodiscard]] std::uint64_t cgroup_memory(const std::filesystem::path& root);

} // namespace lsys::platform
