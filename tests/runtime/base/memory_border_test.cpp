#include "runtime/base/memory_border.h"

#include <catch2/catch.hpp>

#include <new>
#include <stdexcept>

using lsys::catch_no_memory;

TEST_CASE("work that runs out of memory gives another value") {
    const auto no_memory = [] { return -1; };
    CHECK(catch_no_memory([] { return 7; }, no_memory) == 7);
    CHECK(catch_no_memory([]() -> int { throw std::bad_alloc(); }, no_memory) == -1);
    CHECK(catch_no_memory([]() -> int { throw std::length_error("long"); }, no_memory) == -1);
    CHECK_THROWS_AS(catch_no_memory([]() -> int { throw std::domain_error("other"); }, no_memory),
                    std::domain_error);
}
