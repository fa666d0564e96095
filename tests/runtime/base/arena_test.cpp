// SPDX-License-Identifier: MIT
#include "runtime/base/arena.h"

#include <catch2/catch.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#if defined(__linux__)
#include <sys/mman.h>
#include <vector>
#endif

using lsys::Arena;

TEST_CASE("reserved memory can be written, on the heap, with small and with huge pages") {
    Arena arena;
    CHECK(arena.max_reserved() == 0);
    for (const std::size_t count :
         {std::size_t{10}, std::size_t{2048}, std::size_t{2049}, std::size_t{1} << 20}) {
        REQUIRE(arena.reserve(count * sizeof(std::uint64_t)));
        CHECK(arena.max_reserved() == count * sizeof(std::uint64_t));
        CHECK(arena.capacity() >= arena.max_reserved());
        auto* const values = arena.as<std::uint64_t>();
        values[0] = 1;
        values[count - 1] = 2;
        CHECK(std::as_const(arena).as<std::uint64_t>()[0] == 1);
        CHECK(arena.as<std::uint64_t>()[count - 1] == 2);
    }
}

TEST_CASE("an arena that is large enough keeps its memory") {
    Arena arena;
    REQUIRE(arena.reserve(std::size_t{3} << 20));
    arena.as<std::uint8_t>()[7] = 42;
    REQUIRE(arena.reserve(100));
    CHECK(arena.as<std::uint8_t>()[7] == 42);
    CHECK(arena.max_reserved() == std::size_t{3} << 20);
    arena.release();
    CHECK(arena.max_reserved() == 0);
    CHECK(arena.capacity() == 0);
}

TEST_CASE("moving an arena moves its memory") {
    Arena first;
    REQUIRE(first.reserve(64));
    first.as<char>()[0] = 'F';
    Arena second(std::move(first));
    CHECK(second.as<char>()[0] == 'F');
    Arena third;
    REQUIRE(third.reserve(8));
    third = std::move(second);
    CHECK(third.as<char>()[0] == 'F');
    CHECK(third.max_reserved() == 64);
}

TEST_CASE("an arena grows, keeps its capacity and can be released") {
    Arena arena;
    CHECK(arena.capacity() == 0);
    REQUIRE(arena.reserve(100));
    auto* const small = arena.as<std::byte>();
    small[99] = std::byte{7};
    REQUIRE(arena.reserve(1000));
    CHECK(arena.as<std::byte>() == small);
    CHECK(arena.max_reserved() == 1000);
    REQUIRE(arena.reserve(std::size_t{8} << 20));
    arena.as<std::byte>()[(std::size_t{8} << 20) - 1] = std::byte{1};
    CHECK(reinterpret_cast<std::uintptr_t>(arena.as<std::byte>()) % (std::size_t{2} << 20) == 0);
    Arena other = std::move(arena);
    CHECK(arena.as<std::byte>() == nullptr);
    CHECK(other.max_reserved() == std::size_t{8} << 20);
    other = Arena();
    CHECK(other.capacity() == 0);
    CHECK_FALSE(other.reserve(std::numeric_limits<std::size_t>::max()));
    CHECK(other.as<std::byte>() == nullptr);
}

#if defined(__linux__) && defined(MADV_POPULATE_WRITE)
TEST_CASE("pages of an arena have memory before they are written, except huge pages") {
    constexpr std::size_t kPage = 4096;
    const auto resident = [](std::byte* begin, std::size_t bytes) {
        std::vector<unsigned char> pages((bytes + kPage - 1) / kPage);
        REQUIRE(::mincore(begin, bytes, pages.data()) == 0);
        std::size_t count = 0;
        for (const unsigned char page : pages) {
            count += page & 1U;
        }
        return count;
    };
    void* const probe =
        ::mmap(nullptr, kPage, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    REQUIRE(probe != MAP_FAILED);
    const bool populates = ::madvise(probe, kPage, MADV_POPULATE_WRITE) == 0;
    ::munmap(probe, kPage);
    if (!populates) {
        WARN("this kernel cannot populate pages");
        return;
    }
    Arena arena;
    REQUIRE(arena.reserve(10 * kPage));
    CHECK(resident(arena.as<std::byte>(), 20 * kPage) == 10);
    REQUIRE(arena.reserve(12 * kPage + 1));
    CHECK(resident(arena.as<std::byte>(), 20 * kPage) == 13);
    constexpr std::size_t kHuge = std::size_t{2} << 20;
    REQUIRE(arena.reserve(kHuge + 5 * kPage));
    CHECK(resident(arena.as<std::byte>() + kHuge, 20 * kPage) == 5);
}
#endif
