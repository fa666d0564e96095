// SPDX-License-Identifier: MIT
#include "grammar/base/text_form.h"

#include <catch2/catch.hpp>

#include <string>

using namespace lsys;

namespace {

std::string as_utf16(std::string_view text, bool big_endian) {
    std::string out;
    for (const char c : text) {
        out += big_endian ? std::string{'\0', c} : std::string{c, '\0'};
    }
    return out;
}

} // namespace

TEST_CASE("binary files are recognised") {
    CHECK(recognise_non_text("\xFF\xFE#")->what == "UTF-16 text");
    CHECK(recognise_non_text(as_utf16("#n = 1; #w : F;", false))->what == "UTF-16 text");
    CHECK(recognise_non_text(as_utf16("#n = 1; #w : F;", true))->what == "UTF-16 text");
    CHECK(recognise_non_text(std::string("\xFF\xFE\0\0#\0\0\0", 8))->what == "UTF-32 text");
    CHECK(recognise_non_text("%PDF-1.7\n")->what == "a PDF document");
    CHECK(recognise_non_text("\x89PNG\r\n")->what == "a PNG picture");
    CHECK(recognise_non_text(std::string(100, '\x02'))->what == "binary data");
    // ASCII text in big-endian UTF-16 begins with a NUL byte; this text has UTF-16 only later.
    CHECK(recognise_non_text("#w : F" + as_utf16(std::string(40, 'F'), true))->what ==
          "binary data");
}

TEST_CASE("texts with a few odd bytes are texts") {
    CHECK(!recognise_non_text(""));
    CHECK(!recognise_non_text("#n = 1;\r\n\t#w : F;"));
    CHECK(!recognise_non_text("\xEF\xBB\xBF#n = 1;"));
    CHECK(!recognise_non_text(std::string("#w : F\0 F\0;", 11)));
    CHECK(!recognise_non_text(std::string("\0", 1)));
    CHECK(!recognise_non_text("/* \xE9t\xE9 */ #w : F;"));
}
