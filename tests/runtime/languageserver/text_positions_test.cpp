// SPDX-License-Identifier: MIT
#include "runtime/languageserver/text_positions.h"

#include <catch2/catch.hpp>

#include <string>

namespace {

using lsys::PositionEncoding;
using lsys::TextPosition;
using lsys::TextPositions;

} // namespace

TEST_CASE("characters count as UTF-16 code units or as bytes") {
    // One byte, two bytes, three bytes, and a character of two UTF-16 units.
    const std::string text = "a\xC3\xA4\xE2\x82\xAC\xF0\x9F\x8C\xB2z\nb";
    const TextPositions utf16(text, PositionEncoding::Utf16);
    const TextPositions utf8(text, PositionEncoding::Utf8);
    CHECK(utf16.position(10) == TextPosition{0, 5});
    CHECK(utf8.position(10) == TextPosition{0, 10});
    CHECK(utf16.position(12) == TextPosition{1, 0});
    CHECK(utf16.offset({0, 5}) == 10);
    CHECK(utf16.offset({0, 3}) == 6);
    CHECK(utf16.offset({0, 4}) == 6); // between the halves of a surrogate pair
    CHECK(utf8.offset({0, 10}) == 10);
    CHECK(utf8.offset({0, 8}) == 6); // within a character
}

TEST_CASE("positions beyond a line or the text are their ends") {
    const std::string text = "ab\r\nc\rd\n";
    const TextPositions positions(text, PositionEncoding::Utf16);
    CHECK(positions.offset({0, 99}) == 2);
    CHECK(positions.offset({1, 0}) == 4);
    CHECK(positions.offset({1, 99}) == 5);
    CHECK(positions.offset({2, 0}) == 6);
    CHECK(positions.offset({3, 0}) == 8);
    CHECK(positions.offset({4, 0}) == 8);
    CHECK(positions.position(99) == TextPosition{3, 0});
    CHECK(positions.position(6) == TextPosition{2, 0});
}
