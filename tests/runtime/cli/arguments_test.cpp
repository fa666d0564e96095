// SPDX-License-Identifier: MIT
#include "runtime/program/arguments.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lsys;
using namespace lsys;

TEST_CASE("whole numbers must be within their bounds") {
    CHECK(parse_integer("0", 0, 9).value() == 0);
    CHECK(parse_integer("18446744073709551615", 0, ~std::uint64_t{0}).value() == ~std::uint64_t{0});
    CHECK(parse_integer("10", 0, 9).error().message == "`10` is not a whole number from 0 to 9");
    for (const char* text :
         {"", "-1", "+1", "1.5", "1e3", " 1", "1 ", "0x1", "18446744073709551616"}) {
        INFO(text);
        CHECK(!parse_integer(text, 0, ~std::uint64_t{0}).ok());
    }
}

TEST_CASE("sizes may have suffixes for powers of 1024") {
    CHECK(parse_size("1048576").value() == 1'048'576);
    CHECK(parse_size("1K").value() == 1024);
    CHECK(parse_size("1k").value() == 1024);
    CHECK(parse_size("500M").value() == 500ULL << 20);
    CHECK(parse_size("1.5G").value() == 3ULL << 29);
    CHECK(parse_size("2GiB").value() == 2ULL << 30);
    CHECK(parse_size("2GB").value() == 2ULL << 30);
    CHECK(parse_size("1T").value() == 1ULL << 40);
    for (const char* text : {"", "0", "-1", "M", "1X", "1.5", "1MM", "1e30", "inf", "nanG", "B"}) {
        INFO(text);
        CHECK(!parse_size(text).ok());
    }
}

TEST_CASE("a definition consists of a name and a number") {
    CHECK(parse_definition("a=2").value().name == "a");
    CHECK(parse_definition("a=2").value().value == 2.0F);
    CHECK(parse_definition("x_1=-1.5e-3").value().value == -1.5e-3F);
    CHECK(parse_definition("a=.5").value().value == 0.5F);
    CHECK(parse_definition("a=0.1").value().value == 0.1F);
    CHECK(parse_definition("a=1e-50").value().value == 0.0F);
    CHECK(parse_definition("a=1e-40").value().value == 1e-40F);
    for (const char* text :
         {"", "a", "=1", "a=", "1a=2", "a b=2", "a=1x", "a=inf", "a=nan", "a=1e40", "a=-1e400"}) {
        INFO(text);
        CHECK(!parse_definition(text).ok());
    }
}
