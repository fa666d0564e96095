// SPDX-License-Identifier: MIT
// Text with colour codes of a terminal, split into lines of runs of equal colour.
#include "viewer/app/styled_text.h"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

using namespace lsys::view;

namespace {

/// Runs as "colour:text", lines separated by "/".
std::string shown(const std::string& text) {
    std::string all;
    for (const TextLine& line : styled_lines(text)) {
        all += all.empty() ? "" : "/";
        for (const TextRun& run : line) {
            all += std::to_string(static_cast<int>(run.colour)) + ":" + run.text + ";";
        }
    }
    return all;
}

} // namespace

TEST_CASE("text is split at line ends and at colour codes") {
    CHECK(styled_lines("").empty());
    CHECK(shown("a\nb") == "0:a;/0:b;");
    CHECK(shown("a\n") == "0:a;");
    CHECK(styled_lines("a\n\nb").size() == 3);
    CHECK(styled_lines("a\n\nb")[1].empty());
    CHECK(shown("x \x1b[1;32mapplies\x1b[0m y") == "0:x ;3:applies;0: y;");
    CHECK(shown("\x1b[1;34m  7 |\x1b[0m #a") == "5:  7 |;0: #a;");
    // A colour continues past a line end; an unknown code changes nothing, a broken one ends the
    // text.
    CHECK(shown("\x1b[1;36ma\nb\x1b[m c") == "6:a;/6:b;0: c;");
    CHECK(shown("\x1b[1ma\x1b[9mb") == "1:ab;");
    CHECK(shown("a\x1b[1") == "0:a;");
}

TEST_CASE("a line without its colour codes is plain text") {
    const std::vector<TextLine> lines = styled_lines("x \x1b[1;32mapplies\x1b[0m y\n");
    REQUIRE(lines.size() == 1);
    CHECK(plain_text(lines[0]) == "x applies y");
}
