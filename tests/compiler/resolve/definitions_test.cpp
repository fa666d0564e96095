// SPDX-License-Identifier: MIT
#include "tests/compiler/compile_text.h"

#include <catch2/catch.hpp>

using namespace lsys;
using test::compile_text;
using Reports = std::vector<std::string>;

TEST_CASE("the number of generations is a whole number in range") {
    const auto generations = [](const std::string& value) {
        const test::Compiled c = compile_text("#n = " + value + ";\n#w : F;\n");
        return c.outcome.program ? c.outcome.program->generations : std::nullopt;
    };
    CHECK(generations("6") == 6U);
    CHECK(generations("2 * 3 + 1") == 7U);
    CHECK(generations("16777217") == 16'777'217U); // not a binary32
    CHECK(generations("4294967294") == 0xFFFFFFFEU);
    CHECK(generations("1e3") == 1000U);
    CHECK(generations("4294967295") == std::nullopt);
    CHECK(generations("99999999999999999999999") == std::nullopt);
    for (const char* wrong : {"3.5", "-1", "1 / 0", "1e30", "0 / 0"}) {
        const test::Compiled c = compile_text("#n = " + std::string(wrong) + ";\n#w : F;\n");
        CAPTURE(wrong);
        CHECK(c.errors() == Reports{"bad-generations 1:6"});
    }
    CHECK(compile_text("#n = 0;\n#w : F;\n").reports() == Reports{"zero-generations 1:6"});
}

TEST_CASE("a missing axiom or number of generations is reported at the end of the text") {
    CompileOptions options;
    const auto without = [](const std::string& text) {
        SourceMap sources;
        Names names;
        Diagnostics diagnostics;
        const FileId root = sources.add("main.lsys", text);
        const FileLoader load = [](const std::string&) -> Result<std::string> {
            return Error{"none"};
        };
        Ast ast = parse_lsys(root, {sources, names, diagnostics, load});
        static_cast<void>(compile(std::move(ast), names, sources, {}, diagnostics));
        Reports codes;
        for (const Diagnostic& d : diagnostics.all()) {
            codes.emplace_back(info(d.code).name);
        }
        return codes;
    };
    CHECK(without("#w : F;\n") == Reports{"missing-generations"});
    CHECK(without("#n = 1;\n#p : F : * : F;\n") == Reports{"missing-axiom"});
    CHECK(without("#n = 1;\n#w : ;\n") == Reports{"empty-axiom"});
    // A statement with a syntax error is not also reported as missing.
    CHECK(without("#n = 1 1;\n#w : F(1 1);\n").size() == 2);
    CHECK(compile_text("#w : F;\n").reports().empty()); // -n is given
}

TEST_CASE("a second definition of the same name or statement is an error") {
    CHECK(compile_text("#n = 1;\n#n = 2;\n#w : F;\n").reports() ==
          Reports{"duplicate-statement 2:1"});
    CHECK(compile_text("#w : F;\n#w : f;\n").reports() == Reports{"duplicate-statement 2:1"});
    CHECK(compile_text("#define a 1;\n#define a 2;\n#w : F(a);\n").reports() ==
          Reports{"duplicate-statement 2:9"});
    CHECK(compile_text("#define a 1;\n#param a 2 {1, 3};\n#w : F(a);\n").reports() ==
          Reports{"duplicate-statement 2:8"});
    CHECK(compile_text("#set step 1;\n#set step 2;\n#w : F;\n").reports() ==
          Reports{"duplicate-statement 2:6"});
    CHECK(compile_text("#w : A;\n#p : A : * : F;\n#p : F : * : F F;\n").reports() ==
          Reports{"duplicate-statement 3:2"});
    CHECK(compile_text("#define a 1;\n#module a;\n#w : a F(a);\n#a : F(x) : * : a;\n")
              .errors()
              .empty()); // constants, modules and labels have separate name spaces
}

TEST_CASE("a definition of the command line replaces the expression") {
    CompileOptions options;
    options.definitions = {{"a", 5.0F}, {"b", 1.0F}, {"b", 2.0F}};
    const test::Compiled c = compile_text("#define a {1, 2};\n"
                                          "#define b 7;\n"
                                          "#define c {1, 2};\n"
                                          "#w : F(a) F(b) F(c) F({3, 4});\n",
                                          options);
    REQUIRE(c.outcome.program);
    const Program& program = *c.outcome.program;
    CHECK(program.constants[0].value == 5.0F);
    CHECK_FALSE(program.constants[0].is_random);
    CHECK(program.constants[1].value == 2.0F);
    // The range of `a`, which the command line replaces, still takes draw 0.
    REQUIRE(program.globals.size() == 1);
    CHECK(program.globals[0].draw_position == 1);
    CHECK(program.axioms.front().draw_position == 2);
    CHECK(c.outcome.unknown_definitions.empty());
}

TEST_CASE("names of -D that the grammar does not define are returned") {
    CompileOptions options;
    options.definitions = {{"a", 5.0F}, {"F", 1.0F}, {"no", 2.0F}};
    const test::Compiled c = compile_text("#define a 1;\n#w : F(a);\n", options);
    CHECK(c.outcome.unknown_definitions == Reports{"F", "no"});
    CHECK(c.reports().empty());
}

