// SPDX-License-Identifier: MIT
#include "tests/compiler/compile_text.h"

#include <catch2/catch.hpp>

using namespace lsys;
using test::compile_text;
using Reports = std::vector<std::string>;

TEST_CASE("formals are numbered over left context, predecessor and right context") {
    const test::Compiled c =
        compile_text("#w : A(1) B(2) [ C(3, 4) ] D;\n"
                     "#p : A(a) < B(b) > [ C(c, d) ] : a < b && c < d : B(a + 10 * b + c * d);\n");
    CHECK(c.errors().empty());
    REQUIRE(c.outcome.program);
    const Production& p = c.outcome.program->productions[0];
    CHECK(p.formals.size() == 4);
    CHECK(p.left.items[0].first_formal == 0);
    CHECK(p.predecessor.items[0].first_formal == 1);
    REQUIRE(p.right.items.size() == 3);
    CHECK(p.right.items[0].kind == PatternKind::Open);
    CHECK(p.right.items[1].first_formal == 2);
    CHECK(p.right.items[2].kind == PatternKind::Close);
}

TEST_CASE("an incorrect head is reported once, and the rest of the production is not reported") {
    CHECK(compile_text("#w : A(2);\n#p : A(2) : * : F(x);\n").errors() ==
          Reports{"expression-in-head 2:8"});
    CHECK(compile_text("#w : A(2);\n#p : A(x + 1) : * : F(x);\n").errors() ==
          Reports{"expression-in-head 2:8"});
    CHECK(compile_text("#w : A(2, 3);\n#p : A(x, x) : * : F(x);\n").errors() ==
          Reports{"duplicate-parameter 2:11"});
    CHECK(compile_text("#w : A(2) A(2);\n#p : A(x) < A(x) : * : F(x);\n").errors() ==
          Reports{"duplicate-parameter 2:15"});
    CHECK(compile_text("#w : A;\n#p : : * : F;\n").errors() == Reports{"empty-predecessor 2:5"});
    CHECK(compile_text("#w : A;\n#p : < A : * : F;\n").errors() == Reports{"empty-context 2:6"});
    CHECK(compile_text("#w : A;\n#p : A > : * : F;\n").errors() == Reports{"empty-context 2:8"});
    CHECK(compile_text("#w : A B;\n#p : A B : * : F;\n").errors() ==
          Reports{"several-predecessors 2:6"});
    CHECK(compile_text("#set rewriting sequential;\n#w : A B;\n#p : A [ B : * : F;\n").errors() ==
          Reports{"bracket-in-head 3:8"});
    CHECK(compile_text("#w : A;\n#p : [ : * : F;\n").errors() == Reports{"bracket-in-head 2:6"});
    CHECK(compile_text("#w : A;\n#p : F [ < A : * : F;\n").errors() ==
          Reports{"bracket-in-head 2:8"});
    CHECK(compile_text("#w : A;\n#p : A > F ] : * : F;\n").errors() ==
          Reports{"bracket-in-head 2:12"});
    CHECK(compile_text("#w : A;\n#p : A > F [ [ ] : * : F;\n").errors() ==
          Reports{"bracket-in-head 2:12"});
    CHECK(compile_text("#w : A F [ ];\n#p : A > F [ ] : * : F;\n").errors().empty());
}

TEST_CASE("a value in a head can be moved into the condition") {
    const test::Compiled c = compile_text("#w : A(2);\n#p : A(2) : * ~ 1 : F;\n");
    CHECK(c.fixed(DiagnosticCode::ExpressionInHead) == "#w : A(2);\n#p : A(x) : x == 2 ~ 1 : F;\n");
    const test::Compiled chance = compile_text("#w : A(2);\n#p : A(2) : ~ 1 : F;\n");
    CHECK(chance.fixed(DiagnosticCode::ExpressionInHead) ==
          "#w : A(2);\n#p : A(x) : x == 2 ~ 1 : F;\n");
    const test::Compiled second = compile_text("#w : A(2, 3);\n#p : A(x, 3) : * : F(x);\n");
    CHECK(second.fixed(DiagnosticCode::ExpressionInHead) ==
          "#w : A(2, 3);\n#p : A(x, y) : y == 3 : F(x);\n");
}

TEST_CASE("a parameter hides a constant of its name") {
    const test::Compiled c = compile_text("#define x 5;\n"
                                          "#w : F(x);\n"
                                          "#p : F(x) : * : F(x + 1);\n"
                                          "#q : f(y) : * : F(y);\n"
                                          "#define y 5;\n");
    CHECK(c.at(DiagnosticCode::HiddenConstant) == "x");
    REQUIRE(c.outcome.program);
    const Program& program = *c.outcome.program;
    const Value& sum = program.value(program.arguments[1]);
    CHECK(program.value(sum.left).opcode == Opcode::Formal);
    std::size_t hidden = 0;
    for (const Diagnostic& d : c.diagnostics.all()) {
        hidden += d.code == DiagnosticCode::HiddenConstant ? 1 : 0;
    }
    CHECK(hidden == 1); // only `x` hides a constant: `#define y` comes after the production
}

