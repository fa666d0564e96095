// SPDX-License-Identifier: MIT
#include "tests/compiler/compile_text.h"

#include <catch2/catch.hpp>

using namespace lsys;
using test::compile_text;
using Reports = std::vector<std::string>;

namespace {

/// The names of the axiom's modules, with their numbers of parameters.
std::string axiom(const test::Compiled& c) {
    if (!c.outcome.program) {
        return "no program";
    }
    std::string text;
    const Program& program = *c.outcome.program;
    for (std::uint32_t i = 0; i < program.axioms.front().word.module_count; ++i) {
        const Symbol& symbol =
            program.symbol(program.modules[program.axioms.front().word.first_module + i].symbol);
        text += (i == 0 ? "" : " ") + std::string(c.names.text(symbol.name));
        if (symbol.parameter_count != 0) {
            text += "/" + std::to_string(symbol.parameter_count);
        }
    }
    return text;
}

} // namespace

TEST_CASE("a module is known by name and number of parameters") {
    const test::Compiled c = compile_text("#w : F F(1) F(1, 2) F() `F` `F`(3);");
    CHECK(axiom(c) == "F F/1 F/2 F F F/1");
    CHECK(c.outcome.program->symbols.size() == 3);
}

TEST_CASE("an unknown name that consists of known names is split") {
    const std::string known = "#module B;\n#p : A : * : F;\n";
    const test::Compiled c = compile_text("#w : ABA(1) FFA;\n" + known);
    CHECK(axiom(c) == "A B A/1 F F A");
    CHECK(c.errors().empty());
    CHECK(c.at(DiagnosticCode::SplitName) == "ABA");
    CHECK(c.message(DiagnosticCode::SplitName) == "`ABA` is read as `A B A(1)`");
    CHECK(c.find(DiagnosticCode::SplitName)->labels.size() == 1); // one warning per statement
    CHECK(c.fixed(DiagnosticCode::SplitName).starts_with("#w : A B A(1) F F A;"));
}

TEST_CASE("Crankshaw 2019, 7.3: the last part may be a name that is used alone elsewhere") {
    const std::string rest = "#p : A : * : F S(1);\n";
    CHECK(axiom(compile_text("#w : AS(1);\n" + rest)) == "A S/1");
    CHECK(axiom(compile_text("#w : AS;\n" + rest)) == "AS"); // elsewhere, S has a parameter
    // Only the last part may have parameters.
    CHECK(axiom(compile_text("#w : SA(1);\n" + rest)) == "SA/1");
    CHECK(axiom(test::compile_files(
              {{"main.lsys", "#w : AS(1);\n#include \"b.lsys\";\n"}, {"b.lsys", rest}}, {})) ==
          "AS/1"); // S(1) must stand alone in the same file
}

TEST_CASE("a name that is known, quoted or can be split in two ways is not split") {
    CHECK(axiom(compile_text("#w : AB;\n#p : A : * : F;\n#q : B : * : F;\n#module AB;\n")) == "AB");
    CHECK(axiom(compile_text("#w : `AB`;\n#p : A : * : F;\n#q : B : * : F;\n")) == "AB");
    CHECK(axiom(compile_text("#w : ABC;\n#module A; #module AB; #module BC; #module C;\n")) ==
          "ABC");
    CHECK(axiom(compile_text("#w : A1B A_B;\n#module A; #module B; #module A1;\n")) == "A1 B A_B");
}

TEST_CASE("predecessors are never split, contexts and #ignore are") {
    const test::Compiled c = compile_text("#module B;\n"
                                          "#ignore : Bf;\n"
                                          "#w : A;\n"
                                          "#p : FA < A > AF(x) : x > 1 : F(x);\n"
                                          "#q : AB : * : F;\n");
    CHECK(c.errors().empty());
    REQUIRE(c.outcome.program);
    const Program& program = *c.outcome.program;
    CHECK(program.productions[0].left.items.size() == 2);
    REQUIRE(program.productions[0].right.items.size() == 2);
    CHECK(program.productions[0].right.items[1].first_formal == 0);
    CHECK(program.productions[1].predecessor.items.size() == 1);
    REQUIRE(program.ignored.size() == 2);
    CHECK(c.names.text(program.ignored[1].name) == "f");
}

TEST_CASE("commands of the turtle's profile are known") {
    const std::string text = "#w : AJF;\n#p : A : * : F;\n";
    CHECK(axiom(compile_text(text)) == "AJF");
    CHECK(axiom(compile_text("#set turtle houdini;\n" + text)) == "A J F");
}

TEST_CASE("with `names letters` every letter is a module, in that file") {
    const test::Compiled c =
        test::compile_files({{"main.lsys", "#set names letters;\n"
                                           "#include \"words.lsys\";\n"
                                           "#w : F[+FX]Xab(2);\n"
                                           "#grow : X : * : FX;\n"},
                             {"words.lsys", "#leaf : stem : * : stem stem;\n"}},
                            {});
    CHECK(c.errors().empty());
    CHECK(axiom(c) == "F [ + F X ] X a b/1");
    CHECK(c.outcome.program->settings.print_letters);
    CHECK(c.find(DiagnosticCode::SplitName) == nullptr);
}

