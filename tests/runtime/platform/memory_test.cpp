// SPDX-License-Identifier: MIT
#include "runtime/platform/memory.h"

#include <catch2/catch.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define LSYS_HAS_MALLOPT
#include <sys/resource.h>
#endif

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

#ifdef LSYS_HAS_MALLOPT
TEST_CASE("freed memory is allocated again without faults of its pages") {
    keep_freed_memory();
    constexpr std::size_t kBytes = std::size_t{24} << 20;
    const auto faults_of_a_block = [] {
        const auto faults = [] {
            rusage usage{};
            ::getrusage(RUSAGE_SELF, &usage);
            return usage.ru_minflt;
        };
        const long before = faults();
        const std::vector<unsigned char> block(kBytes, static_cast<unsigned char>(before));
        CHECK(block[kBytes / 2] == static_cast<unsigned char>(before));
        return faults() - before;
    };
    faults_of_a_block();
    CHECK(faults_of_a_block() < static_cast<long>(kBytes / kPage / 10));
}
#endif
