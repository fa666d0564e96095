// SPDX-License-Identifier: MIT
#include "runtime/base/out_of_memory.h"

#include <catch2/catch.hpp>

#include <new>
#include <stdexcept>

using lsys::catch_out_of_memory;

TEST_CASE("if work runs out of memory, the given value is returned") {
    const auto out_of_memory = [] { return -1; };
    CHECK(catch_out_of_memory([] { return 7; }, out_of_memory) == 7);
    CHECK(catch_out_of_memory([]() -> int { throw std::bad_alloc(); }, out_of_memory) == -1);
    CHECK(catch_out_of_memory([]() -> int { throw std::length_error("long"); }, out_of_memory) ==
          -1);
    CHECK_THROWS_AS(
        catch_out_of_memory([]() -> int { throw std::domain_error("other"); }, out_of_memory),
        std::domain_error);
}
