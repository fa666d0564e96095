// SPDX-License-Identifier: MIT
#include "tests/support/ui_case.h"

#include <catch2/catch.hpp>

using namespace lsys::tests;

TEST_CASE("run lines are split at blanks outside quotes") {
    CHECK(split_words(" dump  -n 3 ") == std::vector<std::string>{"dump", "-n", "3"});
    CHECK(split_words("a 'b c'd ''") == std::vector<std::string>{"a", "b cd", ""});
    CHECK(split_words("").empty());
}

TEST_CASE("runs of a case are read from its first lines") {
    const UiCase found =
        parse_ui_case("x.lsys", "\xEF\xBB\xBF// run: check\r\n// A sentence.\n"
                                "// run: dump - < %\n// exit: 1\n#w : A;\n// run: late\n");
    REQUIRE(found.runs.size() == 2);
    CHECK(found.runs[0].words == std::vector<std::string>{"check"});
    CHECK(found.runs[0].exit_status == 0);
    CHECK(found.runs[1].words == std::vector<std::string>{"dump", "-"});
    CHECK(found.runs[1].input == "%");
    CHECK(found.runs[1].exit_status == 1);
    CHECK(found.mistakes.empty());
    CHECK(parse_ui_case("x.lsys", "#w : A;\n").mistakes.size() == 1);
    CHECK(parse_ui_case("x.lsys", "// exit: 1\n// run: check\n").mistakes.size() == 1);
}

TEST_CASE("annotations have severity, text, code and line") {
    const UiCase found = parse_ui_case("x.lsys", "// run: check\n"
                                                 "#a ; //~ error: wrong `[` here [some-code]\n"
                                                 "#b /*~^ warning: odd */ /*~vv note: [n-1] */ ;\n"
                                                 "//~? error: anywhere [not a code]\n");
    REQUIRE(found.annotations.size() == 4);
    CHECK(found.annotations[0].line == 2);
    CHECK(found.annotations[0].severity == "error");
    CHECK(found.annotations[0].text == "wrong `[` here");
    CHECK(found.annotations[0].code == "some-code");
    CHECK(found.annotations[1].line == 2);
    CHECK(found.annotations[1].text == "odd");
    CHECK(found.annotations[1].code.empty());
    CHECK(found.annotations[2].line == 5);
    CHECK(found.annotations[2].text.empty());
    CHECK(found.annotations[2].code == "n-1");
    CHECK(found.annotations[3].line == 0);
    CHECK(found.annotations[3].text == "anywhere [not a code]");
    CHECK(parse_ui_case("x.lsys", "// run: check\n//~ what\n").mistakes.size() == 1);
}

TEST_CASE("diagnostics are read from every format") {
    const auto all = parse_diagnostics("a.lsys:2:3: error: wrong: error: `x` [bad-x]\n"
                                       "  2 | : error: no [code]\n"
                                       "note: seen here: a.lsys:1:2\n"
                                       "lsc: error: limit [limit-reached]\n"
                                       "lsc: error: no such file\n"
                                       "{\"severity\":\"note\",\"code\":\"n\",\"message\":\"m\","
                                       "\"file\":\"a.lsys\",\"line\":7}\n"
                                       "{\"severity\":\"error\",\"message\":\"m\"}\n");
    REQUIRE(all.size() == 3);
    CHECK(all[0].file == "a.lsys");
    CHECK(all[0].line == 2);
    CHECK(all[0].message == "wrong: error: `x`");
    CHECK(all[0].code == "bad-x");
    CHECK(all[1].file.empty());
    CHECK(all[1].code == "limit-reached");
    CHECK(all[2].line == 7);
    CHECK(all[2].severity == "note");
}

TEST_CASE("an annotation matches only a diagnostic of its line") {
    const UiDiagnostic diagnostic{"a.lsys", 4, "error", "module `A` is wrong", "bad"};
    CHECK(matches({4, 4, "error", "`A`", "bad"}, diagnostic, "a.lsys"));
    CHECK(matches({4, 4, "error", "", ""}, diagnostic, "a.lsys"));
    CHECK(matches({0, 9, "error", "", "bad"}, diagnostic, "b.lsys"));
    CHECK(!matches({4, 4, "error", "", "bad"}, diagnostic, "b.lsys"));
    CHECK(!matches({3, 4, "error", "", "bad"}, diagnostic, "a.lsys"));
    CHECK(!matches({4, 4, "warning", "", "bad"}, diagnostic, "a.lsys"));
    CHECK(!matches({4, 4, "error", "`B`", "bad"}, diagnostic, "a.lsys"));
    CHECK(!matches({4, 4, "error", "", "good"}, diagnostic, "a.lsys"));
}

TEST_CASE("comments of a scene begin with a hash") {
    const UiCase found = parse_ui_case("x.toml", "# run: forest --check\n# exit: 1\n"
                                                 "rho = 2 #~ error: it must be [bad-scene-value]\n"
                                                 "map = \"a//~b\"\n");
    CHECK(found.mistakes.empty());
    REQUIRE(found.runs.size() == 1);
    CHECK(found.runs[0].exit_status == 1);
    REQUIRE(found.annotations.size() == 1);
    CHECK(found.annotations[0].line == 3);
    CHECK(found.annotations[0].code == "bad-scene-value");
}
