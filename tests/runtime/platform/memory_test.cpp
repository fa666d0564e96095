// SPDX-License-Identifier: MIT
#include "runtime/platform/memory.h"

#include <catch2/catch.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>

using namespace lsys::platform;

TEST_CASE("reserved memory is aligned, and zero once committed") {
    for (const std::size_t alignment : {kPage, kHugePage}) {
        const std::size_t bytes = 8 * kHugePage;
        std::byte* const memory = reserve_memory(bytes, alignment);
        REQUIRE(memory != nullptr);
        CHECK(reinterpret_cast<std::uintptr_t>(memory) % alignment == 0);
        REQUIRE(commit_memory(memory, kHugePage));
        CHECK(memory[0] == std::byte{0});
        CHECK(memory[kHugePage - 1] == std::byte{0});
        memory[kHugePage - 1] = std::byte{7};
        // Commits a part of this memory again, and the memory after it.
        REQUIRE(commit_memory(memory + kPage, bytes - kPage));
        CHECK(memory[kHugePage - 1] == std::byte{7});
        CHECK(memory[bytes - 1] == std::byte{0});
        memory[bytes - 1] = std::byte{1};
        release_memory(memory, bytes);
    }
}

TEST_CASE("memory that no machine has is refused") {
    const std::size_t most = std::numeric_limits<std::size_t>::max();
    CHECK(reserve_memory(most / 4 / kHugePage * kHugePage, kHugePage) == nullptr);
}

TEST_CASE("the machine and the process have memory") {
    CHECK(physical_memory() > std::uint64_t{64} << 20);
    const std::uint64_t before = peak_memory();
    CHECK(before > 0);
    constexpr std::size_t kBytes = std::size_t{64} << 20;
    std::byte* const memory = reserve_memory(kBytes, kHugePage);
    REQUIRE(memory != nullptr);
    REQUIRE(commit_memory(memory, kBytes));
    for (std::size_t at = 0; at < kBytes; at += kPage) {
        memory[at] = std::byte{1};
    }
    CHECK(peak_memory() >= kBytes);
    CHECK(peak_memory() >= before);
    release_memory(memory, kBytes);
}
