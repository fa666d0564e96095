// SPDX-License-Identifier: MIT
#include "compiler/lint/impl/lints.h"
#include "compiler/lower/lower.h"
#include "compiler/program/program.h"
#include "grammar/base/cancellation.h"
#include "tests/compiler/compile_text.h"

#include <catch2/catch.hpp>

#include <atomic>

using namespace lsys;

namespace {

std::vector<std::uint32_t> copied(std::span<const std::uint32_t> list) {
    return {list.begin(), list.end()};
}

} // namespace

TEST_CASE("productions are listed by the symbols of their predecessors and of their successors") {
    const test::Compiled c = test::compile_text("#set rewriting sequential;\n"
                                                "#w : A B;\n"
                                                "#p : A B : * : B A A;\n"
                                                "#q : B : * : C;\n");
    CAPTURE(c.reports());
    REQUIRE(c.outcome.program);
    const GroupedLists rewriters = rewriters_of(*c.outcome.program);
    CHECK(copied(rewriters[0]) == std::vector<std::uint32_t>{0});
    CHECK(copied(rewriters[1]) == std::vector<std::uint32_t>{0, 1});
    CHECK(rewriters[2].empty());
    const GroupedLists writers = writers_of(*c.outcome.program);
    CHECK(copied(writers[0]) == std::vector<std::uint32_t>{0});
    CHECK(copied(writers[1]) == std::vector<std::uint32_t>{0});
    CHECK(copied(writers[2]) == std::vector<std::uint32_t>{1});
}

TEST_CASE("a walk over the expressions of a production visits each node") {
    const test::Compiled c = test::compile_text("#w : A(1, 2);\n"
                                                "#p : A(x, y) : x < y * y : A(x + 1, -y);\n");
    CAPTURE(c.reports());
    REQUIRE(c.outcome.program);
    const Program& program = *c.outcome.program;
    const Production& production = program.productions[0];
    CHECK(expressions_of(program, production).size() == 4);
    std::vector<int> counts(kOpcodeCount, 0);
    for_each_value(program, expressions_of(program, production),
                   [&](ValueId id, const Value& value) {
                       CHECK(&program.value(id) == &value);
                       ++counts[static_cast<std::size_t>(value.opcode)];
                   });
    const auto count = [&](Opcode opcode) { return counts[static_cast<std::size_t>(opcode)]; };
    CHECK(count(Opcode::Formal) == 5);
    CHECK(count(Opcode::Multiply) == 1);
    CHECK(count(Opcode::Less) == 1);
    CHECK(count(Opcode::Add) == 1);
    CHECK(count(Opcode::Negate) == 1);
    CHECK(count(Opcode::Literal) == 1);
}

TEST_CASE("passes over words and expressions end when they are cancelled") {
    const test::Compiled c = test::compile_text("#n = 2;\n#set turtle cpfg;\n"
                                                "#w : A(1) +(30) { F . F . F } [ F ];\n"
                                                "#p : A(x) : x > 1 : F(x) [ A(x - 1) ];\n");
    CAPTURE(c.reports());
    REQUIRE(c.outcome.program);
    const Program& program = *c.outcome.program;
    const ProgramWord& word = program.axioms[0].word;
    const std::atomic<bool> cancelled{true};
    const CancellationScope scope(&cancelled);
    CHECK_THROWS_AS(for_each_symbol(program, word, [](std::size_t, SymbolId) {}),
                    CompilationCancelled);
    CHECK_THROWS_AS(
        for_each_module(program, word, [](std::size_t, std::size_t, const ProgramModule&) {}),
        CompilationCancelled);
    CHECK_THROWS_AS(for_each_value(program, {program.arguments[0]}, [](ValueId, const Value&) {}),
                    CompilationCancelled);
    CHECK_THROWS_AS(lower(program, c.names, c.sources), CompilationCancelled);
    Diagnostics diagnostics;
    const CompileOptions options;
    const CheckInput input{program, &*c.outcome.bytecode, c.names, c.sources, options};
    for (const Check check :
         {check_branches, check_polygons, check_foreign_habits, check_module_use}) {
        CHECK_THROWS_AS(check(input, diagnostics), CompilationCancelled);
    }
}
