// SPDX-License-Identifier: MIT
#include "runtime/program/host.h"
#include "runtime/repair/chosen_fixes.h"
#include "runtime/repair/fixes.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

using namespace lsys;
using namespace lsys::repair;

namespace {

constexpr std::uint64_t kManyModules = std::uint64_t{1} << 32;

struct EditedText {
    SourceMap sources;
    FileId file;
    Diagnostics diagnostics;
    std::size_t fix_count = 0;

    explicit EditedText(std::string text) : file(sources.add("a.lsys", std::move(text))) {}

    void add(std::vector<Edit> edits, bool machine_applicable = true) {
        Diagnostic diagnostic =
            make_diagnostic(DiagnosticCode::LookAlike, edits.front().span, "wrong");
        diagnostic.fixes.push_back({"mend", std::move(edits), machine_applicable});
        diagnostics.add(std::move(diagnostic));
    }
    Edit edit(std::uint32_t begin, std::uint32_t end, std::string replacement) const {
        return {{file, begin, end}, std::move(replacement)};
    }
    std::string apply() {
        const ChosenFixes chosen = choose_fixes(diagnostics, sources, FixChoice::Certain,
                                                [](const Diagnostic&, const Fix&) { return true; });
        fix_count += chosen.fixes.size();
        const auto found = chosen.edits.find("a.lsys");
        return apply_edits(sources.file(file).text(), found == chosen.edits.end()
                                                          ? std::vector<const Edit*>()
                                                          : found->second);
    }
};

} // namespace

TEST_CASE("fixes may be given in any order") {
    EditedText f("0123456789");
    f.add({f.edit(7, 8, "seven")});
    f.add({f.edit(2, 4, ""), f.edit(0, 0, "<")});
    CHECK(f.apply() == "<01456seven89");
    CHECK(f.fix_count == 2);
}

TEST_CASE("if fixes overlap, the first is applied") {
    EditedText overlap("0123456789");
    overlap.add({overlap.edit(2, 6, "A")});
    overlap.add({overlap.edit(5, 7, "B")});
    overlap.add({overlap.edit(0, 3, "C")});
    overlap.add({overlap.edit(3, 3, "D")});
    overlap.add({overlap.edit(6, 7, "E")});
    CHECK(overlap.apply() == "01AE789");
    EditedText same("01");
    same.add({same.edit(1, 1, "A")});
    same.add({same.edit(1, 1, "B")});
    same.add({same.edit(0, 2, "C")});
    same.add({same.edit(1, 2, "D")});
    CHECK(same.apply() == "0A1");
    EditedText whole("0123");
    whole.add({whole.edit(0, 1, "A"), whole.edit(3, 4, "B")});
    whole.add({whole.edit(1, 2, "C"), whole.edit(3, 4, "D")});
    CHECK(whole.apply() == "A12B");
}

TEST_CASE("fixes that are not certain are not applied") {
    EditedText f("0123");
    f.add({f.edit(0, 1, "A")}, false);
    CHECK(f.apply() == "0123");
    CHECK(f.fix_count == 0);
}

TEST_CASE("a text with CRLF keeps its line ends") {
    EditedText f("ab\r\ncd\r\n");
    f.add({f.edit(1, 1, ";\n#")});
    CHECK(f.apply() == "a;\r\n#b\r\ncd\r\n");
    EditedText plain("ab\n");
    plain.add({plain.edit(1, 1, "\n")});
    CHECK(plain.apply() == "a\nb\n");
}

TEST_CASE("a fix that is not allowed does not exclude others at its place") {
    EditedText f("0123");
    f.add({f.edit(0, 2, "A")});
    f.add({f.edit(1, 3, "B")});
    const ChosenFixes chosen = choose_fixes(
        f.diagnostics, f.sources, FixChoice::Certain,
        [](const Diagnostic& diagnostic, const Fix&) { return diagnostic.span.begin != 0; });
    REQUIRE(chosen.fixes.size() == 1);
    CHECK(apply_edits("0123", chosen.edits.at("a.lsys")) == "0B3");
}

TEST_CASE("only the first fifty fixes are listed") {
    GrammarText text{"#n = 1;\n#w : F;\n", Dialect::Lsys};
    for (int i = 0; i < 60; ++i) {
        text.bytes += "p" + std::to_string(i) + " : F(x) : x > " + std::to_string(i) + " : F;\n";
    }
    const Project project{make_file_host(nullptr), {}, 1, {}};
    const FixScope scope("a.lsys", {});
    FixedGrammar fixed;
    REQUIRE(fix_text("a.lsys", text, {}, scope, project, FixChoice::Certain, fixed));
    CHECK(fixed.fix_count == 60);
    CHECK(fixed.lines.size() == kMaxFixLines);
    CHECK(fixed.lines.front() == "a.lsys:3:1: fixed: write `#p0` [missing-hash]");
    CHECK(fixed.changed.at("a.lsys").find("\n#p59 : F(x)") != std::string::npos);
    CHECK(!fixed.compiled.diagnostics.has_errors());
}

TEST_CASE("after repairs, no further fix is certain") {
    const GrammarText text{"#n = 1;\n#w : F(1))\n#p : F(x) : x = 1 : F(0x1);\n", Dialect::Lsys};
    const Project project{make_file_host(nullptr), {}, 1, {}};
    const FixScope scope("a.lsys", {});
    FixedGrammar fixed;
    REQUIRE(fix_text("a.lsys", text, {}, scope, project, FixChoice::Certain, fixed));
    for (const Diagnostic& diagnostic : fixed.compiled.diagnostics.all()) {
        CHECK(!has_certain_fix(diagnostic));
    }
    Result<CompiledText> compiled =
        compile_text("a.lsys", text, {}, kManyModules, make_loader(project, kMaxSourceBytes));
    REQUIRE(compiled);
    REQUIRE(offer_doubtful_fixes("a.lsys", text, {}, scope, project, compiled.value()));
    const std::vector<Diagnostic>& all = compiled.value().diagnostics.all();
    CHECK(std::count_if(all.begin(), all.end(), has_certain_fix) ==
          static_cast<std::ptrdiff_t>(fixed.fix_count));
}

TEST_CASE("offered repairs are applied on request, each once") {
    const GrammarText text{"#n = 1;\n#w : A(2);\n#p : A(x) : x > t : F(rand(x));\n", Dialect::Lsys};
    const Project project{make_file_host(nullptr), {}, 1, {}};
    const FixScope scope("a.lsys", {});
    FixedGrammar fixed;
    REQUIRE(fix_text("a.lsys", text, {}, scope, project, FixChoice::Certain, fixed));
    CHECK(fixed.fix_count == 0);
    REQUIRE(fix_text("a.lsys", text, {}, scope, project, FixChoice::Offered, fixed));
    CHECK(fixed.fix_count == 2);
    CHECK(fixed.changed.at("a.lsys") ==
          "#n = 1;\n#w : A(2);\n#p : A(x) : x > step() : F({0, 1});\n");
    CHECK(fixed.records.find("\"applied\":true") != std::string::npos);
}
