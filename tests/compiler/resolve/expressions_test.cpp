// SPDX-License-Identifier: MIT
#include "compiler/bytecode/verify.h"
#include "tests/compiler/compile_text.h"

#include <catch2/catch.hpp>

using namespace lsys;
using test::compile_text;
using Reports = std::vector<std::string>;

namespace {

/// The value of a constant expression, read from the first parameter of the axiom.
float folded(const std::string& expression) {
    const test::Compiled c = compile_text("#w : F(" + expression + ");");
    CAPTURE(expression, c.reports());
    REQUIRE(c.outcome.program);
    const Program& program = *c.outcome.program;
    const Value& value = program.value(program.arguments[0]);
    REQUIRE(value.opcode == Opcode::Literal);
    return value.literal;
}

} // namespace

TEST_CASE("constants are folded with the usual precedence") {
    CHECK(folded("1 + 2 * 3") == 7.0F);
    CHECK(folded("(1 + 2) * 3") == 9.0F);
    CHECK(folded("-2 ^ 2") == -4.0F);
    CHECK(folded("2 ^ -1") == 0.5F);
    CHECK(folded("2 ^ 3 ^ 2") == 512.0F);
    CHECK(folded("10 - 4 - 3") == 3.0F);
    CHECK(folded("!0 + !5") == 1.0F);
    CHECK(folded("1 < 2 == 1") == 1.0F);
    CHECK(folded("0 || 2 && 0") == 0.0F);
    CHECK(folded("sin(30) + cos(60) + atan2(1, 0)") == 91.0F);
    CHECK(folded("mod(-7, 3) + min(1, 2) + max(1, 2) + pow(2, 3)") == 10.0F);
    CHECK(folded("0.1 + 0.2") == 0.1F + 0.2F);
}

TEST_CASE("a constant expression needs no instructions at run time") {
    const test::Compiled c = compile_text("#define a 30;\n"
                                          "#define b a * 2;\n"
                                          "#w : F(b / 4) F(15);\n");
    REQUIRE(c.outcome.bytecode);
    CHECK(c.outcome.bytecode->folded.size() == 1);
    CHECK(c.outcome.bytecode->constants == std::vector<float>{15.0F});
    CHECK(c.outcome.bytecode->instructions.empty());
}

TEST_CASE("an unknown name is reported at its place, with the most similar name") {
    const test::Compiled c = compile_text("#define length 2;\n"
                                          "#w : F(lenght);\n");
    CHECK(c.errors() == Reports{"unknown-name 2:8"});
    CHECK(c.find(DiagnosticCode::UnknownName)->help == Reports{"did you mean `length`?"});
}

TEST_CASE("Crankshaw 2019, 2.6: `w` is used, but the only parameter is `x`") {
    const test::Compiled c = compile_text("#w : F(1);\n"
                                          "#p1 : F(x) : * : F(w) + F(w);\n");
    CHECK(c.errors() == Reports{"unknown-name 2:20"}); // reported once per statement
    const Diagnostic& error = *c.find(DiagnosticCode::UnknownName);
    CHECK(error.help == Reports{"did you mean `x`?"});
    CHECK(error.notes == Reports{"the parameters of this production: `x`"});
}

TEST_CASE("a constant must precede its use") {
    const test::Compiled c = compile_text("#w : F(a);\n"
                                          "#define a 1;\n");
    CHECK(c.errors() == Reports{"used-before-definition 1:8"});
    CHECK(c.find(DiagnosticCode::UsedBeforeDefinition)->labels.size() == 1);
}

TEST_CASE("a use of an incorrect definition is no further error") {
    CHECK(compile_text("#define a b;\n#define c a + 1;\n#w : F(a) F(c);\n").errors() ==
          Reports{"unknown-name 1:11"});
    CHECK(compile_text("#define a 1 1;\n#w : F(a);\n").errors().size() == 1);
    CHECK(compile_text("#include \"missing.lsys\";\n#w : F(a);\n").errors() ==
          Reports{"include-not-found 1:10"});
}

