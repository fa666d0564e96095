// SPDX-License-Identifier: MIT
// Origins that the turtle gives to segments and organs.
#include "runtime/turtle/turtle.h"
#include "tests/support/bytecode_builder.h"

#include <catch2/catch.hpp>

#include <cstdint>
#include <string>
#include <vector>

using namespace lsys;

namespace {

/// Draws modules whose origins are their indexes in the word.
Skeleton drawn_with_origins(const Bytecode& bytecode, const std::vector<Code>& codes) {
    std::vector<Origin> origins(codes.size());
    for (std::uint32_t i = 0; i < origins.size(); ++i) {
        origins[i].place = i;
    }
    Turtle turtle(bytecode, {});
    REQUIRE(turtle.feed(codes, {}, origins) == std::nullopt);
    REQUIRE(turtle.finish() == std::nullopt);
    return turtle.take_skeleton();
}

void set_operation(Bytecode& bytecode, const std::string& name, TurtleOperation operation) {
    for (BytecodeSymbol& symbol : bytecode.symbols) {
        symbol.turtle = symbol.name == name ? operation : symbol.turtle;
    }
}

} // namespace

TEST_CASE("modules of a long word keep their origins through `#interpret`") {
    Bytecode bytecode = test::BytecodeBuilder()
                            .axiom("F A")
                            .production(Stage::Interpret, "i : A : * : F F")
                            .build();
    set_operation(bytecode, "F", TurtleOperation::Forward);
    constexpr std::uint32_t kModules = 200'000; // more than the turtle interprets at once
    const std::vector<Code> codes(kModules, 0);
    const Skeleton skeleton = drawn_with_origins(bytecode, codes);
    REQUIRE(skeleton.segment_origins.size() == kModules);
    std::uint32_t wrong = 0;
    for (std::uint32_t i = 0; i < kModules; ++i) {
        wrong += skeleton.segment_origins[i].place == i ? 0U : 1U;
    }
    CHECK(wrong == 0);
}

TEST_CASE("an organ has the origin of the module that begins it") {
    Bytecode bytecode = test::BytecodeBuilder().axiom("F B f E").build();
    set_operation(bytecode, "F", TurtleOperation::Forward);
    set_operation(bytecode, "f", TurtleOperation::Move);
    set_operation(bytecode, "B", TurtleOperation::SurfaceBegin);
    set_operation(bytecode, "E", TurtleOperation::SurfaceEnd);
    // F F B f E F B f f E
    const Skeleton skeleton = drawn_with_origins(bytecode, {0, 0, 1, 2, 3, 0, 1, 2, 2, 3});
    REQUIRE(skeleton.object_origins.size() == 2);
    CHECK(skeleton.object_origins[0].place == 2);
    CHECK(skeleton.object_origins[1].place == 6);
}
