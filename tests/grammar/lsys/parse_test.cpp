// SPDX-License-Identifier: MIT
// Syntax trees of grammars without errors.
#include "tests/grammar/lsys/parsed.h"

#include <catch2/catch.hpp>

#include <map>
#include <string>

namespace {

using namespace lsys;

/// The names of a module list; modules with parentheses have their number of arguments: "F/1 [".
std::string modules_of(const Parsed& parsed, ModuleList list) {
    std::string out;
    for (ModuleCursor cursor(parsed.ast, parsed.names, parsed.sources, list); !cursor.done();
         cursor.next()) {
        const ModuleView view = cursor.view();
        out += out.empty() ? "" : " ";
        out += parsed.names.text(view.name);
        if (view.has_parentheses) {
            out += "/" + std::to_string(view.arguments.count);
        }
    }
    return out;
}

/// The name and the whole text of each module of a list, between bars: "|A|A(2)|".
std::string texts_of(const Parsed& parsed, ModuleList list) {
    std::string out;
    for (ModuleCursor cursor(parsed.ast, parsed.names, parsed.sources, list); !cursor.done();
         cursor.next()) {
        const ModuleView view = cursor.view();
        out += "|" + std::string(parsed.sources.text(view.name_span)) + "|" +
               std::string(parsed.sources.text(view.span)) + "|";
    }
    return out;
}

/// An expression with all its parentheses.
std::string text_of(const Parsed& parsed, ExpressionId id) {
    const Expression& node = parsed.ast.expression(id);
    switch (node.kind) {
    case ExpressionKind::Number: {
        std::string text = std::to_string(node.value);
        text.erase(text.find_last_not_of('0') + 1);
        return text.ends_with('.') ? text.substr(0, text.size() - 1) : text;
    }
    case ExpressionKind::Name:
        return std::string(parsed.names.text(node.name));
    case ExpressionKind::Unary:
        return std::string("(") + spelling(node.unary()) + text_of(parsed, node.left) + ")";
    case ExpressionKind::Binary:
        return "(" + text_of(parsed, node.left) + spelling(node.binary()) +
               text_of(parsed, node.right) + ")";
    case ExpressionKind::Range:
        return "{" + text_of(parsed, node.left) + "," + text_of(parsed, node.right) + "}";
    case ExpressionKind::Grouping:
        return "[" + text_of(parsed, node.left) + "]";
    case ExpressionKind::Call: {
        std::string out = std::string(parsed.names.text(node.name)) + "(";
        const ListRange list = parsed.ast.argument_lists[node.arguments];
        for (std::uint32_t i = 0; i < list.count; ++i) {
            out += i == 0 ? "" : ",";
            out += text_of(parsed, parsed.ast.expression_lists[list.first + i]);
        }
        return out + ")";
    }
    case ExpressionKind::Error:
        return "?";
    }
    return "";
}

std::string expression(const std::string& text) {
    Parsed parsed("#define a " + text + ";");
    CHECK(parsed.codes().empty());
    REQUIRE(parsed.ast.defines.size() == 1);
    return text_of(parsed, parsed.ast.defines[0].value);
}

std::string axiom(const std::string& text) {
    Parsed parsed("#w : " + text + ";");
    INFO(text);
    CHECK(parsed.codes().empty());
    REQUIRE(parsed.ast.axioms.size() == 1);
    return modules_of(parsed, parsed.ast.axioms[0].modules);
}

} // namespace

