// SPDX-License-Identifier: MIT
#include "runtime/turtle/turtle_diagnostic.h"
#include "tests/support/bytecode_builder.h"

#include <catch2/catch.hpp>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace {

using namespace lsys;
using test::BytecodeBuilder;

/// The only diagnostic of `count` faults of `kind`.
Diagnostic diagnostic_of(TurtleFaultKind kind, std::uint64_t count) {
    std::array<TurtleFault, kTurtleFaultKindCount> faults{};
    faults[static_cast<std::size_t>(kind)].count = count;
    const std::vector<Diagnostic> all =
        turtle_diagnostics(faults, BytecodeBuilder().axiom("F[F").build());
    REQUIRE(all.size() == 1);
    return all[0];
}

} // namespace

TEST_CASE("a message about the end of a word has no module") {
    const Diagnostic one = diagnostic_of(TurtleFaultKind::UnclosedBranch, 1);
    CHECK(one.message == "the word ends with an open branch, which is closed there");
    CHECK(one.notes.empty());
    const Diagnostic several = diagnostic_of(TurtleFaultKind::UnclosedBranch, 1234);
    CHECK(several.message == "the word ends with 1,234 open branches, which are closed there");
    CHECK(several.notes.empty());
    CHECK(diagnostic_of(TurtleFaultKind::UnclosedPolygon, 1).message ==
          "module 0 of the word, a `F`, begins a polygon that nothing ends, which is not drawn");
}

TEST_CASE("a message about a module has its name") {
    const Diagnostic vertex = diagnostic_of(TurtleFaultKind::VertexOutside, 2);
    CHECK(vertex.message == "module 0 of the word, a `F`, is a vertex outside of any polygon");
    CHECK(vertex.notes ==
          std::vector<std::string>{"modules are counted from 0", "1 more module does so"});
}
