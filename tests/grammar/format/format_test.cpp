// SPDX-License-Identifier: MIT
#include "grammar/format/format.h"
#include "grammar/format/impl/lexemes.h"

#include <catch2/catch.hpp>

#include <cstdint>
#include <iterator>
#include <string>
#include <vector>

using lsys::format_text;

TEST_CASE("each statement has one line, with single blanks") {
    CHECK(format_text("#n=6;#define  a  -1;#param b 2*(a+1)  {0,5};") ==
          "#n = 6;\n#define a -1;\n#param  b 2*(a + 1) {0, 5};\n");
    CHECK(format_text("#p:A(x,y):x>1&&y<=-2~.5:F( x^2 ,-y ) ;") ==
          "#p : A(x, y) : x > 1 && y <= -2 ~ .5 : F(x^2, -y);\n");
    CHECK(format_text("#q : A:*~ 0.3: ;") == "#q : A : * ~ 0.3 : ;\n");
    CHECK(format_text("#set  tropism 0 -1 0 .2 ;") == "#set tropism 0 -1 0 .2;\n");
    CHECK(format_text("#object F\n BRANCH;\n#include \"a  b.lsys\" ;") ==
          "#object F BRANCH;\n#include \"a  b.lsys\";\n");
    CHECK(format_text("#define r {1,sin ( 3 )};") == "#define r {1, sin(3)};\n");
}

TEST_CASE("blanks between modules stay, and contexts are surrounded by blanks") {
    CHECK(format_text("#w:F+F  [ -F]`;`(2) A (3)B;") == "#w : F+F [ -F]`;`(2) A(3)B;\n");
    CHECK(format_text("#p:A B<C(x)>[D]E:*://F;") == "#p : A B < C(x) > [D]E : * : //F;\n");
    CHECK(format_text("#define : A : * : { . F } ;") == "#define : A : * : { . F };\n");
}

TEST_CASE("local values stand between condition and successor") {
    CHECK(format_text("#p:A(x):*:let l=x*2,m=-l :F(l)[A(m)] ;") ==
          "#p : A(x) : * : let l = x*2, m = -l : F(l)[A(m)];\n");
    CHECK(format_text("#p:A:*:let A let(2);") == "#p : A : * : let A let(2);\n");
    CHECK(format_text("#p:A:*:let/**/l/**/=2:F(l);\n#q:B:*:F;") ==
          "#p : A : * : let /**/ l /**/ = 2 : F(l);\n#q : B : * : F;\n");
}

TEST_CASE("a quotation mark may be a module") {
    CHECK(format_text("#object   \" LEAF ;\n#w:F;") == "#object \" LEAF;\n#w : F;\n");
    CHECK(format_text("#module \" ;#w:\"F\";") == "#module \";\n#w : \"F\";\n");
}

TEST_CASE("statements on one line get lines of their own") {
    CHECK(format_text("#n=1;#w:F;/* c */#p:F:*:F;") ==
          "#n = 1;\n#w : F;  /* c */\n#p : F : * : F;\n");
    CHECK(format_text("/* c */#n=1;#w:F;") == "/* c */ #n = 1;\n#w : F;\n");
}

TEST_CASE("a comment stays apart from characters that could change its meaning") {
    CHECK(format_text("#w:F/ /*c*/ /A(2/ /*c*/ /**/3);") == "#w : F/ /*c*/ /A(2/ /*c*/ /**/ 3);\n");
    CHECK(format_text("#w:F(/*c*/1/*d*/)/*e*/;") == "#w : F(/*c*/ 1 /*d*/) /*e*/;\n");
}

TEST_CASE("a file keeps its line ends") {
    const std::string text = "// a \r\n\r\n\r\n#n=1;\r\n/* b\r\n c */\r\n#w:F\r\n[A];";
    const std::string lines = "// a\r\n\r\n#n = 1;\r\n/* b\r\n c */\r\n#w : F\r\n    [A];\r\n";
    CHECK(format_text(text) == lines);
    CHECK(format_text(lines) == lines);
    // Mixed line ends become the more frequent kind; a single carriage return is not a line end.
    CHECK(format_text("#n=1;\r\n\n\n#w:F; // a\rb\n") == "#n = 1;\n\n#w : F;  // a\rb\n");
    CHECK(format_text("#n=1;\r\n#w:F;\r\n#p:F:*:F;\n") ==
          "#n = 1;\r\n#w : F;\r\n#p : F : * : F;\r\n");
    CHECK(format_text("") == "");
    CHECK(format_text("\n\n") == "");
}