TEST_CASE("every kind of statement is parsed, in order") {
    Parsed parsed("#n = 6;\n"
                  "#define a 2; #param b 3 {0, 2 * a};\n"
                  "#module X(p, q);\n"
                  "#object F BRANCH;\n"
                  "#include L \"leaf.obj\";\n"
                  "#set tropism 0 -1 (2 / a) a;\n"
                  "#ignore : + - F;\n"
                  "#w : F;\n"
                  "#p : F < A(x) > B [C] : x > 2 ~ 0.5 : F A(x);\n");
    CHECK(parsed.codes().empty());
    CHECK_FALSE(parsed.ast.incomplete);
    const StatementKind kinds[] = {StatementKind::Generations, StatementKind::Define,
                                   StatementKind::Param,       StatementKind::Module,
                                   StatementKind::Object,      StatementKind::Object,
                                   StatementKind::Set,         StatementKind::Ignore,
                                   StatementKind::Axiom,       StatementKind::Production};
    REQUIRE(parsed.ast.statements.size() == std::size(kinds));
    for (std::size_t i = 0; i < std::size(kinds); ++i) {
        CHECK(parsed.ast.statements[i].kind == kinds[i]);
    }
    CHECK(parsed.sources.text(parsed.ast.statements[1].span) == "#define a 2;");
    CHECK(parsed.sources.text(parsed.ast.params[0].bounds_span) == "{0, 2 * a}");
    CHECK(text_of(parsed, parsed.ast.params[0].maximum) == "(2*a)");
    CHECK(parsed.ast.objects[0].object == "BRANCH");
    CHECK(parsed.ast.objects[1].is_file);
    CHECK(parsed.ast.objects[1].object == "leaf.obj");
    CHECK(modules_of(parsed, parsed.ast.objects[1].name) == "L");
    CHECK(parsed.sources.text(parsed.ast.objects[1].keyword_span) == "#include");
    CHECK(parsed.ast.sets[0].values.count == 4);
    CHECK(text_of(parsed, parsed.ast.set_values[1].value) == "(-1)");
    CHECK(parsed.ast.set_values[3].is_word);
    CHECK(modules_of(parsed, parsed.ast.ignores[0].modules) == "+ - F");

    const ProductionNode& production = parsed.ast.productions[0];
    CHECK(parsed.sources.text(production.name_span) == "p");
    CHECK(production.has_left);
    CHECK(production.has_right);
    CHECK(parsed.sources.text(production.less_span) == "<");
    CHECK(modules_of(parsed, production.left) == "F");
    CHECK(modules_of(parsed, production.predecessor) == "A/1");
    CHECK(modules_of(parsed, production.right) == "B [ C ]");
    CHECK(text_of(parsed, production.condition.condition) == "(x>2)");
    CHECK(text_of(parsed, production.condition.probability) == "0.5");
    CHECK(parsed.sources.text(production.condition.span) == "x > 2 ~ 0.5");
    CHECK(modules_of(parsed, production.successor) == "F A/1");
    CHECK(parsed.sources.text(production.successor.span) == "F A(x)");
}

TEST_CASE("keywords before a colon name productions") {
    Parsed parsed("#define : A : * : B; #n : A : ~ 1 : ; #set:A:* ~ .5:B C;#include : A : 1 : B;"
                  "#module : A : * : B; #object /**/ : A : * : B; #param : A : * : B;");
    CHECK(parsed.codes().empty());
    REQUIRE(parsed.ast.productions.size() == 7);
    CHECK(parsed.names.text(parsed.ast.productions[0].name) == "define");
    CHECK(parsed.names.text(parsed.ast.productions[1].name) == "n");
    CHECK(parsed.sources.text(parsed.ast.productions[2].name_span) == "set");
    CHECK(parsed.ast.productions[1].successor.count == 0);
    CHECK(parsed.ast.productions[1].condition.condition == kNoExpression);
    CHECK(text_of(parsed, parsed.ast.productions[2].condition.probability) == "0.5");
}

TEST_CASE("module lists") {
    CHECK(axiom("F") == "F");
    CHECK(axiom("F+F-F") == "F + F - F");
    CHECK(axiom("AB A B _x1[&(2)]^") == "AB A B _x1 [ &/1 ] ^");
    CHECK(axiom("F (1) G(1 , -2.5e1)H()") == "F/1 G/2 H/0");
    CHECK(axiom("+ - / \\ ^ & | $ ! \" ' . [ ] { }") == "+ - / \\ ^ & | $ ! \" ' . [ ] { }");
    CHECK(axiom("`;`(0.9) `F` `abc` F") == ";/1 F abc F");
    CHECK(axiom("F/*+*/G /* a * b **/ (1) //* x */A///") == "F G/1 / A / / /");
    CHECK(axiom("F(x, 2*y)A(sin(3), {1,2}) B ( (1) )") == "F/2 A/2 B/1");
    CHECK(axiom("F\r\n\t+\n F(\n1\n)") == "F + F/1");
}

