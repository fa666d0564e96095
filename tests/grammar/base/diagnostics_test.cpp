// SPDX-License-Identifier: MIT
#include "grammar/base/diagnostic.h"

#include <catch2/catch.hpp>

using namespace lsys;

TEST_CASE("a diagnostic that is reported twice counts once, and the others keep their counts") {
    const FileId file{0};
    Diagnostics diagnostics;
    diagnostics.add(DiagnosticCode::ParameterStays, {file, 0, 1}, "a note");
    diagnostics.add(DiagnosticCode::BracketInHead, {file, 8, 9}, "an error");
    diagnostics.add(DiagnosticCode::ParameterStays, {file, 0, 1}, "a note");
    diagnostics.add(DiagnosticCode::ForeignIgnored, {file, 4, 5}, "a warning");
    diagnostics.sort_by_place();
    REQUIRE(diagnostics.all().size() == 3);
    CHECK(diagnostics.all()[0].message == "a note");
    CHECK(diagnostics.all()[1].message == "a warning");
    CHECK(diagnostics.all()[2].message == "an error");
    CHECK(diagnostics.count(Severity::Note) == 1);
    CHECK(diagnostics.count(Severity::Warning) == 1);
    CHECK(diagnostics.count(Severity::Error) == 1);
    CHECK(diagnostics.has_errors());
}
