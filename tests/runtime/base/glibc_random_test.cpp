// SPDX-License-Identifier: MIT
#include "runtime/base/glibc_random.h"

#include <catch2/catch.hpp>

#include <cstdint>

using lsys::GlibcRandom;

TEST_CASE("the generator gives the numbers of rand()") {
    // The numbers after srand(1) and srand(42).
    GlibcRandom first;
    for (const std::uint32_t expected :
         {1804289383U, 846930886U, 1681692777U, 1714636915U, 1957747793U, 424238335U, 719885386U}) {
        CHECK(first.next() == expected);
    }
    GlibcRandom other(42);
    for (const std::uint32_t expected : {71876166U, 708592740U, 1483128881U, 907283241U}) {
        CHECK(other.next() == expected);
    }
    GlibcRandom none(0);
    CHECK(none.next() == 1804289383U);
}

TEST_CASE("a seed above 2^31 counts as negative") {
    GlibcRandom random(0x80000001U);
    CHECK(random.next() == 1081815585U);
    CHECK(random.next() == 5219348U);
}