TEST_CASE("modules have their places") {
    Parsed parsed("#w :  F (1) `;`(x+1)AB[ +(2.5 , 3 )\n];");
    CHECK(parsed.codes().empty());
    CHECK(texts_of(parsed, parsed.ast.axioms[0].modules) ==
          "|F|F (1)||`;`|`;`(x+1)||AB|AB||[|[||+|+(2.5 , 3 )||]|]|");
    CHECK(parsed.sources.text(parsed.ast.axioms[0].modules.span) ==
          "F (1) `;`(x+1)AB[ +(2.5 , 3 )\n]");
}

TEST_CASE("operators have the precedence of the language reference") {
    CHECK(expression("1 + 2 * 3") == "(1+(2*3))");
    CHECK(expression("1 - 2 - 3") == "((1-2)-3)");
    CHECK(expression("2 ^ 3 ^ 4") == "(2^(3^4))");
    CHECK(expression("-2 ^ 2") == "(-(2^2))");
    CHECK(expression("2 ^ -1 * 3") == "((2^(-1))*3)");
    CHECK(expression("2 ^ -1 ^ 2") == "(2^(-(1^2)))");
    CHECK(expression("!a == b") == "((!a)==b)");
    CHECK(expression("a < b == c") == "((a<b)==c)");
    CHECK(expression("a || b && c != d <= e + f") == "(a||(b&&(c!=(d<=(e+f)))))");
    CHECK(expression("(1 + 2) * 3") == "([(1+2)]*3)");
    CHECK(expression("max(1, {2, 3}) / step()") == "(max(1,{2,3})/step())");
    CHECK(expression("- - ! 1") == "(-(-(!1)))");
    CHECK(expression("1.+.5+1e-3+ 1E+2") == "(((1+0.5)+0.001)+100)");
}

TEST_CASE("literals are rounded once to binary32") {
    Parsed parsed("#define a 16777217; #define b 0.1; #define c 3.4028235e38; #define d 1e-38;"
                  "#define e 0e-99; #define f 1.17549435e-38;");
    CHECK(parsed.codes() == "1:70 number-underflow");
    CHECK(parsed.ast.expression(parsed.ast.defines[0].value).value == 16777216.0F);
    CHECK(parsed.ast.expression(parsed.ast.defines[1].value).value == 0.1F);
    CHECK(parsed.ast.expression(parsed.ast.defines[2].value).value == 3.4028235e38F);
    CHECK(parsed.ast.expression(parsed.ast.defines[3].value).value == 1e-38F);
    CHECK(parsed.ast.expression(parsed.ast.defines[4].value).value == 0.0F);
}

TEST_CASE("with names letters every letter is a module, wherever the setting stands") {
    Parsed parsed("#w : FFFA(2)+AB `AB`;\n/* #set names words; */\n#set names letters;\n"
                  "#module XY;\n#define AB 2;\n#AB : F : * : F;");
    CHECK(parsed.codes().empty());
    CHECK(modules_of(parsed, parsed.ast.axioms[0].modules) == "F F F A/1 + A B AB");
    CHECK(modules_of(parsed, parsed.ast.module_declarations[0].modules) == "X Y");
    CHECK(parsed.names.text(parsed.ast.defines[0].name) == "AB");
    CHECK(parsed.names.text(parsed.ast.productions[0].name) == "AB");
    CHECK(texts_of(parsed, parsed.ast.axioms[0].modules) ==
          "|F|F||F|F||F|F||A|A(2)||+|+||A|A||B|B||`AB`|`AB`|");

    Parsed comment("#w : AB; // #set names letters;\n");
    CHECK(modules_of(comment, comment.ast.axioms[0].modules) == "AB");
    Parsed digits("#set names letters; #w : F1 A_B;");
    CHECK(digits.codes() == "1:27 letter-name, 1:30 letter-name");
}

