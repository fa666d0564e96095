// SPDX-License-Identifier: MIT
#include "grammar/base/message_levels.h"

#include <catch2/catch.hpp>

using namespace lsys;

namespace {

Diagnostic warning(DiagnosticCode code, SourceSpan span) {
    return make_diagnostic(code, span, "text");
}

} // namespace

TEST_CASE("the level of a code overrides that of its group") {
    MessageLevels levels;
    CHECK(!levels.set(MessageLevel::Deny, "warnings"));
    CHECK(!levels.set(MessageLevel::Allow, "idle-module"));
    CHECK(!levels.set(MessageLevel::Warn, "drawn-once"));
    CHECK(!levels.set(MessageLevel::Warn, "drawn-once"));
    CHECK(levels.set(MessageLevel::Deny, "drawn-once"));
    CHECK(levels.set(MessageLevel::Allow, "warnings"));
    CHECK(levels.set(MessageLevel::Allow, "unknown-name"));
    CHECK(levels.set(MessageLevel::Allow, "no-such-code"));

    Diagnostics diagnostics;
    diagnostics.add(warning(DiagnosticCode::IdleModule, {}));
    diagnostics.add(warning(DiagnosticCode::UnusedConstant, {}));
    diagnostics.add(warning(DiagnosticCode::DrawnOnce, {}));
    diagnostics.add(warning(DiagnosticCode::ConstantRange, {}));
    diagnostics.add(warning(DiagnosticCode::UnknownName, {}));
    apply_levels(levels, SourceMap(), diagnostics);
    REQUIRE(diagnostics.all().size() == 4);
    CHECK(diagnostics.all()[0].severity == Severity::Error);
    CHECK(diagnostics.all()[1].severity == Severity::Warning);
    CHECK(diagnostics.all()[2].severity == Severity::Note);
    CHECK(diagnostics.count(Severity::Error) == 2);
    CHECK(diagnostics.count(Severity::Warning) == 1);
    CHECK(diagnostics.count(Severity::Note) == 1);
}

TEST_CASE("a comment allows a code within its statement") {
    SourceMap sources;
    const FileId file = sources.add("a", std::string(100, ' '));
    sources.allow({file, 10, 20}, "idle-module");
    sources.allow({file, 30, 40}, "split-name");
    sources.allow({file, 30, 40}, "idle-module");
    CHECK(sources.allows({file, 10, 11}, "idle-module"));
    CHECK(sources.allows({file, 35, 36}, "idle-module"));
    CHECK(sources.allows({file, 40, 40}, "split-name"));
    CHECK(!sources.allows({file, 15, 16}, "split-name"));
    CHECK(!sources.allows({file, 25, 26}, "idle-module"));
    CHECK(!sources.allows({file, 5, 6}, "idle-module"));
    CHECK(!sources.allows({file, 41, 42}, "idle-module"));
}

TEST_CASE("columns in UTF-16 count two units for characters beyond 16 bits") {
    const SourceFile file("a", "\xF0\x9D\x90\x80\xC3\xA9x\nx");
    CHECK(file.line_column(4).column == 2);
    CHECK(file.line_column(4).utf16_column == 3);
    CHECK(file.line_column(6).column == 3);
    CHECK(file.line_column(6).utf16_column == 4);
    CHECK(file.line_column(8).utf16_column == 1);
    const SourceFile wide("b", "\xF0\x9D\x90\x80" + std::string(10'000, 'x'));
    CHECK(wide.line_column(9'000).column == 8'998);
    CHECK(wide.line_column(9'000).utf16_column == 8'999);
}
