#include "compiler/disassemble.h"
#include "compiler/module_file.h"
#include "compiler/verify.h"
#include "tests/compiler/compile_text.h"

#include <catch2/catch.hpp>

using namespace lsys;
using test::compile_text;

namespace {

Bytecode lowered(const std::string& text) {
    test::Compiled c = compile_text(text);
    CAPTURE(text, c.said());
    REQUIRE(c.outcome.bytecode);
    CHECK(verify(*c.outcome.bytecode) == std::nullopt);
    return *std::move(c.outcome.bytecode);
}

std::vector<Code> codes_of(const Bytecode& b, const WordTemplate& word) {
    const auto first = b.template_codes.begin() + word.codes.first;
    return {first, first + word.codes.count};
}

std::vector<Opcode> code_at(const Bytecode& b, std::uint32_t at) {
    std::vector<Opcode> opcodes;
    while (opcodes.empty() || opcodes.back() != Opcode::End) {
        opcodes.push_back(static_cast<Opcode>(b.instructions[at] & 0xFF));
        at += opcodes.back() == Opcode::Literal ? 2U : 1U;
    }
    return opcodes;
}

} // namespace

TEST_CASE("modules of constant arguments become codes of their own and store nothing") {
    const Bytecode b = lowered("#w : F(1) +(22.5) F(1) F(2);\n"
                               "#p : F(x) : * : F(x) F(1) +(22.5) +(x);\n");
    REQUIRE(b.symbols.size() == 2);
    CHECK(b.folded.size() == 3); // F(1) +(22.5) F(2)
    CHECK(codes_of(b, b.axiom) == std::vector<Code>{2, 3, 2, 4});
    CHECK(b.axiom.arguments == kNone);
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
    CHECK(b.axiom.parameter_count == 300 - 255);
    CHECK(codes_of(b, b.axiom).back() == 8); // F(7) was folded early
}

TEST_CASE("negative zero is another constant than zero") {
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

TEST_CASE("every value that can fail knows its place") {
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
    for (std::uint32_t at = p.successor.arguments;; ++at) {
        const auto opcode = static_cast<Opcode>(b.instructions[at] & 0xFF);
        if (opcode == Opcode::Emit) {
            emits.push_back(place(at));
        } else if (opcode == Opcode::Range) {
            range = place(at);
        } else if (opcode == Opcode::End) {
            break;
        } else if (opcode == Opcode::Literal) {
            ++at;
        }
    }
    CHECK(emits == std::vector<std::string>{"3:28", "3:37"});
    CHECK(range == "3:37");
    CHECK(b.sites[b.axiom_site].line == 2);
    CHECK(b.sites[b.globals[0].site].line == 1);
    CHECK(b.sites[p.name_site].column == 2);
}

TEST_CASE("a program is the same after a file, and its dumps are total") {
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

TEST_CASE("compiling twice gives the same bytes") {
    const char* text = "#w : A(1) B;\n#p : A(x) : * : B A(x + 0.5) +(30) B;\n#q : B : * : F;\n";
    CHECK(write_module_file(lowered(text)) == write_module_file(lowered(text)));
}

TEST_CASE("nothing is lowered where there are errors, or when it is not wanted") {
    const test::Compiled wrong = compile_text("#w : F(x);");
    CHECK_FALSE(wrong.outcome.program);
    CHECK_FALSE(wrong.outcome.bytecode);
    CompileOptions options;
    options.lower = false;
    const test::Compiled c = compile_text("#w : F;", options);
    CHECK(c.outcome.program);
    CHECK_FALSE(c.outcome.bytecode);
}