TEST_CASE("modules get their meaning from the profile and from #object") {
    const auto operation = [](const std::string& set, const std::string& module) {
        const test::Compiled c = compile_text(set + "#w : " + module + ";\n");
        CAPTURE(set, module, c.reports());
        REQUIRE(c.outcome.program);
        const Program& program = *c.outcome.program;
        return program.symbol(program.modules[program.axioms.front().word.first_module].symbol)
            .turtle;
    };
    using enum TurtleOperation;
    CHECK(operation("", "+(1)") == YawRight);
    CHECK(operation("", "\\") == RollLeft);
    CHECK(operation("", "&") == PitchDown);
    CHECK(operation("", "A") == Nothing);
    CHECK(operation("#set turtle thesis;", "/(3)") == PitchUp);
    CHECK(operation("#set turtle thesis;", "^") == RollRight);
    CHECK(operation("#set turtle abop;", "+") == YawLeft);
    CHECK(operation("#set turtle houdini;", "&") == PitchUp);
    CHECK(operation("#set turtle houdini;", "`;`(0.9)") == ScaleAngle);
    CHECK(operation("#set turtle houdini;", "!(0.9)") == ScaleWidth);
    CHECK(operation("#set turtle l3d;", "f") == Forward);
    CHECK(operation("#set turtle lplus;", "`*`(2)") == Leaf);
    CHECK(operation("#set turtle sys;", "F(1, 2, 3)") == TaperedForward);
    CHECK(operation("#object F SPHERE;", "F(2)") == Sphere);
    CHECK(operation("#include A BRANCH;", "A(2, 3)") == Branch);
    CHECK(operation("#object A \"leaf.obj\";", "A") == MeshFile);
}

TEST_CASE("a picture bound to `{` is drawn on its polygons") {
    const test::Compiled c = compile_text("#object { \"a leaf.PNG\";\n#w : { . . . };\n");
    CAPTURE(c.reports());
    REQUIRE(c.outcome.program);
    const Program& program = *c.outcome.program;
    const auto& symbol =
        program.symbol(program.modules[program.axioms.front().word.first_module].symbol);
    CHECK(symbol.turtle == TurtleOperation::PolygonBegin);
    CHECK(symbol.mesh_file == "a leaf.PNG");
    for (const char* const other :
         {"{ \"leaf.obj\"", "} \"leaf.png\"", "[ \"leaf.png\"", ". \"leaf.png\""}) {
        CAPTURE(other);
        CHECK(compile_text(std::string("#object ") + other + ";\n#w : F;\n").errors() ==
              Reports{"bad-declaration 1:9"});
    }
}

TEST_CASE("invalid declarations are reported at their place") {
    const auto errors = [](const std::string& text) {
        return compile_text(text + "\n#w : F;\n").errors();
    };
    CHECK(errors("#object F BRACNH;") == Reports{"unknown-object 1:11"});
    CHECK(errors("#object [ SPHERE;") == Reports{"bad-declaration 1:9"});
    CHECK(errors("#object A(x) SPHERE;") == Reports{"bad-declaration 1:10"});
    CHECK(errors("#object A SPHERE;\n#object A CUBE;") == Reports{"duplicate-statement 2:9"});
    CHECK(errors("#object A CUBE;\n#object A CUBE;").empty());
    CHECK(errors("#module A B;") == Reports{"bad-declaration 1:9"});
    CHECK(errors("#module A(x, x);") == Reports{"duplicate-parameter 1:14"});
    CHECK(errors("#module A(2);") == Reports{"expression-in-head 1:11"});
    CHECK(errors("#module A(x);").empty());
    CHECK(errors("#ignore : F [;") == Reports{"bad-declaration 1:13"});
    CHECK(errors("#ignore : F(x);") == Reports{"bad-declaration 1:12"});
    const test::Compiled c = compile_text("#object F BRACNH;\n#w : F;\n");
    CHECK(c.find(DiagnosticCode::UnknownObject)->help == Reports{"did you mean `BRANCH`?"});
}

TEST_CASE("parameters of modules that take none are an error") {
    CHECK(compile_text("#w : F [(1) ];").errors() == Reports{"unexpected-parameters 1:9"});
    CHECK(compile_text("#w : F |(180);").errors() == Reports{"unexpected-parameters 1:9"});
    CHECK(compile_text("#w : F |();").errors().empty());
}

TEST_CASE("parameters that a turtle command does not read are reported") {
    const test::Compiled c = compile_text("#w : +(1, 2, 3) +(3, 4, 5) F(1, 2, 3);");
    CHECK(c.at(DiagnosticCode::ExtraParameters) == "2, 3");
    CHECK(c.reports() == Reports{"extra-parameters 1:11"});
    CHECK(compile_text("#w : F(1, 2, 3, 4);\n#p : F(a, b, c, d) : a < b : F(b, a, d, c);\n")
              .find(DiagnosticCode::ExtraParameters) == nullptr);
}

TEST_CASE("a polygon that rewriting may put into another is only a warning") {
    const test::Compiled c =
        compile_text("#set turtle carey;\n#w : A;\n#p : A : * : { F A F F };\n");
    CHECK(c.reports() == Reports{"nested-polygon 3:14"});
    CHECK(c.errors().empty());
    CHECK_FALSE(c.diagnostics.has_errors());
    CHECK(c.outcome.bytecode);
}
