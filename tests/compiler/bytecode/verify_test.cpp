// SPDX-License-Identifier: MIT
#include "compiler/bytecode/disassemble.h"
#include "compiler/bytecode/verify.h"
#include "tests/compiler/small_bytecode.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <functional>

using namespace lsys;
using test::bits;
using test::op;

namespace {

/// The message of verify() for the small program after a change; empty if it verifies.
std::string verdict(const std::function<void(Bytecode&)>& change) {
    Bytecode bytecode = test::small_bytecode();
    change(bytecode);
    return verify(bytecode).value_or("");
}

} // namespace

TEST_CASE("a well-formed program verifies") {
    CHECK(verdict([](Bytecode&) {}).empty());
}

TEST_CASE("symbols and folded modules are checked") {
    CHECK(verdict([](Bytecode& b) { b.symbols[0].name.clear(); }) ==
          "symbol 0 has no printable name");
    CHECK(verdict([](Bytecode& b) { b.symbols[0].name = "a\x1B[2J"; }) ==
          "symbol 0 has no printable name");
    CHECK(verdict([](Bytecode& b) { b.symbols[3].parameter_count = 1; }) ==
          "symbol 3 has 1 parameters");
    CHECK(verdict([](Bytecode& b) { b.folded[0].symbol = SymbolId{9}; }) ==
          "folded module 0 is of no symbol with parameters");
    CHECK(verdict([](Bytecode& b) { b.folded[0].first_constant = 1; }) ==
          "folded module 0 does not follow the one before it");
    CHECK(verdict([](Bytecode& b) { b.constants[0] = HUGE_VALF; }) ==
          "a folded argument is not finite");
    CHECK(verdict([](Bytecode& b) { b.template_codes[1] = 6; }) == "code 6 does not exist");
}

TEST_CASE("contours and the modules that set them are checked") {
    const BytecodeContour ring{"ring", {{0.5F, 0.0F}, {0.0F, 0.5F}, {0.5F, 0.0F}}};
    const auto with = [&](const std::function<void(Bytecode&)>& change) {
        return verdict([&](Bytecode& b) {
            b.contours = {ring};
            b.symbols[1].turtle = TurtleOperation::SetContour;
            b.symbols[1].mesh_file = "ring";
            change(b);
        });
    };
    CHECK(with([](Bytecode&) {}).empty());
    CHECK(with([](Bytecode& b) { b.symbols[1].mesh_file.clear(); }).empty()); // a circle
    CHECK(with([](Bytecode& b) { b.symbols[1].mesh_file = "ping"; }) ==
          "symbol 1 sets a contour that does not exist");
    CHECK(with([](Bytecode& b) { b.contours[0].points.resize(1); }) == "contour 0 has 1 points");
    CHECK(with([](Bytecode& b) { b.contours[0].points.resize(65); }) == "contour 0 has 65 points");
    CHECK(with([](Bytecode& b) { b.contours[0].points[1].y = HUGE_VALF; }) ==
          "a point of contour 0 is not finite");
}

TEST_CASE("curves are checked") {
    const auto with = [](const std::vector<CurveKnot>& points) {
        return verdict([&](Bytecode& b) { b.curves = {{"bend", points}}; });
    };
    CHECK(with({{0.0F, 1.0F}, {1.0F, 0.5F}}).empty());
    CHECK(with({{0.0F, 1.0F}}) == "curve 0 has 1 points");
    CHECK(with({{0.0F, 1.0F}, {HUGE_VALF, 0.5F}}) == "point 1 of curve 0 is out of place");
    CHECK(with({{0.0F, 1.0F}, {1.0F, HUGE_VALF}}) == "point 1 of curve 0 is out of place");
    CHECK(with({{0.0F, NAN}, {1.0F, 0.5F}}) == "point 0 of curve 0 is out of place");
    CHECK(with({{0.0F, 1.0F}, {0.0F, 0.5F}}) == "point 1 of curve 0 is out of place");
}

