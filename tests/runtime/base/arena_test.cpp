#include "runtime/base/arena.h"

#include <catch2/catch.hpp>

#include <cstdint>
#include <limits>
#include <utility>

using lsys::Arena;

TEST_CASE("an arena holds what it reserved, small and with huge pages") {
    Arena arena;
    CHECK(arena.used() == 0);
    for (const std::size_t count : {std::size_t{10}, std::size_t{1} << 20}) {
        REQUIRE(arena.reserve(count * sizeof(std::uint64_t)));
        CHECK(arena.used() == count * sizeof(std::uint64_t));
        CHECK(arena.capacity() >= arena.used());
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
    CHECK(arena.used() == std::size_t{3} << 20);
    arena.release();
    CHECK(arena.used() == 0);
    CHECK(arena.capacity() == 0);
}

TEST_CASE("an arena moves with its memory") {
    Arena first;
    REQUIRE(first.reserve(64));
    first.as<char>()[0] = 'F';
    Arena second(std::move(first));
    CHECK(second.as<char>()[0] == 'F');
    Arena third;
    REQUIRE(third.reserve(8));
    third = std::move(second);
    CHECK(third.as<char>()[0] == 'F');
    CHECK(third.used() == 64);
}

TEST_CASE("an arena refuses sizes beyond the address space") {
    Arena arena;
    CHECK_FALSE(arena.reserve(std::numeric_limits<std::size_t>::max()));
    CHECK(arena.capacity() == 0);
}
