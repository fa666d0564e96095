// SPDX-License-Identifier: MIT
#include "compiler/bytecode/turtle_operation.h"

#include <catch2/catch.hpp>

#include <set>
#include <string>

using namespace lsys;

TEST_CASE("every operation of the turtle has a unique name and states its parameters") {
    std::set<std::string_view> names;
    for (const TurtleOperation operation : enumerators_of<TurtleOperation>()) {
        const TurtleInfo& row = info(operation);
        CAPTURE(std::string(row.name));
        CHECK(!row.name.empty());
        CHECK(names.insert(row.name).second);
        CHECK((row.parameter_count == 0) == row.parameters.empty());
    }
}

TEST_CASE("only the rotations by an angle count as turns") {
    std::string turn_names;
    for (const TurtleOperation operation : enumerators_of<TurtleOperation>()) {
        turn_names += turns(operation) ? std::string(name_of(operation)) + ' ' : "";
    }
    CHECK(turn_names == "yaw-right yaw-left pitch-down pitch-up roll-right roll-left ");
    CHECK(draws(TurtleOperation::PolygonEnd));
    CHECK_FALSE(draws(TurtleOperation::Move));
}
