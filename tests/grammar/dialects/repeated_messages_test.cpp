// SPDX-License-Identifier: MIT
#include "grammar/dialects/repeated_messages.h"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

using namespace lsys;

namespace {

constexpr FileId kFile{0};

SourceSpan place(std::uint32_t begin) {
    return {kFile, begin, begin + 1};
}

std::vector<std::string> messages(const Diagnostics& diagnostics) {
    std::vector<std::string> texts;
    for (const Diagnostic& diagnostic : diagnostics.all()) {
        texts.push_back(diagnostic.message);
    }
    return texts;
}

} // namespace

TEST_CASE("equal errors become one, at the first place") {
    Diagnostics diagnostics;
    diagnostics.add(DiagnosticCode::ForeignSyntax, place(9), "`)` belongs to no symbol");
    diagnostics.add(DiagnosticCode::ForeignSyntax, place(4), "`)` belongs to no symbol");
    diagnostics.add(DiagnosticCode::ForeignSyntax, place(2), "`(` belongs to no symbol");
    merge_repeated_messages(diagnostics, 0);
    CHECK(messages(diagnostics) ==
          std::vector<std::string>{"`)` belongs to no symbol", "`(` belongs to no symbol"});
    CHECK(diagnostics.all()[0].span == place(4));
    REQUIRE(diagnostics.all()[0].labels.size() == 1);
    CHECK(diagnostics.all()[0].labels[0].span == place(9));
    CHECK(diagnostics.count(Severity::Error) == 2);
}

TEST_CASE("warnings that differ in names only become one") {
    Diagnostics diagnostics;
    diagnostics.add(DiagnosticCode::UnusedConstant, place(1), "constant `a1` is never used");
    diagnostics.add(DiagnosticCode::UnusedConstant, place(2), "constant `b` is never used");
    diagnostics.add(DiagnosticCode::IdleModule, place(3), "module `b` is never rewritten");
    merge_repeated_messages(diagnostics, 0);
    REQUIRE(diagnostics.all().size() == 2);
    REQUIRE(diagnostics.all()[0].labels.size() == 1);
    CHECK(diagnostics.all()[0].labels[0].text == "constant `b` is never used");
}

TEST_CASE("messages before the first index, and errors with other names, stay") {
    Diagnostics diagnostics;
    diagnostics.add(DiagnosticCode::UnusedConstant, place(1), "constant `a` is never used");
    diagnostics.add(DiagnosticCode::UnusedConstant, place(2), "constant `b` is never used");
    diagnostics.add(DiagnosticCode::UnknownName, place(3), "unknown name `x`");
    diagnostics.add(DiagnosticCode::UnknownName, place(4), "unknown name `y`");
    merge_repeated_messages(diagnostics, 1);
    CHECK(diagnostics.all().size() == 4);
}

TEST_CASE("a statement that another one replaces hides the warnings that follow from it") {
    Diagnostics diagnostics;
    diagnostics.add(DiagnosticCode::NeverProduced, place(1), "module `A` never occurs");
    drop_follow_ups(diagnostics);
    CHECK(diagnostics.all().size() == 1);
    mark_lost_statement(
        diagnostics.add(DiagnosticCode::ForeignQuirk, place(2), "this is not the axiom"));
    diagnostics.add(DiagnosticCode::UnknownName, place(3), "unknown name `x`");
    drop_follow_ups(diagnostics);
    CHECK(messages(diagnostics) ==
          std::vector<std::string>{"this is not the axiom", "unknown name `x`"});
}
