// A small Bytecode by hand that uses every table: what the lowering would make of
//   #define s {1, 2};
//   #ignore : f;
//   #w : A(s) f(0.5) f(0.5);
//   #p1 : f(v) < A(x) > [ B ] : x > 2 ~ 0.5 : f(0.5) [ A(x + {0, 1}) ];
//   #p2 : f(v) < A(x) > [ B ] : * ~ 0.5 : B;
#pragma once

#include "compiler/bytecode/bytecode.h"

#include <bit>
#include <cstdint>
#include <initializer_list>

namespace lsys::test {

inline std::uint32_t op(Opcode opcode, std::uint32_t operand = 0) {
    return encode(opcode, operand);
}
inline std::uint32_t bits(float value) {
    return std::bit_cast<std::uint32_t>(value);
}

inline Bytecode small_bytecode() {
    Bytecode b;
    b.generations = 6;
    b.files = {"small.lsys"};
    const auto symbol = [&](const char* name, std::uint32_t parameters) {
        BytecodeSymbol row;
        row.name = name;
        row.parameter_count = parameters;
        b.symbols.push_back(row);
        return static_cast<SymbolId>(b.symbols.size() - 1);
    };
    const SymbolId a = symbol("A", 1);
    const SymbolId bb = symbol("B", 0);
    const SymbolId f = symbol("f", 1);
    const SymbolId open = symbol("[", 0);
    const SymbolId close = symbol("]", 0);
    b.symbols[2].ignored = true;
    b.symbols[2].turtle = TurtleOperation::Move;
    b.symbols[3].kind = SymbolKind::BranchOpen;
    b.symbols[3].turtle = TurtleOperation::Save;
    b.symbols[4].kind = SymbolKind::BranchClose;
    b.symbols[4].turtle = TurtleOperation::Restore;
    static_cast<void>(open);
    static_cast<void>(close);
    b.folded = {{f, 0}};
    b.constants = {0.5F};
    b.sites = {{{FileId{0}, 8, 9}, 1, 9},
               {{FileId{0}, 30, 40}, 3, 6},
               {{FileId{0}, 50, 52}, 4, 2},
               {{FileId{0}, 60, 65}, 4, 20},
               {{FileId{0}, 70, 80}, 5, 2}};

    const auto code = [&](std::initializer_list<std::uint32_t> words) {
        const auto first = static_cast<std::uint32_t>(b.instructions.size());
        b.instructions.insert(b.instructions.end(), words);
        return first;
    };
    BytecodeGlobal s;
    s.name = "s";
    s.draw_count = 1;
    s.site = 0;
    s.instruction = code({op(Opcode::Literal), bits(1.0F), op(Opcode::Literal), bits(2.0F),
                          op(Opcode::Range, 0), op(Opcode::Emit), op(Opcode::End)});
    b.globals = {s};

    b.template_codes = {0, 5, 5};
    b.axiom = {{0, 3}, code({op(Opcode::Global, 0), op(Opcode::Emit), op(Opcode::End)}), 1, 0};
    b.axiom_site = 1;
    b.axiom_draw_position = 1;

    const auto head = [&](const char* name, std::uint32_t site) {
        BytecodeProduction p;
        p.name = name;
        p.name_site = site;
        p.has_left = true;
        p.has_right = true;
        const auto first = static_cast<std::uint32_t>(b.patterns.size());
        b.patterns.push_back({PatternKind::Module, f, 0});
        b.patterns.push_back({PatternKind::Module, a, 1});
        b.patterns.push_back({PatternKind::Open, kNoSymbol, 0});
        b.patterns.push_back({PatternKind::Module, bb, 2});
        b.patterns.push_back({PatternKind::Close, kNoSymbol, 0});
        p.left = {first, 1};
        p.predecessor = {first + 1, 1};
        p.right = {first + 2, 3};
        p.formal_count = 2;
        p.stochastic = true;
        p.weight = 0.5F;
        return p;
    };
    BytecodeProduction p1 = head("p1", 2);
    b.site_marks.push_back({static_cast<std::uint32_t>(b.instructions.size()), 3});
    p1.condition = code({op(Opcode::Formal, 1), op(Opcode::Literal), bits(2.0F),
                         op(Opcode::Greater), op(Opcode::Test), op(Opcode::End)});
    p1.successor.codes = {3, 4};
    b.template_codes.insert(b.template_codes.end(), {5, 3, 0, 4});
    p1.successor.parameter_count = 1;
    p1.successor.draw_count = 1;
    p1.successor.arguments = code({op(Opcode::Formal, 1), op(Opcode::Literal), bits(0.0F),
                                   op(Opcode::Literal), bits(1.0F), op(Opcode::Range, 0),
                                   op(Opcode::Add), op(Opcode::Emit), op(Opcode::End)});
    BytecodeProduction p2 = head("p2", 4);
    p2.successor.codes = {7, 1};
    b.template_codes.push_back(1);
    b.productions = {p1, p2};
    b.template_places = {{0, 34, 6, 7, 3, 4}, {3, 66, 2, 2, 4, 26}, {7, 82, 1, 0, 5, 14}};
    b.rule_count = 1;
    b.group_count = 1;
    return b;
}

} // namespace lsys::test
