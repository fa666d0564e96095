// SPDX-License-Identifier: MIT
#include "grammar/base/paths.h"

#include <catch2/catch.hpp>

#include <filesystem>

using namespace lsys;

TEST_CASE("a path has a folder with its separator, and a name") {
    CHECK(folder_of_path("a/b/c.lsys") == "a/b/");
    CHECK(name_of_path("a/b/c.lsys") == "c.lsys");
    CHECK(folder_of_path("c.lsys").empty());
    CHECK(name_of_path("c.lsys") == "c.lsys");
    CHECK(folder_of_path("/c") == "/");
    CHECK(name_of_path("a/").empty());
    CHECK(folder_of_path("").empty());
    CHECK(name_of_path("").empty());
}

TEST_CASE("a path is absolute or relative, of a folder or of a file") {
    CHECK(is_absolute_path("/a"));
    CHECK(!is_absolute_path("a/b"));
    CHECK(!is_absolute_path("./a"));
    CHECK(!is_absolute_path(""));
    CHECK(names_folder("a/"));
    CHECK(!names_folder("a"));
    CHECK(!names_folder(""));
}

TEST_CASE("backslashes and drives are of Windows") {
    const bool is_windows = std::filesystem::path::preferred_separator == '\\';
    CHECK(is_absolute_path("C:\\plants\\a.lsys") == is_windows);
    CHECK(is_absolute_path("C:/plants/a.lsys") == is_windows);
    CHECK(!is_absolute_path("C:a.lsys"));
    CHECK(names_folder("a\\") == is_windows);
    CHECK(name_of_path("a\\b/c\\d.lsys") == (is_windows ? "d.lsys" : "c\\d.lsys"));
}

TEST_CASE("a path made from a text converts back to the same text") {
    const std::filesystem::path named = u8"\u00E4hre/\u9EA6.lsys";
    CHECK(path_of("\xC3\xA4hre/\xE9\xBA\xA6.lsys") == named);
    CHECK(path_text(path_of("\xC3\xA4hre/\xE9\xBA\xA6.lsys")) == "\xC3\xA4hre/\xE9\xBA\xA6.lsys");
    CHECK(!path_of("\xFF").empty()); // not UTF-8
    CHECK(path_of("").empty());
}

TEST_CASE("the text of a path has slashes and is kept otherwise") {
    CHECK(path_text(std::filesystem::path("a") / "b.lsys") == "a/b.lsys");
    CHECK(path_text("a//b/./c") == "a//b/./c");
    CHECK(path_text(u8"\u00E4/\u9EA6") == "\xC3\xA4/\xE9\xBA\xA6"); // UTF-8
    CHECK(path_text("").empty());
}
