// SPDX-License-Identifier: MIT
#include "compiler/bytecode/verify.h"
#include "tests/compiler/compile_text.h"

#include <catch2/catch.hpp>

using namespace lsys;
using test::compile_text;
using Reports = std::vector<std::string>;

TEST_CASE("a local value is computed once and may stand anywhere in the successor") {
    const test::Compiled c = compile_text("#n = 1;\n"
                                          "#w : A(8);\n"
                                          "#p : A(x) : x > 1 : let l = x * 0.5, m = l + 1 : "
                                          "F(l) [A(m)] A(l);\n");
    CHECK(c.reports().empty());
    REQUIRE(c.outcome.bytecode);
    const Bytecode& bytecode = *c.outcome.bytecode;
    CHECK(bytecode.local_count == 2);
    CHECK(bytecode.productions[0].successor.locals != kNone);
    CHECK(bytecode.axioms.front().word.locals == kNone);
    CHECK(verify(bytecode) == std::nullopt);
}

TEST_CASE("a local value that is a literal or a name replaces its uses") {
    const test::Compiled c = compile_text("#n = 1;\n"
                                          "#w : A(8);\n"
                                          "#p : A(x) : * : let l = x, m = 2 : F(l) A(m);\n");
    CHECK(c.reports().empty());
    REQUIRE(c.outcome.bytecode);
    CHECK(c.outcome.bytecode->productions[0].successor.locals == kNone);
    CHECK(c.outcome.bytecode->local_count == 0);
}

TEST_CASE("`let` may name modules and formals where no local value follows") {
    const test::Compiled c = compile_text("#n = 1;\n"
                                          "#w : let A(1);\n"
                                          "#p : let : * : let let;\n"
                                          "#q : A(let) : let == 1 : let let F(let);\n");
    CHECK(c.errors().empty());
    CHECK(c.outcome.bytecode);
}

TEST_CASE("the name of a local value must not be in use") {
    CHECK(compile_text("#w : A(1);\n#p : A(x) : * : let x = 1 : F(x);\n").errors() ==
          Reports{"duplicate-local 2:21"});
    CHECK(compile_text("#w : A(1);\n#p : A(x) : * : let y = x, y = 2 : F(y);\n").errors() ==
          Reports{"duplicate-local 2:28"});
    const test::Compiled hidden =
        compile_text("#n = 1;\n#define y 3;\n#w : A(y);\n#p : A(x) : * : let y = x : F(y);\n");
    CHECK(hidden.reports() == Reports{"hidden-constant 4:21"});
}

TEST_CASE("a local value is known after its definition, in the successor") {
    CHECK(compile_text("#w : A(1);\n#p : A(x) : y > 1 : let y = x : F(y);\n").errors() ==
          Reports{"used-before-definition 2:13"});
    CHECK(compile_text("#w : A(1);\n#p : A(x) : * : let y = z, z = x : F(y) F(z);\n").errors() ==
          Reports{"used-before-definition 2:25"});
    const test::Compiled unused =
        compile_text("#n = 1;\n#w : A(1);\n#p : A(x) : * : let y = x / 2 : F(x);\n");
    CHECK(unused.reports() == Reports{"unused-local 3:21"});
}

TEST_CASE("missing signs around local values are reported") {
    CHECK(compile_text("#w : A(1);\n#p : A(x) : * : let y = x F(y);\n").errors() ==
          Reports{"missing-colon 2:27"});
    CHECK(compile_text("#w : A(1);\n#p : A(x) : * : let y = x;\n").errors() ==
          Reports{"missing-colon 2:26"});
    CHECK(compile_text("#w : A(1);\n#p : A(x) : * : let y = x z = 2 : F(y) F(z);\n").errors() ==
          Reports{"missing-comma 2:26"});
    CHECK(compile_text("#w : A(1);\n#p : A(x) : * : let y = x, : F(y);\n").errors().size() == 1);
}