TEST_CASE(
    "rules differ by predecessor, groups also by contexts, and both have the order of the text") {
    const test::Compiled c = compile_text("#w : A B A(1);\n"
                                          "#p0 : B : * : F;\n"
                                          "#p1 : A : * ~ 0.5 : F;\n"
                                          "#p2 : A(x) : * : F;\n"
                                          "#p3 : B < A : * : F;\n"
                                          "#p4 : A > B : * : F;\n"
                                          "#p5 : A > [ B ] : * : F;\n"
                                          "#p6 : A : * ~ 0.5 : F F;\n");
    REQUIRE(c.outcome.program);
    std::vector<std::uint32_t> rules;
    std::vector<std::uint32_t> groups;
    for (const Production& p : c.outcome.program->productions) {
        rules.push_back(p.rule);
        groups.push_back(p.group);
    }
    CHECK(rules == std::vector<std::uint32_t>{0, 1, 2, 1, 1, 1, 1});
    CHECK(groups == std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 1});
    CHECK(c.outcome.program->rule_count == 3);
    CHECK(c.outcome.program->context_group_count == 6);
}

TEST_CASE("probabilities are constants above 0 and at most 1") {
    const auto errors = [](const std::string& p, const std::string& set = "") {
        return compile_text(set + "#w : F(1);\n#p : F(x) : x > 1 ~ " + p + " : F(x);\n").errors();
    };
    CHECK(errors("0.5").empty());
    CHECK(errors("0") == Reports{"bad-probability 2:21"});
    CHECK(errors("-0.5") == Reports{"bad-probability 2:21"});
    CHECK(errors("2") == Reports{"bad-probability 2:21"});
    CHECK(errors("2", "#set weights any; ").empty());
    CHECK(errors("0", "#set weights any; ") == Reports{"bad-probability 2:21"});
    CHECK(errors("1 / 0") == Reports{"bad-probability 2:21"});
    CHECK(errors("x / 4") == Reports{"bad-probability 2:21"});
}

TEST_CASE("unconditional probabilities of a choice sum to 1") {
    const auto three = [](const std::string& a, const std::string& b, const std::string& c) {
        return compile_text("#w : F;\n#a : F : * ~ " + a + " : F;\n#b : F : * ~ " + b +
                            " : F F;\n#c : F : ~ " + c + " : F f;\n");
    };
    CHECK(three("0.33", "0.33", "0.33").errors().empty());
    CHECK(three("0.3", "0.3", "0.411").errors().empty());
    CHECK(three("0.3", "0.3", "0.389").errors().empty());
    const test::Compiled below = three("0.3", "0.3", "0.3");
    CHECK(below.errors() == Reports{"probability-sum 4:12"});
    CHECK(below.message(DiagnosticCode::ProbabilitySum) ==
          "the probabilities of `F` sum to 0.9, not to 1");
    CHECK(below.find(DiagnosticCode::ProbabilitySum)->label == "normalised, this would be 0.3333");
    CHECK(below.find(DiagnosticCode::ProbabilitySum)->labels.size() == 2);
    CHECK(three("0.7", "0.5", "0.1").errors() == Reports{"probability-sum 3:14"});
    CHECK(three("0.7", "0.2", "0 - 1").errors() == Reports{"bad-probability 4:12"});
    CHECK(compile_text("#w : F(1);\n#a : F(x) : x > 1 ~ 0.3 : F(x);\n#b : F(x) : * ~ 0.3 : F(2);\n")
              .errors()
              .empty()); // with conditions, the sum depends on the productions that match
    CHECK(compile_text("#set weights any;\n#w : F;\n#a : F : * ~ 3 : F;\n#b : F : * ~ 4 : F;\n")
              .errors()
              .empty());
}

TEST_CASE("a note mentions alternatives that name their parameters differently") {
    const test::Compiled c = compile_text("#w : F(1);\n"
                                          "#a : F(x) : * ~ 0.5 : F(x);\n"
                                          "#b : F(y) : * ~ 0.5 : F(y + 1);\n");
    CHECK(c.reports() == Reports{"different-parameters 3:8"});
}

TEST_CASE("a context that names an ignored module can never match") {
    const test::Compiled c = compile_text("#ignore : + f;\n"
                                          "#w : F + A;\n"
                                          "#p : F + < A : * : F;\n");
    CHECK(c.at(DiagnosticCode::IgnoredContext) == "+");
    CHECK(c.find(DiagnosticCode::IgnoredContext)->labels.size() == 1);
}

TEST_CASE("ranges of a successor are limited in sequential rewriting") {
    std::string text = "#set rewriting sequential;\n#w : F(1);\n#p : F(x) : * : ";
    for (std::uint32_t i = 0; i <= kMaxSequentialDraws; ++i) {
        text += "F({1,2})";
    }
    CHECK(compile_text(text + ";\n").errors() == Reports{"too-many-ranges 3:17"});
    CHECK(compile_text("#set choice module;\n" + text.substr(text.find('\n') + 1) + ";\n")
              .errors()
              .empty());
}

TEST_CASE("draws are numbered in the order of the closing braces") {
    const test::Compiled c =
        compile_text("#w : F(1);\n#p : F(x) : * : F({{1, 2}, 3}) F(x + {4, 5});\n");
    REQUIRE(c.outcome.program);
    const Program& program = *c.outcome.program;
    const ProgramWord& word = program.productions[0].successor;
    CHECK(word.draw_count == 3);
    const Value& outer = program.value(program.arguments[word.first_argument]);
    CHECK(outer.index == 1);
    CHECK(program.value(outer.left).index == 0);
}
