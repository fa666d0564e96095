// SPDX-License-Identifier: MIT
#include "runtime/repair/chosen_fixes.h"
#include "runtime/repair/edited_file.h"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

using namespace lsys;
using namespace lsys::repair;

namespace {

struct Rounds {
    std::string text;
    EditedFile file;

    Rounds(std::string original, std::vector<TextPlace> statements)
        : text(std::move(original)), file(text, std::move(statements)) {}

    void round(const std::vector<Edit>& edits) {
        std::vector<const Edit*> all;
        for (const Edit& edit : edits) {
            all.push_back(&edit);
        }
        file.add_round(text, all);
        text = apply_edits(text, all);
    }
};

Edit edit(std::uint32_t begin, std::uint32_t end, std::string replacement) {
    return {{kNoFile, begin, end}, std::move(replacement)};
}

} // namespace

TEST_CASE("places of an edited text are mapped to the original text") {
    Rounds r("abcdefgh", {});
    r.round({edit(1, 1, "123"), edit(4, 6, "")});
    CHECK(r.text == "a123bcdgh");
    CHECK(r.file.original_place(0) == 0);
    CHECK(r.file.original_place(1) == 1); // begin of the edit
    CHECK(r.file.original_place(3) == 1); // within the edit
    CHECK(r.file.original_place(4) == 1); // b
    CHECK(r.file.original_place(6) == 3); // d
    CHECK(r.file.original_place(7) == 6); // g
    r.round({edit(0, 1, ""), edit(8, 9, "HHH")});
    CHECK(r.text == "123bcdgHHH");
    CHECK(r.file.original_place(3) == 1); // b
    CHECK(r.file.original_place(6) == 6); // g
    CHECK(r.file.original_place(9) == 7); // H
    CHECK(r.file.original_place(10) == 8);
}

TEST_CASE("an inserted line feed becomes a line end of the file") {
    Rounds r("a\r\nb\r\n", {});
    r.round({edit(1, 1, "\n")});
    CHECK(r.text == "a\r\n\r\nb\r\n");
    CHECK(r.file.original_place(5) == 3); // b
}

TEST_CASE("a statement is found by every place in it or at its ends") {
    //        0123456789
    Rounds r("#w:F;#p;#q", {{5, 8}, {0, 5}, {8, 10}, {0, 5}});
    REQUIRE(r.file.statements().size() == 3);
    CHECK(r.file.statements_at({2, 3}) == std::vector<std::size_t>{0});
    CHECK(r.file.statements_at({5, 5}) == std::vector<std::size_t>{0, 1});
    CHECK(r.file.statements_at({6, 7}) == std::vector<std::size_t>{1});
    r.round({edit(0, 0, "////")});
    CHECK(r.file.statements_at({11, 11}) == std::vector<std::size_t>{1});
}
