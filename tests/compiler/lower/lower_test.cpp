// SPDX-License-Identifier: MIT
#include "compiler/bytecode/disassemble.h"
#include "compiler/bytecode/instructions.h"
#include "compiler/bytecode/module_file.h"
#include "compiler/bytecode/verify.h"
#include "tests/compiler/compile_text.h"

#include <catch2/catch.hpp>

using namespace lsys;
using test::compile_text;

namespace {

Bytecode lowered(const std::string& text) {
    test::Compiled c = compile_text(text);
    CAPTURE(text, c.reports());
    REQUIRE(c.outcome.bytecode);
    CHECK(verify(*c.outcome.bytecode) == std::nullopt);
    return *std::move(c.outcome.bytecode);
}

std::vector<Code> codes_of(const Bytecode& b, const WordTemplate& word) {
    const auto first = b.template_codes.begin() + word.codes.first;
    return {first, first + word.codes.count};
}

std::vector<Opcode> code_at(const Bytecode& b, std::uint32_t first) {
    std::vector<Opcode> opcodes;
    for (const Instruction each : InstructionRange(b.instructions, first)) {
        opcodes.push_back(each.opcode);
    }
    return opcodes;
}

} // namespace

TEST_CASE("modules with constant arguments become codes of their own without stored parameters") {
    const Bytecode b = lowered("#w : F(1) +(22.5) F(1) F(2);\n"
                               "#p : F(x) : * : F(x) F(1) +(22.5) +(x);\n");
    REQUIRE(b.symbols.size() == 2);
    CHECK(b.folded.size() == 3); // F(1) +(22.5) F(2)
    CHECK(codes_of(b, b.axioms.front().word) == std::vector<Code>{2, 3, 2, 4});
    CHECK(b.axioms.front().word.arguments == kNone);
    const WordTemplate& successor = b.productions[0].successor;
    CHECK(codes_of(b, successor) == std::vector<Code>{0, 2, 3, 1});
    CHECK(successor.parameter_count == 2);
}

TEST_CASE("folding stops where a wider code would be needed") {
    std::string text = "#w :";
    for (int i = 0; i < 300; ++i) {
        text += " F(" + std::to_string(i) + ")";
    }
    const Bytecode b = lowered(text + " F(7);\n");
    CHECK(b.code_count() == 256);
    CHECK(b.axioms.front().word.parameter_count == 300 - 255);
    // F(7) was folded before the codes of one byte ran out.
    CHECK(codes_of(b, b.axioms.front().word).back() == 8);
}

TEST_CASE("negative zero and zero are different constants") {
    const Bytecode b = lowered("#w : F(0) F(-0) F(0);");
    CHECK(b.folded.size() == 2);
}

TEST_CASE("code is emitted from left to right") {
    const Bytecode b = lowered("#w : F(1);\n#p : F(x) : x - 1 < 2 : F(x / (x - 3));\n");
    using enum Opcode;
    CHECK(code_at(b, b.productions[0].condition) ==
          std::vector<Opcode>{Formal, Literal, Subtract, Literal, Less, Test, End});
    CHECK(code_at(b, b.productions[0].successor.arguments) ==
          std::vector<Opcode>{Formal, Formal, Literal, Subtract, Divide, Emit, End});
}