TEST_CASE("functions are known by name and number of arguments") {
    CHECK(compile_text("#w : F(squrt(4));").errors() == Reports{"unknown-function 1:8"});
    CHECK(compile_text("#w : F(sin());").errors() == Reports{"wrong-argument-count 1:8"});
    CHECK(compile_text("#w : F(atan2(1));").errors() == Reports{"wrong-argument-count 1:8"});
    CHECK(compile_text("#w : F(min(1, 2, 3));").errors() == Reports{"wrong-argument-count 1:8"});
    const test::Compiled c = compile_text("#w : F(2);\n#p : F(x) : * : F(x(2));\n");
    CHECK(c.find(DiagnosticCode::UnknownFunction)->help ==
          Reports{"`x` is a number; to multiply, write `x * (...)`"});
    const test::Compiled bare = compile_text("#w : F(sin);");
    CHECK(bare.find(DiagnosticCode::UnknownName)->help ==
          Reports{"functions take parentheses: `sin(x)`"});
}

TEST_CASE("names of functions are reserved only before a parenthesis") {
    const test::Compiled c =
        compile_text("#define sin 2;\n"
                     "#w : F(sin);\n"
                     "#p : F(step) : step < 9 : F(sin(sin) + step + step());\n");
    CHECK(c.errors().empty());
}

TEST_CASE("step and steps have values in conditions and successors only") {
    CHECK(compile_text("#define a step();\n#w : F(1);\n").errors() ==
          Reports{"step-not-allowed 1:11"});
    CHECK(compile_text("#w : F(steps());").errors() == Reports{"step-not-allowed 1:8"});
    CHECK(compile_text("#w : F;\n#p : F : * ~ step() : F;\n").errors() ==
          Reports{"step-not-allowed 2:14"});
    const test::Compiled c = compile_text("#w : F(1);\n#p : F(x) : step() < 2 : F(steps() - x);\n");
    REQUIRE(c.outcome.bytecode);
    CHECK(c.outcome.bytecode->uses_steps);
    CHECK_FALSE(
        compile_text("#w : F(1);\n#p : F(x) : step() < 2 : F;\n").outcome.bytecode->uses_steps);
}

TEST_CASE("random ranges are allowed where they can be drawn") {
    CHECK(compile_text("#n = {1, 2};\n#w : F;\n").errors() == Reports{"range-not-allowed 1:6"});
    CHECK(compile_text("#set angle ({1, 2});\n#w : F;\n").errors() ==
          Reports{"range-not-allowed 1:13"});
    CHECK(compile_text("#param a 1 {0, {1, 2}};\n#w : F(a);\n").errors() ==
          Reports{"range-not-allowed 1:16"});
    CHECK(compile_text("#w : F(1);\n#p : F(x) : {0, 1} < x : F(x);\n").errors() ==
          Reports{"range-not-allowed 2:13"});
    CHECK(compile_text("#w : F;\n#p : F : * ~ {0, 1} : F;\n").errors() ==
          Reports{"range-not-allowed 2:14"});
    const std::string drawn = "#define r {0, 1};\n";
    CHECK(compile_text(drawn + "#n = r;\n#w : F;\n").errors() == Reports{"range-not-allowed 2:6"});
    CHECK(compile_text(drawn + "#w : F;\n#p : F : * ~ r : F;\n").errors() ==
          Reports{"range-not-allowed 3:14"});
    CHECK(compile_text(drawn + "#set step r;\n#w : F;\n").errors() ==
          Reports{"range-not-allowed 2:11"});
    CHECK(compile_text(drawn + "#w : F(r);\n#p : F(x) : x < r : F(x + r);\n").errors().empty());
}