TEST_CASE("heads are checked") {
    CHECK(verdict([](Bytecode& b) { b.patterns[1].first_formal = 0; }) ==
          "pattern item 1 is malformed");
    CHECK(verdict([](Bytecode& b) { b.patterns[4].kind = PatternKind::Open; }) ==
          "production 0 has an open bracket in its context");
    CHECK(verdict([](Bytecode& b) { b.productions[1].left.first = 0; }) ==
          "production 1 has a pattern out of place");
    CHECK(verdict([](Bytecode& b) { b.productions[0].has_left = false; }) ==
          "production 0 has an empty context");
    CHECK(verdict([](Bytecode& b) { b.productions[0].formal_count = 3; }) ==
          "production 0 has 2 formals, not 3");
    CHECK(verdict([](Bytecode& b) { b.productions[1].weight = 1.5F; }) ==
          "production 1 has a probability of 1.5");
    CHECK(verdict([](Bytecode& b) {
              b.productions[1].weight = 1.5F;
              b.settings.weights = WeightRule::Any;
          }).empty());
    CHECK(verdict([](Bytecode& b) { b.productions[1].rule = 2; }) ==
          "production 1 has rule 2, which no earlier production begins");
    CHECK(verdict([](Bytecode& b) { b.patterns[8].symbol = SymbolId{4}; }) ==
          "production 1 does not fit group 0");
    CHECK(verdict([](Bytecode& b) { b.context_group_count = 2; }) ==
          "1 rules and 2 groups are named, 1 and 1 found");
}

TEST_CASE("predecessors of several modules are allowed in the modes with rules only") {
    const auto two = [](Bytecode& b) {
        for (BytecodeProduction& p : b.productions) {
            p.predecessor.count = 2;
            p.right = {p.right.first + 1, 2};
        }
        for (const std::size_t at : {std::size_t{2}, std::size_t{7}}) {
            b.patterns[at] = {PatternKind::Module, SymbolId{1}, 2};
        }
        for (const std::size_t at :
             {std::size_t{3}, std::size_t{4}, std::size_t{8}, std::size_t{9}}) {
            b.patterns[at] = {PatternKind::Module, SymbolId{1}, 2};
        }
    };
    CHECK(verdict(two) == "production 0 has 2 modules to rewrite");
    CHECK(verdict([&](Bytecode& b) {
              two(b);
              b.settings.rewriting = RewritingMode::Sequential;
          }).empty());
}

TEST_CASE("code is checked") {
    const std::size_t condition = 10; // after the global's 7 words and the axiom's 3
    REQUIRE(test::small_bytecode().productions[0].condition == condition);
    const auto with = [&](std::size_t at, std::uint32_t word) {
        return verdict([&](Bytecode& b) { b.instructions[at] = word; });
    };
    CHECK(with(condition, op(Opcode::Formal, 2)) == "instruction 10 (formal) is not allowed there");
    CHECK(with(condition, op(Opcode::Global, 1)) == "instruction 10 (global) is not allowed there");
    CHECK(with(condition, op(Opcode::Global, 0)).empty());
    CHECK(with(condition, op(Opcode::Steps)) == "instruction 10 (steps) is not allowed there");
    CHECK(with(condition, 0xFF) == "instruction 10 does not exist");
    CHECK(with(condition + 3, op(Opcode::Sin)) == "the code at 10 leaves a wrong number of values");
    CHECK(with(condition + 3, op(Opcode::Emit)) == "instruction 13 (emit) is not allowed there");
    CHECK(with(condition + 4, op(Opcode::Add)) == "instruction 14 (add) lacks values");
    CHECK(with(condition + 3, op(Opcode::Greater, 1)) ==
          "instruction 13 (greater) is not allowed there");
    CHECK(with(0, op(Opcode::Global, 0)) == "instruction 0 (global) is not allowed there");
    CHECK(verdict([](Bytecode& b) { b.instructions.pop_back(); }) == "the code at 16 has no end");
    CHECK(verdict([](Bytecode& b) { b.instructions.push_back(op(Opcode::End)); }) ==
          "a table holds more than the productions use");
    CHECK(verdict([](Bytecode& b) { b.productions[0].successor.draw_count = 0; }) ==
          "instruction 21 (range) is not allowed there");
    CHECK(verdict([](Bytecode& b) { b.productions[0].successor.parameter_count = 2; }) ==
          "a successor stores 1 parameters, not 2");
}

TEST_CASE("the depth of the stack is that of the deepest expression") {
    const auto deep = [](std::uint32_t pushes, std::uint32_t depth) {
        return verdict([&](Bytecode& b) {
            std::vector<std::uint32_t> words;
            for (std::uint32_t i = 0; i < pushes; ++i) {
                words.push_back(op(Opcode::Formal, 1));
            }
            for (std::uint32_t i = 1; i < pushes; ++i) {
                words.push_back(op(Opcode::Power));
            }
            b.instructions.erase(b.instructions.begin() + 10, b.instructions.begin() + 14);
            b.instructions.insert(b.instructions.begin() + 10, words.begin(), words.end());
            b.productions[0].successor.arguments =
                10 + static_cast<std::uint32_t>(words.size()) + 2;
            b.stack_depth = depth;
        });
    };
    CHECK(deep(kUsualStack, kUsualStack).empty());
    CHECK(deep(2 * kUsualStack, 2 * kUsualStack).empty());
    CHECK(deep(8, 9) == "a stack of 8 values and 0 slots, not 9 and 0");
}

