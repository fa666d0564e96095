// SPDX-License-Identifier: MIT
#include "runtime/pipeline/value_edits.h"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

namespace lsys {

namespace {

/// The text with the values written to it, or the message of an error.
std::string written(const std::string& text, const StatementValues& values) {
    const FileLoader load = [](const std::string& path) -> Result<std::string> {
        return path == "common.lsys"
                   ? Result<std::string>(std::string("#set width 2;\n#define part 3;\n"))
                   : Error{"no such file"};
    };
    const Result<std::string> result = with_values("a.lsys", text, values, load);
    return result ? result.value() : result.error().message;
}

std::string
with_setting(const std::string& text, const std::string& key, const std::string& value) {
    return written(text, {{}, {}, {{key, value}}});
}

} // namespace

TEST_CASE("only the value of the statement is replaced") {
    const std::string text = "// a\r\n#n  =  3 ; #set angle   25 ; // b\r\n"
                             "#param size (1 + 2) {0, 9}; #define half\t-0.5;\r\n#w : F;";
    CHECK(with_setting(text, "angle", "30") ==
          "// a\r\n#n  =  3 ; #set angle   30 ; // b\r\n"
          "#param size (1 + 2) {0, 9}; #define half\t-0.5;\r\n#w : F;");
    CHECK(written(text, {7, {{"size", 1.5F}, {"half", 1e-5F}}, {}}) ==
          "// a\r\n#n  =  7 ; #set angle   25 ; // b\r\n"
          "#param size 1.5 {0, 9}; #define half\t1e-05;\r\n#w : F;");
    CHECK(with_setting("#set tropism 0 -1\n0 0.2; #w : F;", "tropism", "1 0 0 0.5") ==
          "#set tropism 1 0 0 0.5; #w : F;");
    CHECK(with_setting(text, "angle", "25") == text);
    CHECK(written(text, {}) == text);
}

TEST_CASE("a setting without a statement is inserted after the last setting") {
    CHECK(with_setting("#set step 2;\n#set sides 5; // c\n#w : F;\n", "angle", "30") ==
          "#set step 2;\n#set sides 5; // c\n#set angle 30;\n#w : F;\n");
    CHECK(with_setting("#w : F;\r\n#set step 2;\r\n", "angle", "30") ==
          "#w : F;\r\n#set step 2;\r\n#set angle 30;\r\n");
    CHECK(with_setting("#w : F;\n#set step 2;", "angle", "30") ==
          "#w : F;\n#set step 2;\n#set angle 30;");
    // Text after the statement stays on its line.
    CHECK(with_setting("#set step 2; /* a\nb */ #w : F;\n", "angle", "30") ==
          "#set step 2;\n#set angle 30; /* a\nb */ #w : F;\n");
    CHECK(with_setting("#set step 2; #w :\nF;\n", "angle", "30") ==
          "#set step 2;\n#set angle 30; #w :\nF;\n");
}

TEST_CASE("the first setting of a file is inserted after the comments at its start") {
    CHECK(with_setting("// title\n\n  #n = 1;\n#w : F;\n", "angle", "30") ==
          "// title\n\n#set angle 30;\n  #n = 1;\n#w : F;\n");
    CHECK(with_setting("/* title\n*/ #w : F;\n", "angle", "30") ==
          "/* title\n*/ #set angle 30;\n#w : F;\n");
    CHECK(with_setting("\xEF\xBB\xBF#w : F;\r\n", "angle", "30") ==
          "\xEF\xBB\xBF#set angle 30;\r\n#w : F;\r\n");
    CHECK(written("#w : F;\n", {5, {}, {{"angle", "1"}, {"step", "2"}}}) ==
          "#n = 5;\n#set angle 1;\n#set step 2;\n#w : F;\n");
}

TEST_CASE("constants of a value are defined before it") {
    CHECK(with_setting("#w : F;\n#define a 2;\n", "angle", "(a * 2)") ==
          "#w : F;\n#define a 2;\n#set angle (a * 2);\n");
    CHECK(with_setting("#set angle 1;\n#define a 2;\n#w : F;\n", "angle", "a") ==
          "`#set angle` uses a constant that is defined after it");
    CHECK(with_setting("#set step 1;\n#include \"common.lsys\";\n#w : F;\n", "angle", "part") ==
          "#set step 1;\n#include \"common.lsys\";\n#set angle part;\n#w : F;\n");
}

TEST_CASE("included files never change") {
    const std::string text = "#include \"common.lsys\";\n#w : F;\n";
    CHECK(with_setting(text, "width", "1") ==
          "`#set width` stands in the included file `common.lsys`; change it there");
    CHECK(written(text, {{}, {{"part", 1.0F}}, {}}) ==
          "`#define part` stands in the included file `common.lsys`; change it there");
    CHECK(written(text, {{}, {{"none", 1.0F}}, {}}) == "`a.lsys` has no #define or #param `none`");
    CHECK(with_setting(text, "angle", "1") == "#set angle 1;\n" + text);
    CHECK(with_setting("#w : F", "angle", "1") == "`a.lsys` has errors");
}

} // namespace lsys
