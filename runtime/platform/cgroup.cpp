// SPDX-License-Identifier: MIT
#include "runtime/platform/cgroup.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>
#include <string_view>

namespace lsys::platform {

namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kNoLimit = std::numeric_limits<std::uint64_t>::max();

/// The number in a file; kNoLimit if the file is missing or contains "max".
std::uint64_t limit_in(const fs::path& path) {
    std::ifstream file(path);
    std::uint64_t bytes = kNoLimit;
    return file >> bytes ? bytes : kNoLimit;
}

/// The min limit of a cgroup and its parents. `base`: the folder of the topmost group that the
/// process can see. In a cgroup namespace the folder of `group` may be missing; then only the limit
/// of `base` counts.
std::uint64_t min_limit(const fs::path& base, std::string_view group, const char* file) {
    fs::path folder = base;
    std::uint64_t min_bytes = limit_in(folder / file);
    for (const fs::path& part : fs::path(group).relative_path()) {
        folder /= part;
        min_bytes = std::min(min_bytes, limit_in(folder / file));
    }
    return min_bytes;
}

/// Whether a list like `cpu,memory` contains `memory`.
bool names_memory(std::string_view controllers) {
    while (!controllers.empty()) {
        const std::string_view name = controllers.substr(0, controllers.find(','));
        if (name == "memory") {
            return true;
        }
        controllers.remove_prefix(std::min(controllers.size(), name.size() + 1));
    }
    return false;
}

} // namespace

std::uint64_t cgroup_memory(const fs::path& root) {
    const fs::path groups = root / "sys/fs/cgroup";
    std::ifstream own(root / "proc/self/cgroup");
    std::uint64_t min_bytes = kNoLimit;
    for (std::string line; std::getline(own, line);) { // `hierarchy:controllers:group`
        const std::size_t first = line.find(':');
        const std::size_t second = first == std::string::npos ? first : line.find(':', first + 1);
        if (second == std::string::npos) {
            continue;
        }
        const std::string_view controllers =
            std::string_view(line).substr(first + 1, second - first - 1);
        const std::string_view group = std::string_view(line).substr(second + 1);
        if (controllers.empty()) {
            min_bytes = std::min({min_bytes, min_limit(groups, group, "memory.max"),
                                  min_limit(groups / "unified", group, "memory.max")});
        } else if (names_memory(controllers)) {
            min_bytes =
                std::min(min_bytes, min_limit(groups / "memory", group, "memory.limit_in_bytes"));
        }
    }
    return min_bytes;
}

} // namespace lsys::platform
