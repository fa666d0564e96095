// SPDX-License-Identifier: MIT
// A small Bytecode that uses every table except those of curves and materials. It is the result of
// lowering this grammar:
//   #define s {1, 2};
//   #ignore : f;
//   #w : A(s) f(0.5) f(0.5);
//   #p1 : f(v) < A(x) > [ B ] : x > 2 ~ 0.5 : f(0.5) [ A(x + {0, 1}) ];
//   #p2 : f(v) < A(x) > [ B ] : * ~ 0.5 : B;
#pragma once

#include "tests/support/bytecode_builder.h"

#include <bit>
#include <cstdint>

namespace lsys::test {

inline std::uint32_t op(Opcode opcode, std::uint32_t operand = 0) {
    return encode(opcode, operand);
}
inline std::uint32_t bits(float value) {
    return std::bit_cast<std::uint32_t>(value);
}

inline Bytecode small_bytecode() {
    Bytecode b =
        BytecodeBuilder()
            .declare("A(x) B f(v) [ ]")
            .global("s", "{1, 2}")
            .ignore("f")
            .axiom("A(s) f(0.5) f(0.5)")
            .production("p1 : f(v) < A(x) > [ B ] : x > 2 ~ 0.5 : f(0.5) [ A(x + {0, 1}) ]")
            .production("p2 : f(v) < A(x) > [ B ] : * ~ 0.5 : B")
            .build();
    b.generations = 6;
    b.files = {"small.lsys"};
    b.symbols[2].turtle = TurtleOperation::Move;
    b.symbols[3].turtle = TurtleOperation::Save;
    b.symbols[4].turtle = TurtleOperation::Restore;
    b.sites = {{{FileId{0}, 8, 9}, 1, 9},
               {{FileId{0}, 30, 40}, 3, 6},
               {{FileId{0}, 50, 52}, 4, 2},
               {{FileId{0}, 60, 65}, 4, 20},
               {{FileId{0}, 70, 80}, 5, 2}};
    b.globals[0].site = 0;
    b.axioms.front().site = 1;
    b.productions[0].name_site = 2;
    b.productions[1].name_site = 4;
    b.site_ranges = {{b.productions[0].condition, 3}};
    b.template_places = {{0, 34, 6, 7, 3, 4}, {3, 66, 2, 2, 4, 26}, {7, 82, 1, 0, 5, 14}};
    return b;
}

} // namespace lsys::test
