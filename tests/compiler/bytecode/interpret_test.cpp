// SPDX-License-Identifier: MIT
#include "compiler/bytecode/interpret.h"
#include "tests/support/builder_text.h"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

using namespace lsys;

namespace {

/// A domain whose values are texts: the value of an expression is its formula.
struct Formulas : UnknownDomain<std::string> {
    std::size_t instructions_left = 100;
    std::vector<std::string> taken;

    bool enter() { return instructions_left-- != 0; }
    static std::string literal(float value) { return std::to_string(static_cast<int>(value)); }
    static std::string formal(std::uint32_t index) { return "f" + std::to_string(index); }
    static std::string global(std::uint32_t index) { return "g" + std::to_string(index); }
    static std::string step() { return "step"; }
    static std::string steps() { return "steps"; }
    static std::string branch_draw(std::uint32_t branch) { return "b" + std::to_string(branch); }
    static std::string unary(Opcode opcode, const std::string& x) {
        return std::string(info(opcode).mnemonic) + " " + x;
    }
    static std::string binary(Opcode opcode, const std::string& x, const std::string& y) {
        return "(" + x + " " + std::string(info(opcode).mnemonic) + " " + y + ")";
    }
    static bool random_draw(Opcode /*opcode*/,
                            std::string& x,
                            const std::string& y,
                            std::uint32_t index,
                            const std::uint32_t* at) {
        x = "{" + x + ", " + y + "}" + std::to_string(index);
        return opcode_of(*at) == Opcode::Range && index < 7;
    }
    bool take(const std::string& x, const std::uint32_t* at) {
        taken.push_back(x);
        return opcode_of(*at) == Opcode::Emit;
    }
};

struct Run {
    bool finished = false;
    std::vector<std::string> taken;
};

Run run(const std::vector<std::uint32_t>& code, std::size_t limit = 100) {
    Formulas domain;
    domain.instructions_left = limit;
    std::vector<std::string> stack(kUsualStack);
    const bool finished = interpret(code.data(), domain, stack.data(), nullptr);
    return {finished, domain.taken};
}

/// The instructions of expressions in x and y, with an Emit after each, then End.
std::vector<std::uint32_t> compiled(const std::vector<std::string>& expressions) {
    const test::NameTable formals{{"x", 0}, {"y", 1}};
    const test::NameTable globals{{"c", 0}};
    std::uint32_t draws = 0;
    bool uses_steps = false;
    std::vector<std::uint32_t> code;
    for (const std::string& text : expressions) {
        const test::Instructions one =
            test::compile_expression(text, {formals, globals, draws, uses_steps});
        code.insert(code.end(), one.begin(), one.end());
        code.push_back(encode(Opcode::Emit, 0));
    }
    code.push_back(encode(Opcode::End, 0));
    return code;
}

} // namespace

TEST_CASE("a domain of formulas sees every operation with its operands in order") {
    const Run formulas =
        run(compiled({"x * 2 - y / c", "sin(-x) < step() && steps() != 3", "{1, max(x, 2)} + x"}));
    CHECK(formulas.finished);
    CHECK(formulas.taken ==
          std::vector<std::string>{"((f0 multiply 2) subtract (f1 divide g0))",
                                   "((sin negate f0 less step) and (steps not-equal 3))",
                                   "({1, (f0 max 2)}0 add f0)"});
}

TEST_CASE("if the right operand is computed first, the operands are exchanged") {
    const std::vector<std::uint32_t> code{encode(Opcode::Formal, 1), encode(Opcode::BranchDraw, 4),
                                          encode(Opcode::Swap, 0),   encode(Opcode::Power, 0),
                                          encode(Opcode::Emit, 0),   encode(Opcode::End, 0)};
    CHECK(run(code).taken == std::vector<std::string>{"(b4 power f1)"});
}

TEST_CASE("a domain can stop the walk before an instruction, at a range and at a consumed value") {
    const std::vector<std::uint32_t> code = compiled({"x + y", "y"});
    CHECK(run(code, 7).finished);
    CHECK_FALSE(run(code, 6).finished);
    CHECK(run(code, 6).taken.size() == 2);
    CHECK(run(code, 3).taken.empty());
    const std::vector<std::uint32_t> range{encode(Opcode::Formal, 0), encode(Opcode::Formal, 1),
                                           encode(Opcode::Range, 7), encode(Opcode::Emit, 0),
                                           encode(Opcode::End, 0)};
    CHECK_FALSE(run(range).finished);
    CHECK(run(range).taken.empty());
    CHECK_FALSE(run({encode(Opcode::Formal, 0), encode(Opcode::Test, 0)}).finished);
}

TEST_CASE("the stack of code has room for its deepest expression") {
    CHECK(stack_room(compiled({"x * 2 - y / c"}), 0) == 3);
    std::string sum = "x";
    std::vector<std::uint32_t> nested; // mix(x, y, mix(x, y, ... x))
    for (std::uint32_t i = 0; i < kUsualStack; ++i) {
        sum += " + x";
        nested.push_back(encode(Opcode::Formal, 0));
        nested.push_back(encode(Opcode::Formal, 1));
    }
    nested.push_back(encode(Opcode::Formal, 0));
    nested.insert(nested.end(), kUsualStack, encode(Opcode::Mix, 0));
    nested.push_back(encode(Opcode::End, 0));
    CHECK(stack_room(compiled({sum}), 0) == 2);
    CHECK(stack_room(nested, 0) == 2 * kUsualStack + 1);
}

TEST_CASE("every value is unknown in UnknownDomain") {
    struct Nothing {};
    UnknownDomain<Nothing> domain;
    std::vector<Nothing> stack(kUsualStack);
    CHECK(interpret(compiled({"{x, 2} * sin(c) - steps()"}).data(), domain, stack.data(), nullptr));
}

TEST_CASE("a range lists instructions with their operands and literals, the end included") {
    const std::vector<std::uint32_t> code = compiled({"y * 2.5"});
    std::vector<Opcode> opcodes;
    for (const Instruction each : InstructionRange(code, 0)) {
        opcodes.push_back(each.opcode);
        CHECK(opcode_of(code[each.at]) == each.opcode);
        CHECK(each.operand == (each.opcode == Opcode::Formal ? 1U : 0U));
        CHECK(each.literal == (each.opcode == Opcode::Literal ? 2.5F : 0.0F));
    }
    CHECK(opcodes == std::vector<Opcode>{Opcode::Formal, Opcode::Literal, Opcode::Multiply,
                                         Opcode::Emit, Opcode::End});
    std::size_t count = 0;
    for (const Instruction each : InstructionRange(code, 1, 4)) {
        CHECK(each.opcode != Opcode::Emit);
        ++count;
    }
    CHECK(count == 2);
}