TEST_CASE("a random number is drawn once") {
    Bytecode bytecode = test::BytecodeBuilder()
                            .declare("A(x)")
                            .axiom("A({1, 2})")
                            .production("p : A(x) : * : A({0, x} + {0, 1})")
                            .build();
    const auto second =
        std::find(bytecode.instructions.begin(), bytecode.instructions.end(), op(Opcode::Range, 1));
    REQUIRE(second != bytecode.instructions.end());
    *second = op(Opcode::Range, 0);
    REQUIRE(verify(bytecode));
    CHECK(verify(bytecode)->ends_with("(range) is not allowed there"));
}

TEST_CASE("sites are checked") {
    CHECK(verdict([](Bytecode& b) { b.sites[1].span.file = FileId{1}; }) ==
          "site 1 lies in no file");
    CHECK(verdict([](Bytecode& b) { b.site_ranges[0].site = 5; }) ==
          "site range 0 is out of place");
    CHECK(verdict([](Bytecode& b) { b.site_ranges.push_back(b.site_ranges[0]); }) ==
          "site range 1 is out of place");
}

TEST_CASE("places of modules are checked") {
    CHECK(verdict([](Bytecode& b) { b.template_places.clear(); }).empty());
    CHECK(verdict([](Bytecode& b) { b.template_places[1].first = 0; }) == "place run 0 is empty");
    CHECK(verdict([](Bytecode& b) { b.template_places[2].first = 8; }) == "place run 2 is empty");
    CHECK(verdict([](Bytecode& b) { b.template_places[0].line = 0; }) ==
          "place run 0 is malformed");
    CHECK(verdict([](Bytecode& b) { b.template_places[0].column = 0; }) ==
          "place run 0 is malformed");
    CHECK(verdict([](Bytecode& b) { b.template_places[0].length = 0; }) ==
          "place run 0 is malformed");
    CHECK(verdict([](Bytecode& b) { b.template_places[0].stride = 1; }) ==
          "place run 0 is malformed");
    CHECK(verdict([](Bytecode& b) { b.template_places[1].begin = kNone - 2; }) ==
          "place run 1 ends beyond every file");
    CHECK(verdict([](Bytecode& b) { b.template_places[1].column = kNone - 2; }) ==
          "place run 1 ends beyond every file");
    CHECK(verdict([](Bytecode& b) { b.template_places[0].first = 1; }) ==
          "the modules of an axiom have no places");
    CHECK(verdict([](Bytecode& b) { b.axioms.front().site = kNone; }) ==
          "the modules of an axiom have no places");
    CHECK(verdict([](Bytecode& b) { b.template_places.pop_back(); }) ==
          "the modules of production 1 have no places");
    CHECK(verdict([](Bytecode& b) { b.productions[1].name_site = kNone; }) ==
          "the modules of production 1 have no places");
}

TEST_CASE("the production that wrote a module and the place of the module are found") {
    const Bytecode bytecode = test::small_bytecode();
    CHECK(production_with(bytecode, 2) == kNoProduction);
    CHECK(production_with(bytecode, 3) == ProductionId{0});
    CHECK(production_with(bytecode, 6) == ProductionId{0});
    CHECK(production_with(bytecode, 7) == ProductionId{1});
    const std::optional<Site> place = place_of(bytecode, 2);
    REQUIRE(place);
    CHECK(place->span == SourceSpan{FileId{0}, 48, 54});
    CHECK(place->line == 3);
    CHECK(place->column == 18);
    Bytecode without = bytecode;
    without.template_places.clear();
    CHECK(place_of(without, 2) == std::nullopt);
}

TEST_CASE("a site is found for every instruction after a mark") {
    const Bytecode bytecode = test::small_bytecode();
    CHECK(site_of(bytecode, 9) == kNone);
    CHECK(site_of(bytecode, 10) == 3);
    CHECK(site_of(bytecode, 20) == 3);
}

TEST_CASE("a listing shows symbols, code and places") {
    const std::string listing = disassemble(test::small_bytecode());
    for (const char* part :
         {"rewriting parallel, choice module, weights one, turtle lsys", "generations 6",
          "1 rule, 1 group, 6 codes of 1 byte", "    2 f/1 ignored move", "    5 f(0.5)",
          "global 0 s  ; small.lsys:1:9", "    codes A/1 f(0.5) f(0.5)",
          "production 0 p1: f($0) < A($1) > [ B ]  ; small.lsys:4:2",
          "  rule 0, group 0, probability 0.5", "      11 literal 2", "      21 range 0"}) {
        CAPTURE(part, listing);
        CHECK(listing.find(part) != std::string::npos);
    }
}
