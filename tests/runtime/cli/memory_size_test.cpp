// SPDX-License-Identifier: MIT
#include "runtime/platform/cgroup.h"
#include "runtime/program/memory_size.h"
#include "tests/support/lsc_run.h"

#include <catch2/catch.hpp>

#include <cstdint>
#include <filesystem>
#include <string>

using namespace lsys;
using lsys::platform::cgroup_memory;
using lsys::tests::ScratchFolder;
using lsys::tests::write_text;

namespace {

constexpr std::uint64_t kNoLimit = ~std::uint64_t{0};

struct Root : ScratchFolder {
    void put(const std::string& path, const std::string& text) const {
        const std::filesystem::path file = this->path() / path;
        std::filesystem::create_directories(file.parent_path());
        write_text(file, text);
    }
};

} // namespace

TEST_CASE("without limits of cgroups, the size is that of physical memory") {
    const Root root;
    CHECK(cgroup_memory(root.path()) == kNoLimit);
    root.put("proc/self/cgroup", "0::/user.slice\n");
    CHECK(cgroup_memory(root.path()) == kNoLimit);
    root.put("sys/fs/cgroup/user.slice/memory.max", "max\n");
    CHECK(cgroup_memory(root.path()) == kNoLimit);
    CHECK(half_of_memory() > (std::uint64_t{1} << 26));
}

TEST_CASE("the smallest of the limits of cgroup v2 counts") {
    const Root root;
    root.put("proc/self/cgroup", "0::/a/b\n");
    root.put("sys/fs/cgroup/a/b/memory.max", "3000000000\n");
    CHECK(cgroup_memory(root.path()) == 3'000'000'000);
    root.put("sys/fs/cgroup/a/memory.max", "536870912\n"); // limit of the parent group
    CHECK(cgroup_memory(root.path()) == 536'870'912);
    root.put("sys/fs/cgroup/memory.max", "max\n");
    CHECK(cgroup_memory(root.path()) == 536'870'912);
}

TEST_CASE("a container has its own group as the topmost one") {
    const Root root;
    root.put("proc/self/cgroup", "0::/\n");
    root.put("sys/fs/cgroup/memory.max", "268435456\n");
    CHECK(cgroup_memory(root.path()) == 268'435'456);
    root.put("proc/self/cgroup", "0::/../outside\n");
    CHECK(cgroup_memory(root.path()) == 268'435'456);
}

TEST_CASE("limits of cgroup v1 count, also those of the whole container") {
    const Root root;
    root.put("proc/self/cgroup", "12:pids:/x\n11:cpuset,memory:/docker/1f\n1:name=systemd:/x\n");
    // Inside a container, its own group is mounted as the root.
    root.put("sys/fs/cgroup/memory/memory.limit_in_bytes", "134217728\n");
    CHECK(cgroup_memory(root.path()) == 134'217'728);
    root.put("sys/fs/cgroup/memory/docker/1f/memory.limit_in_bytes", "67108864\n");
    CHECK(cgroup_memory(root.path()) == 67'108'864);
    // The value that means no limit.
    root.put("sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n");
    CHECK(cgroup_memory(root.path()) == 67'108'864);
}