TEST_CASE("a deep right operand is computed first and exchanged") {
    std::string text = "#w : F(1);\n#p : F(x) : * : F(";
    for (int i = 0; i < 1'000; ++i) {
        text += "x-(";
    }
    const Bytecode b = lowered(text + "2" + std::string(1'000, ')') + ");\n");
    std::size_t swaps = 0;
    for (const Opcode opcode : code_at(b, b.productions[0].successor.arguments)) {
        swaps += opcode == Opcode::Swap ? 1 : 0;
    }
    CHECK(swaps > 900);
}

TEST_CASE("every value that can fail has its place") {
    const Bytecode b = lowered("#define g {1, 2};\n"
                               "#w : F(g);\n"
                               "#p : F(x) : x > 1 : F(1) F(x * 2) F({0, x} + 1);\n");
    const auto place = [&](std::uint32_t instruction) {
        const Site& site = b.sites[site_of(b, instruction)];
        return std::to_string(site.line) + ":" + std::to_string(site.column);
    };
    const BytecodeProduction& p = b.productions[0];
    CHECK(place(p.condition) == "3:13");
    std::vector<std::string> emits;
    std::string range;
    for (const Instruction each : InstructionRange(b.instructions, p.successor.arguments)) {
        if (each.opcode == Opcode::Emit) {
            emits.push_back(place(each.at));
        } else if (each.opcode == Opcode::Range) {
            range = place(each.at);
        }
    }
    CHECK(emits == std::vector<std::string>{"3:28", "3:37"});
    CHECK(range == "3:37");
    CHECK(b.sites[b.axioms.front().site].line == 2);
    CHECK(b.sites[b.globals[0].site].line == 1);
    CHECK(b.sites[p.name_site].column == 2);
}

TEST_CASE("a program read from a file is the same, and its dumps are complete") {
    const test::Compiled c = compile_text("#set tropism 0 -1 0 0.2;\n"
                                          "#set rewriting sequential;\n"
                                          "#define g {1, 2};\n"
                                          "#param q 0.5 {0, 1};\n"
                                          "#ignore : +;\n"
                                          "#object L \"leaf.obj\";\n"
                                          "#module Z(a, b);\n"
                                          "#w : A(g) B(q) L `;`(1);\n"
                                          "#p : A(x) B(y) > [ L ] : x < y ~ 1 : A(y) B({x, 9}) L;\n"
                                          "#q : L < B(y) : step() < steps() : ;\n");
    REQUIRE(c.outcome.bytecode);
    const std::string bytes = write_module_file(*c.outcome.bytecode);
    const Result<Bytecode> read = read_module_file(bytes);
    REQUIRE(read.ok());
    CHECK(write_module_file(read.value()) == bytes);
    CHECK(digest(read.value()) == digest(*c.outcome.bytecode));
    CHECK(disassemble(read.value()).find("global 0 g") != std::string::npos);
    const std::string dump = c.dump();
    for (const char* part :
         {"rewriting sequential", "tropism 0 -1 0 0.2", "productions: 2 rules, 2 groups"}) {
        CAPTURE(dump, part);
        CHECK(dump.find(part) != std::string::npos);
    }
}

TEST_CASE("a successor has no draws if a constant condition leaves them out") {
    const Bytecode b = lowered("#define wild 0;\n"
                               "#w : B;\n"
                               "#p : B : * : +(if(wild, {10, 30}, 20)) F;\n");
    CHECK(b.productions[0].successor.draw_count == 0);
    CHECK(read_module_file(write_module_file(b)).ok());
}

TEST_CASE("brackets of a predecessor stand between the formals of its modules") {
    const Bytecode b = lowered("#set rewriting leftmost; #set names letters;\n"
                               "#w : A(1)B[C(2)]D(3);\n"
                               "#p : A(x)B[C(y)]D(z) : x < z : A(x + y)[B]D(z);\n");
    CHECK(b.productions[0].formal_count == 3);
    CHECK(read_module_file(write_module_file(b)).ok());
}

TEST_CASE("compiling twice gives the same bytes") {
    const char* text = "#w : A(1) B;\n#p : A(x) : * : B A(x + 0.5) +(30) B;\n#q : B : * : F;\n";
    CHECK(write_module_file(lowered(text)) == write_module_file(lowered(text)));
}

TEST_CASE("nothing is lowered if there are errors or if lowering is not requested") {
    const test::Compiled wrong = compile_text("#w : F(x);");
    CHECK_FALSE(wrong.outcome.program);
    CHECK_FALSE(wrong.outcome.bytecode);
    CompileOptions options;
    options.lower = false;
    const test::Compiled c = compile_text("#w : F;", options);
    CHECK(c.outcome.program);
    CHECK_FALSE(c.outcome.bytecode);
}

namespace {

/// A line for each module of axiom and successors: the production ("-" for the axiom), the place
/// that the bytecode gives, and the text at this place: "p 3:7 F(x)".
std::vector<std::string> placed(const test::Compiled& c) {
    REQUIRE(c.outcome.bytecode);
    const Bytecode& b = *c.outcome.bytecode;
    std::vector<std::string> all;
    for (std::uint32_t i = 0; i < b.template_codes.size(); ++i) {
        const ProductionId writer = production_with(b, i);
        const std::optional<Site> place = place_of(b, i);
        REQUIRE(place);
        const SourceFile& file = c.sources.file(place->span.file);
        CHECK(b.files[static_cast<std::size_t>(place->span.file)] == file.path());
        const LineColumn at = file.line_column(place->span.begin);
        CHECK(at.line == place->line);
        CHECK(at.column == place->column);
        all.push_back((writer == kNoProduction
                           ? std::string("-")
                           : b.productions[static_cast<std::size_t>(writer)].name) +
                      " " + std::to_string(place->line) + ":" + std::to_string(place->column) +
                      " " + std::string(c.sources.text(place->span)));
    }
    return all;
}

using Places = std::vector<std::string>;

} // namespace

TEST_CASE("every module of axiom and successors has its place") {
    CHECK(placed(compile_text("#w : A(1) /* ) */ F\n  F [ `é` ] F;\n"
                              "#e : F : * : ;\n"
                              "#p : A(x) : x > 1 : F A (x /*)*/ + {1, 2}) F();\n"
                              "#q : A(x) : x < 1 : ;\n")) ==
          Places{"- 1:6 A(1)", "- 1:19 F", "- 2:3 F", "- 2:5 [", "- 2:7 `é`", "- 2:11 ]",
                 "- 2:13 F", "p 4:21 F", "p 4:23 A (x /*)*/ + {1, 2})", "p 4:44 F"});
    CHECK(placed(compile_text("#w : AS(1) A;\n#p : A : * : A;\n#q : S(x) : * : A;\n")) ==
          Places{"- 1:6 A", "- 1:7 S(1)", "- 1:12 A", "p 2:14 A", "q 3:17 A"});
    CHECK(placed(compile_text("#set names letters;\n#w : FAF(1);\n")) ==
          Places{"- 2:6 F", "- 2:7 A", "- 2:8 F(1)"});
}

TEST_CASE("modules of an included file are placed in it") {
    const test::Compiled c =
        test::compile_files({{"main.lsys", "#include \"leaf.lsys\";\n#w : A F;\n"},
                             {"leaf.lsys", "// one\n#p : A : * : F\n A;\n"}},
                            {});
    CHECK(placed(c) == Places{"- 2:6 A", "- 2:8 F", "p 2:14 F", "p 3:2 A"});
    const std::optional<Site> last = place_of(*c.outcome.bytecode, 3);
    REQUIRE(last);
    CHECK(c.outcome.bytecode->files[static_cast<std::size_t>(last->span.file)] == "leaf.lsys");
}

TEST_CASE("modules at equal distances share a row of places") {
    std::string text = "#w : ";
    for (int i = 0; i < 1'000; ++i) {
        text += "F +";
    }
    const test::Compiled c = compile_text(text + ";\n#p : F : * : F(1)F(2)F(3);\n");
    const Places all = placed(c);
    REQUIRE(all.size() == 2'003);
    CHECK(all[1'998] == "- 1:3003 F");
    CHECK(all[2'001] == "p 2:18 F(2)");
    // Blanks stand before every second module only, so a place run has two modules.
    CHECK(c.outcome.bytecode->template_places.size() == 1'001);
    const test::Compiled dense = compile_text("#w : F+F+F+F+F-F-F;\n#p : F : * : F(1)F(2)F(3);\n");
    CHECK(placed(dense).size() == 16);
    CHECK(dense.outcome.bytecode->template_places.size() == 2);
}