TEST_CASE("comments and single blank lines are kept") {
    const std::string text =
        "// top\n\n\n\n#n = 3; // here\n/* own */\n#w : /* in */ F; /* after */\n"
        "/* before */ #p : F : * : F /*x*/(1);";
    const std::string expected =
        "// top\n\n#n = 3;  // here\n/* own */\n#w : /* in */ F;  /* after */\n"
        "/* before */ #p : F : * : F /*x*/ (1);\n";
    CHECK(format_text(text) == expected);
    CHECK(format_text(expected) == expected);
}

TEST_CASE("columns are aligned after the widest cell that is not too wide") {
    const std::string wide(24, 'B');
    CHECK(format_text("#p:A:*:F;\n#q:A" + wide + ":*:F;\n") ==
          "#p : A" + std::string(24, ' ') + " : * : F;\n#q : A" + wide + " : * : F;\n");
    CHECK(format_text("#p:A:*:F;\n#q:AB" + wide + ":*:F;\n") ==
          "#p : A : * : F;\n#q : AB" + wide + " : * : F;\n");
    CHECK(format_text("#n=1; // a\n#w:A" + wide + wide + "; // b\n") ==
          "#n = 1;  // a\n#w : A" + wide + wide + ";  // b\n");
}

TEST_CASE("long statements are wrapped at blanks, and formatting again changes nothing") {
    std::string text = "#w : ";
    for (int i = 0; i < 60; ++i) {
        text += "F(1, 2)[+ A] ";
    }
    const std::string once = format_text(text + ";");
    CHECK(once.find("\n    ") != std::string::npos);
    std::size_t begin = 0;
    for (std::size_t end = once.find('\n'); end != once.npos; end = once.find('\n', begin)) {
        CHECK(end - begin <= 100);
        begin = end + 1;
    }
    CHECK(format_text(once) == once);
}

TEST_CASE("formatting keeps every token of random layouts") {
    const std::vector<std::vector<std::string>> statements = {
        {"#n", "=", "6", ";"},
        {"#define", "a", "-", "1", "+", "{", "2", ",", "sin", "(", "30", ")", "}", ";"},
        {"#param", "b", "2", "{", "0", ",", "5", "}", ";"},
        {"#set", "tropism", "0", "-", "1", "0", ".2", ";"},
        {"#ignore", ":", "+", "-", ";"},
        {"#w", ":", "F", "(", "1", ")", "[", "+", "A", "]", "/", "/", "A", ";"},
        {"#p", ":", "A", "<", "B",  "(", "x", ")",   ">",   "[", "C", "]",
         ":",  "x", "^", "2", ">=", "!", "a", "~",   "0.5", ":", "F", "(",
         "x",  "*", "2", ",", "-",  "x", ")", "`;`", "{",   ".", "}", ";"},
        {"#q", ":", "A", ":", "*", "~", "1e-3", ":", ";"},
    };
    const char* const gaps[] = {" ", "\n  ", "\t", " /* c */ ", "\r\n\r\n"};
    const char* const between[] = {"", "\n", "\n\n\n", " // note\n", "\n/* own */\n", " /* a */ "};
    std::uint32_t state = 12345;
    const auto next = [&](std::size_t count) {
        state = state * 1664525U + 1013904223U;
        return (state >> 16) % count;
    };
    for (int round = 0; round < 500; ++round) {
        std::string text;
        for (int i = 0; i < 12; ++i) {
            for (const std::string& token : statements[next(statements.size())]) {
                text += token + gaps[next(8) < 6 ? 0 : next(std::size(gaps))];
            }
            text += between[next(std::size(between))];
        }
        const std::string once = format_text(text);
        INFO(text);
        CHECK(format_text(once) == once);
        const std::vector<lsys::Lexeme> before = lsys::lexemes_of(text);
        const std::vector<lsys::Lexeme> after = lsys::lexemes_of(once);
        REQUIRE(before.size() == after.size());
        for (std::size_t i = 0; i < before.size(); ++i) {
            CHECK(before[i].text == after[i].text);
            CHECK(before[i].kind == after[i].kind);
        }
    }
}