TEST_CASE("a statement after an include has no nodes of the included file") {
    const std::map<std::string, std::string> files{
        {"a.lsys", "#set angle 20; #p : A : * : B(1) C(2);"}};
    Parsed after("#include \"a.lsys\"; #set choice generation;", files);
    CHECK(after.codes().empty());
    REQUIRE(after.ast.sets.size() == 2);
    CHECK(after.ast.sets[1].values.count == 1);
    // The rollback of a broken statement removes only its own nodes.
    Parsed broken("#include \"a.lsys\"; #w : F : ~ ;", files);
    CHECK(broken.ast.productions.size() == 1);
    REQUIRE(broken.ast.modules.size() >= 3);
    CHECK(broken.ast.calls.size() >= 2);
}

TEST_CASE("`names letters` does not affect included files") {
    Parsed parsed("#n = 1;\n#include \"sub/a.lsys\";\n#w : AB;\n",
                  {{"sub/a.lsys", "#set names letters; #p : AB : * : CD;\n#include \"b.lsys\";"},
                   {"sub/b.lsys", "#module EF;"}});
    CHECK(parsed.codes().empty());
    REQUIRE(parsed.ast.statements.size() == 7);
    CHECK(parsed.ast.statements[1].kind == StatementKind::Include);
    CHECK(parsed.ast.statements[3].kind == StatementKind::Production);
    CHECK(parsed.ast.statements[5].kind == StatementKind::Module);
    CHECK(modules_of(parsed, parsed.ast.productions[0].successor) == "C D");
    CHECK(modules_of(parsed, parsed.ast.module_declarations[0].modules) == "EF");
    CHECK(modules_of(parsed, parsed.ast.axioms[0].modules) == "AB");
    REQUIRE(parsed.ast.files.size() == 3);
    CHECK(parsed.sources.file(parsed.ast.files[2].file).path() == "sub/b.lsys");
    CHECK(parsed.sources.text(parsed.ast.files[2].included_at) == "\"b.lsys\"");
    CHECK(parsed.ast.includes[1].file == parsed.ast.files[2].file);
}

TEST_CASE("files that cannot be included") {
    Parsed missing("#include \"none.lsys\";\n#w : F;");
    CHECK(missing.codes() == "1:10 include-not-found");
    CHECK(missing.ast.incomplete);
    CHECK(missing.ast.axioms.size() == 1);

    Parsed cycle("#include \"x/../a.lsys\";", {{"x/../a.lsys", "#include \"./main.lsys\";"}});
    CHECK(cycle.codes() == "1:10 include-cycle");
    CHECK(cycle.diagnostics.all()[0].span.file == FileId{1});

    std::map<std::string, std::string> files;
    for (int i = 1; i <= 33; ++i) {
        files["f" + std::to_string(i)] = "#include \"f" + std::to_string(i + 1) + "\";";
    }
    Parsed deep("#include \"f1\";", files);
    CHECK(deep.codes() == "1:10 include-too-deep");
    CHECK(deep.ast.files.size() == 33);
    CHECK(deep.diagnostics.all()[0].span.file == FileId{32});

    std::map<std::string, std::string> doubled;
    for (int i = 1; i <= 32; ++i) {
        const std::string next = "f" + std::to_string(i + 1);
        doubled["f" + std::to_string(i)] =
            i == 32 ? "#n = 1;" : "#include \"" + next + "\"; #include \"" + next + "\";";
    }
    Parsed bomb("#include \"f1\";", doubled);
    CHECK(bomb.diagnostics.has_errors());
    CHECK(bomb.ast.files.size() == 65'537);
}

TEST_CASE("comments are allowed between any two tokens") {
    Parsed parsed("// one\n/* two */#n/**/=/**/6/**/;// three\n#w/**/:/**/F/**/(/**/1/**/)/**/;"
                  "//\n#p:A:*:B;//");
    CHECK(parsed.codes().empty());
    CHECK(parsed.ast.statements.size() == 3);
}

TEST_CASE("the kind of line end and a byte order mark make no difference") {
    Parsed parsed("\xEF\xBB\xBF#n = 6;\r\n#w : F\r\nG;\r\n// end\r\n");
    CHECK(parsed.codes().empty());
    CHECK(modules_of(parsed, parsed.ast.axioms[0].modules) == "F G");
}
