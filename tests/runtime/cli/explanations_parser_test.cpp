// SPDX-License-Identifier: MIT
#include "runtime/cli/explanations.h"

#include <catch2/catch.hpp>

using namespace lsys::lsc;

TEST_CASE("explanations are parsed into codes and texts") {
    const auto all =
        parse_explanations("# Head\n\nnot read\n\n## first-code\n\nOne.\nTwo.\n\nThree.\n\n"
                           "```lsys wrong\nrun: dump -n 3\n#w : A;\nfile: b.lsys\n#w : B;\n```\n\n"
                           "```lsys right\n#w : C;\n```\n\n## second\n\nText.\n\n"
                           "```lsys wrong sketch\nrun: x\nrun: y\n```\n");
    REQUIRE(all.size() == 2);
    CHECK(all[0].code == "first-code");
    CHECK(all[0].text == "One.\nTwo.\n\nThree.");
    REQUIRE(all[0].examples.size() == 2);
    const Example& wrong = all[0].examples[0];
    CHECK(!wrong.is_correct);
    CHECK(!wrong.is_sketch);
    CHECK(wrong.arguments == "dump -n 3");
    REQUIRE(wrong.files.size() == 2);
    CHECK(wrong.files[0] == std::pair<std::string, std::string>("example.lsys", "#w : A;\n"));
    CHECK(wrong.files[1] == std::pair<std::string, std::string>("b.lsys", "#w : B;\n"));
    CHECK(all[0].examples[1].is_correct);
    CHECK(all[0].examples[1].arguments.empty());
    REQUIRE(all[1].examples.size() == 1);
    CHECK(all[1].examples[0].is_sketch);
    CHECK(all[1].examples[0].arguments == "x");
    CHECK(all[1].examples[0].files[0].second == "run: y\n");
}

TEST_CASE("damaged explanations cause no crash") {
    CHECK(parse_explanations("").empty());
    CHECK(parse_explanations("```\n").empty());
    const auto open = parse_explanations("## x\n```lsys wrong\n#w : A;");
    REQUIRE(open.size() == 1);
    CHECK(open[0].examples[0].files[0].second == "#w : A;\n");
}
