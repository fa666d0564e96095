// SPDX-License-Identifier: MIT
#include "runtime/platform/cgroup.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <limits>
#include <string>
#include <string_view>

namespace lsys::platform {

namespace {

constexpr std::uint64_t kNoLimit = std::numeric_limits<std::uint64_t>::max();

/// The contents of a file of the kernel, empty if it is missing. At every start of the program some
/// are read: std::ifstream takes three times as long.
std::string read_kernel_file(const std::string& path) {
    std::string text;
    if (std::FILE* const file = std::fopen(path.c_str(), "r")) {
        char part[4096];
        for (std::size_t size = 0; (size = std::fread(part, 1, sizeof part, file)) > 0;) {
            text.append(part, size);
        }
        std::fclose(file);
    }
    return text;
}

/// The number in a file; kNoLimit if the file is missing or contains "max".
std::uint64_t limit_in(const std::string& path) {
    const std::string text = read_kernel_file(path);
    std::uint64_t bytes = kNoLimit;
    std::from_chars(text.data(), text.data() + text.size(), bytes);
    return bytes;
}

/// The min limit of a cgroup and its parents. `base`: the folder of the topmost group that the
/// process can see. In a cgroup namespace the folder of `group` may be missing; then only the limit
/// of `base` counts.
std::uint64_t min_limit(const std::string& base, std::string_view group, std::string_view file) {
    std::uint64_t min_bytes = limit_in(fmt::format("{}/{}", base, file));
    for (std::size_t end = 0; end + 1 < group.size();) {
        end = std::min(group.find('/', end + 1), group.size());
        min_bytes =
            std::min(min_bytes, limit_in(fmt::format("{}{}/{}", base, group.substr(0, end), file)));
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

std::uint64_t cgroup_memory(const std::filesystem::path& root) {
    const std::string groups = (root / "sys/fs/cgroup").string();
    const std::string own = read_kernel_file((root / "proc/self/cgroup").string());
    std::uint64_t min_bytes = kNoLimit;
    for (std::string_view rest = own; !rest.empty();) { // lines `hierarchy:controllers:group`
        const std::string_view line = rest.substr(0, rest.find('\n'));
        rest.remove_prefix(std::min(rest.size(), line.size() + 1));
        const std::size_t first = line.find(':');
        const std::size_t second = first == std::string::npos ? first : line.find(':', first + 1);
        if (second == std::string::npos) {
            continue;
        }
        const std::string_view controllers = line.substr(first + 1, second - first - 1);
        const std::string_view group = line.substr(second + 1);
        if (controllers.empty()) {
            min_bytes = std::min({min_bytes, min_limit(groups, group, "memory.max"),
                                  min_limit(groups + "/unified", group, "memory.max")});
        } else if (names_memory(controllers)) {
            min_bytes =
                std::min(min_bytes, min_limit(groups + "/memory", group, "memory.limit_in_bytes"));
        }
    }
    return min_bytes;
}

} // namespace lsys::platform
