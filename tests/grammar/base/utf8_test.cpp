// SPDX-License-Identifier: MIT
#include "grammar/base/utf8.h"

#include <catch2/catch.hpp>

using namespace lsys;

TEST_CASE("characters take as many columns as in terminals") {
    CHECK(display_width(U'A') == 1);
    CHECK(display_width(U'\t') == 1);
    CHECK(display_width(0x7F) == 1);
    CHECK(display_width(0x00E9) == 1);   // e with an acute accent
    CHECK(display_width(0x0301) == 0);   // combining acute accent
    CHECK(display_width(0x20DD) == 0);   // combining enclosing circle
    CHECK(display_width(0x200B) == 0);   // zero-width space
    CHECK(display_width(0x0903) == 1);   // Devanagari sign visarga, a spacing mark
    CHECK(display_width(0x1100) == 2);   // Hangul initial
    CHECK(display_width(0x1161) == 0);   // Hangul vowel
    CHECK(display_width(0xD7CB) == 0);   // Hangul final
    CHECK(display_width(0x4E00) == 2);   // ideograph
    CHECK(display_width(0xFF21) == 2);   // full-width A
    CHECK(display_width(0x1F332) == 2);  // evergreen tree
    CHECK(display_width(0x1F321) == 1);  // thermometer, a text character
    CHECK(display_width(0x2EBF0) == 2);  // reserved for ideographs
    CHECK(display_width(0x0378) == 1);   // unassigned
    CHECK(display_width(0x10FFFD) == 1); // private use
}

TEST_CASE("the width of a text is the sum over its characters") {
    CHECK(text_width("") == 0);
    CHECK(text_width("a\u0301b") == 2);
    CHECK(text_width("\u6728 tree") == 7);
    CHECK(text_width("\xFF\xFE") == 2); // two bytes that are not UTF-8
}