TEST_CASE("a parameter must be within its bounds") {
    CHECK(compile_text("#param a 2 {1, 3};\n#w : F(a);\n").reports().empty());
    CHECK(compile_text("#param a 4 {1, 3};\n#w : F(a);\n").reports() ==
          Reports{"bad-parameter-bounds 1:10"});
    CHECK(compile_text("#param a 2 {3, 1};\n#w : F(a);\n").reports() ==
          Reports{"bad-parameter-bounds 1:12"});
    CompileOptions options;
    options.definitions = {{"a", 9.0F}};
    const test::Compiled c = compile_text("#param a 2 {1, 3};\n#w : F(a);\n", options);
    CHECK(c.reports() == Reports{"bad-parameter-bounds 1:8"});
    CHECK(c.message(DiagnosticCode::BadParameterBounds) ==
          "the new value 9 is outside the bounds 1 to 3 of `a`");
    const test::Compiled drawn = compile_text("#param a {0, 9} {1, 3};\n#w : F(a);\n");
    REQUIRE(drawn.outcome.bytecode);
    CHECK(drawn.outcome.bytecode->globals[0].has_bounds);
    CHECK(drawn.outcome.bytecode->globals[0].maximum == 3.0F);
}

TEST_CASE("ranges of definitions and axiom are numbered in the order of the text") {
    const test::Compiled c = test::compile_files({{"main.lsys", "#define a {1, 2} + {3, 4};\n"
                                                                "#include \"other.lsys\";\n"
                                                                "#w : F(b) F({{1, 2}, 5});\n"
                                                                "#define c a + 1;\n"
                                                                "#p : F(x) : * : F(x * a + c);\n"},
                                                  {"other.lsys", "#define b {5, 6};\n"}},
                                                 {});
    REQUIRE(c.outcome.program);
    const std::vector<Global>& globals = c.outcome.program->globals;
    REQUIRE(globals.size() == 3);
    CHECK(globals[0].draw_position == 0);
    CHECK(globals[0].draw_count == 2);
    CHECK(globals[1].draw_position == 2);
    CHECK(c.outcome.program->axioms.front().draw_position == 3);
    CHECK(c.outcome.program->axioms.front().word.draw_count == 2);
    CHECK(globals[2].draw_count == 0);
}

TEST_CASE("settings are read in any order") {
    const test::Compiled c = compile_text("#define a 30;\n"
                                          "#set angle a;\n"
                                          "#set step -2.5;\n"
                                          "#set width_scale (a / 60);\n"
                                          "#set sides 12;\n"
                                          "#set tropism 0 -1 0 0.25;\n"
                                          "#set seed 18446744073709551615;\n"
                                          "#w : A B;\n"
                                          "#p : A B : * ~ 3 : F;\n"
                                          "#set weights any;\n"
                                          "#set rewriting cyclic;\n"
                                          "#set choice generation;\n"
                                          "#set turtle abop;\n");
    CHECK(c.errors().empty());
    REQUIRE(c.outcome.program);
    const Settings& s = c.outcome.program->settings;
    CHECK(s.angle == 30.0F);
    CHECK(s.step == -2.5F);
    CHECK(s.width_scale == 0.5F);
    CHECK(s.sides == 12);
    CHECK(s.has_tropism);
    CHECK(s.tropism == std::array<float, 4>{0.0F, -1.0F, 0.0F, 0.25F});
    CHECK(s.seed == 0xFFFFFFFFFFFFFFFF);
    CHECK(s.weights == WeightRule::Any);
    CHECK(s.rewriting == RewritingMode::Cyclic);
    CHECK(s.choice == ChoiceScope::Generation);
    CHECK(s.turtle == TurtleProfile::Abop);
}

TEST_CASE("messages about unknown keys and values name the most similar one") {
    const auto help = [](const std::string& text, DiagnosticCode code) {
        const test::Compiled c = compile_text(text + "\n#w : F;\n");
        const Diagnostic* found = c.find(code);
        REQUIRE(found != nullptr);
        return found->help.empty() ? "" : found->help[0];
    };
    CHECK(help("#set agnle 3;", DiagnosticCode::UnknownKey) == "did you mean `angle`?");
    CHECK(help("#set rewriting sequentiel;", DiagnosticCode::BadSetting) ==
          "did you mean `sequential`?");
    CHECK(help("#set turtle 3;", DiagnosticCode::BadSetting).empty());
    const auto errors = [](const std::string& text) {
        return compile_text(text + "\n#w : F;\n").errors();
    };
    CHECK(errors("#set sides 2;") == Reports{"bad-setting 1:12"});
    CHECK(errors("#set sides 3.5;") == Reports{"bad-setting 1:12"});
    CHECK(errors("#set angle;") == Reports{"bad-setting 1:6"});
    CHECK(errors("#set angle 1 2;") == Reports{"bad-setting 1:6"});
    CHECK(errors("#set tropism 1 2 3;") == Reports{"bad-setting 1:6"});
    CHECK(errors("#set seed -1;") == Reports{"bad-setting 1:11"});
    CHECK(errors("#set seed 1.5;") == Reports{"bad-setting 1:11"});
    CHECK(errors("#set width -1;") == Reports{"bad-setting 1:12"});
    CHECK(errors("#set step big;") == Reports{"unknown-name 1:11"});
}
