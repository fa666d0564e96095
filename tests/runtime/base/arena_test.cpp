// SPDX-License-Identifier: MIT
#include "runtime/base/arena.h"

#include <catch2/catch.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

using lsys::Arena;

TEST_CASE("reserved memory can be written, with small and with huge pages") {
    Arena arena;
    CHECK(arena.max_reserved() == 0);
    for (const std::size_t count : {std::size_t{10}, std::size_t{1} << 20}) {
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
