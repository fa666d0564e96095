// SPDX-License-Identifier: MIT
// Text functions of the front ends of dialects.
#include "grammar/dialects/impl/text.h"

#include <catch2/catch.hpp>

#include <string>

namespace {

using namespace lsys;

} // namespace

TEST_CASE("trimming keeps the place of a text in its file") {
    const std::string_view text = " \ta b\r ";
    CHECK(trimmed(text) == "a b");
    CHECK(trimmed(text).data() == text.data() + 2);
    CHECK(trimmed(" \n", " ") == "\n");
    CHECK(trimmed(" \t ").empty());
    CHECK(trimmed(text.substr(0, 2)).data() == text.data() + 2);
    CHECK(trimmed("").empty());
}

TEST_CASE("a length ends at the first stop") {
    CHECK(length_up_to("ab=c", "=;") == 2);
    CHECK(length_up_to("=c", "=;") == 0);
    CHECK(length_up_to("abc", "=;") == 3);
    CHECK(length_up_to(std::string_view("a\0b", 3), std::string_view("\0", 1)) == 1);
}

TEST_CASE("a number has a sign only where one is allowed") {
    for (const char* const number : {"0", "12", "1.5", ".5", "5.", "1e3", "2.5E-1"}) {
        INFO(number);
        CHECK(is_number(number));
        CHECK(is_number("-" + std::string(number), "-"));
        CHECK(is_number("+" + std::string(number), "+-"));
        CHECK(!is_number("-" + std::string(number)));
        CHECK(!is_number("+" + std::string(number), "-"));
    }
    for (const char* const other : {"", "-", "x", "1x", "1 ", " 1", ".", "--1"}) {
        INFO(other);
        CHECK(!is_number(other, "-"));
    }
}

TEST_CASE(
    "letters become lower case, and values are written in the shortest form that reads back") {
    CHECK(lowered("AzZ-\xC3\x84") == "azz-\xC3\x84");
    CHECK(text_of(0.1F) == "0.1");
    CHECK(text_of(-22.5F) == "-22.5");
    CHECK(text_of(45.0F) == "45");
    CHECK(is_one_of('+', "+-"));
    CHECK(!is_one_of('*', "+-"));
}
