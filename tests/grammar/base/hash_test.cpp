// SPDX-License-Identifier: MIT
#include "grammar/base/hash.h"

#include <catch2/catch.hpp>

#include <string>

using namespace lsys;

// Published values, and values on which files, pictures and printed digests depend.
TEST_CASE("hash functions have their known values") {
    CHECK(mix64(0) == 0);
    CHECK(mix64(1) == 0xB456BCFC34C2CB2C);
    CHECK(fnv1a(std::string()) == 0xCBF29CE484222325);
    CHECK(fnv1a(std::string("a")) == 0xAF63DC4C8601EC8C);
    CHECK(fnv1a(std::string("foobar")) == 0x85944171F73967E8);
    CHECK(lowbias32(0) == 0);
    CHECK(lowbias32(1) == 0x688990C0);
    CHECK(lattice32(0, 0) == 0);
    CHECK(lattice32(3, 7) == 0x45F1286C);
    CHECK(lattice32(3, 7, 2) == 0x8477E477);
    CHECK(unit_float(0xFFFFFFFF) < 1.0F);
    CHECK(finish(combine(combine(0, 1), 2)) == 0x93E7E8D43F218E65);
    CHECK(finish(combine_bytes(0, "eleven bytes")) == 0x00D4EBB5E3D24F96);
}

TEST_CASE("the hash depends on the number of bytes") {
    const std::string zeros(16, '\0');
    const std::string_view all = zeros;
    CHECK(combine_bytes(1, all.substr(0, 3)) != combine_bytes(1, all.substr(0, 4)));
    CHECK(combine_bytes(1, all.substr(0, 8)) != combine_bytes(1, all));
    CHECK(combine_bytes(1, "") == combine(1, 0));
}