TEST_CASE("the bounds of a range may contain ranges") {
    const test::Compiled c =
        compile_text("#w : F({0, {1, 2}});\n"
                     "#p : F(x) : * : F({{-2, -1}, {x, {x, x + 1} + {0, 1}}});\n");
    CHECK(c.errors().empty());
    REQUIRE(c.outcome.bytecode);
    CHECK_FALSE(verify(*c.outcome.bytecode));
}

TEST_CASE("the bounds of a constant range are checked") {
    const test::Compiled c = compile_text("#w : F(1);\n#p : F(x) : * : F({ 2*3, 1 });\n");
    CHECK(c.errors() == Reports{"bad-range-bounds 2:19"});
    CHECK(c.fixed(DiagnosticCode::BadRangeBounds).find("F({ 1, 2*3 })") != std::string::npos);
    CHECK(compile_text("#w : F({-3e38, 3e38});").errors() == Reports{"bad-range-bounds 1:8"});
    const test::Compiled same = compile_text("#w : F;\n#p : F : * : F({2, 2});\n");
    CHECK(same.errors().empty());
    CHECK(same.at(DiagnosticCode::ConstantRange) == "{2, 2}");
    const test::Compiled once = compile_text("#w : F({1, 2}) F({1, 3});");
    CHECK(once.reports() == Reports{"drawn-once 1:8"});
}

TEST_CASE("the cause is reported if a parameter or condition can never be finite") {
    CHECK(compile_text("#w : F(1 + 2 / 0);").errors() == Reports{"not-finite 1:16"});
    CHECK(compile_text("#w : F(2 * 0 ^ -1);").errors() == Reports{"not-finite 1:14"});
    CHECK(compile_text("#w : F((-2) ^ 0.5);").errors() == Reports{"not-finite 1:13"});
    CHECK(compile_text("#w : F(log(0));").errors() == Reports{"not-finite 1:8"});
    // A production that is never applied computes nothing.
    const test::Compiled tried = compile_text("#w : F(1);\n#p : F(x) : x / 0 : F(x);\n");
    CHECK(tried.errors().empty());
    REQUIRE(tried.find(DiagnosticCode::NotFinite) != nullptr);
    CHECK(tried.find(DiagnosticCode::NotFinite)->severity == Severity::Warning);
    const test::Compiled c = compile_text("#define a 1 / 0;\n#w : F(a);\n");
    CHECK(c.reports() == Reports{"division-by-zero 1:15", "not-finite 2:8"});
    CHECK(c.find(DiagnosticCode::NotFinite)->labels.size() == 1);
}

TEST_CASE("intermediate values follow IEEE") {
    CHECK(folded("min(1 / 0, 5)") == 5.0F);
    CHECK(folded("1 / (1 / 0)") == 0.0F);
    const test::Compiled c = compile_text("#w : F(min(1 / 0, 5));");
    CHECK(c.reports() == Reports{"division-by-zero 1:16"});
}

TEST_CASE("long and deep expressions take linear time and little stack") {
    std::string sum = "#w : F(1);\n#p : F(x) : * : F(x";
    for (int i = 0; i < 200'000; ++i) {
        sum += i % 2 == 0 ? "+x" : "-1";
    }
    const test::Compiled chain = compile_text(sum + ");\n");
    CHECK(chain.errors().empty());
    REQUIRE(chain.outcome.bytecode);

    std::string power = "#w : F(1);\n#p : F(x) : * : F(x";
    for (int i = 0; i < 9'000; ++i) {
        power += "^x";
    }
    const test::Compiled tower = compile_text(power + ");\n");
    CHECK(tower.errors().empty());
    REQUIRE(tower.outcome.bytecode); // verification includes the stack depth

    std::string nested = "#w : F(1);\n#p : F(x) : * : F(";
    for (int i = 0; i < 9'000; ++i) {
        nested += "1+2*(";
    }
    nested += "x" + std::string(9'000, ')');
    CHECK(compile_text(nested + ");\n").outcome.bytecode);
}
