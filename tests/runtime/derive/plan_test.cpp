// SPDX-License-Identifier: MIT
// Conditions and arguments with a fast form: comparisons of one parameter, and affine terms.
#include "runtime/derive/engine/plan.h"
#include "tests/support/bytecode_builder.h"

#include <catch2/catch.hpp>

#include <string>

using namespace lsys;
using test::BytecodeBuilder;

namespace {

Bytecode rewriting(const std::string& condition, const std::string& argument) {
    BytecodeBuilder builder;
    builder.fold = false;
    builder.axiom("A(1)").production("p : A(x) : " + condition + " : A(" + argument + ")");
    return builder.build();
}

ConditionKind kind_of(const std::string& condition) {
    const Bytecode bytecode = rewriting(condition, "x");
    Plan plan(bytecode, {}, true);
    plan.prepare(0);
    return plan.candidate(0).condition;
}

/// Whether an argument is one affine term.
bool is_affine(const std::string& argument) {
    const Bytecode bytecode = rewriting("*", argument);
    Plan plan(bytecode, {}, true);
    plan.prepare(0);
    const Entry& entry = plan.entries()[bytecode.code_count()]; // the first after those of codes
    return !entry.general;
}

} // namespace

TEST_CASE("comparisons with numbers, their negations and conjunctions have a fast form") {
    for (const char* const condition : {"x < 1", "2 <= x", "x*2 > 8", "!(x == 3)", "!(2 < x)",
                                        "1 < x && x < 4", "!(x == 3) && x*2 <= 8"}) {
        CAPTURE(condition);
        CHECK(kind_of(condition) == ConditionKind::Comparisons);
    }
    CHECK(kind_of("*") == ConditionKind::Always);
    CHECK(kind_of("1 > 2") == ConditionKind::Never);
    CHECK(kind_of("x == 1 || x == 5") == ConditionKind::Expression);
    CHECK(kind_of("!(1 < x && x < 4)") == ConditionKind::Expression);
}

TEST_CASE("arguments that scale and shift a parameter have a fast form") {
    for (const char* const argument :
         {"x", "3", "-x", "x*1.1", "x/4", "x+1", "x-1", "7-x", "2*x+1", "-x+1"}) {
        CAPTURE(argument);
        CHECK(is_affine(argument));
    }
    for (const char* const argument : {"x*x", "x*2*3", "x/3", "(x+1)*2", "x+1-4", "abs(x)"}) {
        CAPTURE(argument);
        CHECK_FALSE(is_affine(argument));
    }
}
