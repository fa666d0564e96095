#include "runtime/cli/fixes.h"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

using namespace lsys;
using namespace lsys::lsc;

namespace {

struct Fixture {
    SourceMap sources;
    FileId file;
    Diagnostics diagnostics;
    FixedGrammar fixed;

    explicit Fixture(std::string text) : file(sources.add("a.lsys", std::move(text))) {}

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
        const FileEdits edits = choose_edits(diagnostics, sources, FixScope("a.lsys", {}), fixed);
        const auto found = edits.find("a.lsys");
        return apply_edits(sources.file(file).text(),
                           found == edits.end() ? std::vector<const Edit*>() : found->second);
    }
};

} // namespace

TEST_CASE("fixes are applied in any order of discovery") {
    Fixture f("0123456789");
    f.add({f.edit(7, 8, "seven")});
    f.add({f.edit(2, 4, ""), f.edit(0, 0, "<")});
    CHECK(f.apply() == "<01456seven89");
    CHECK(f.fixed.fix_count == 2);
    CHECK(f.fixed.lines.front() == "a.lsys:1:8: fixed: mend [look-alike]");
}

TEST_CASE("of fixes that touch each other the first wins") {
    Fixture overlap("0123456789");
    overlap.add({overlap.edit(2, 6, "A")});
    overlap.add({overlap.edit(5, 7, "B")});
    overlap.add({overlap.edit(0, 3, "C")});
    overlap.add({overlap.edit(3, 3, "D")});
    overlap.add({overlap.edit(6, 7, "E")});
    CHECK(overlap.apply() == "01AE789");
    Fixture same("01");
    same.add({same.edit(1, 1, "A")});
    same.add({same.edit(1, 1, "B")});
    same.add({same.edit(0, 2, "C")});
    same.add({same.edit(1, 2, "D")});
    CHECK(same.apply() == "0A1");
    Fixture whole("0123");
    whole.add({whole.edit(0, 1, "A"), whole.edit(3, 4, "B")});
    whole.add({whole.edit(1, 2, "C"), whole.edit(3, 4, "D")});
    CHECK(whole.apply() == "A12B");
}

TEST_CASE("fixes that are not certain are left alone") {
    Fixture f("0123");
    f.add({f.edit(0, 1, "A")}, false);
    CHECK(f.apply() == "0123");
    CHECK(f.fixed.fix_count == 0);
}

TEST_CASE("a text with CRLF keeps it") {
    Fixture f("ab\r\ncd\r\n");
    f.add({f.edit(1, 1, ";\n#")});
    CHECK(f.apply() == "a;\r\n#b\r\ncd\r\n");
    Fixture plain("ab\n");
    plain.add({plain.edit(1, 1, "\n")});
    CHECK(plain.apply() == "a\nb\n");
}

TEST_CASE("only the first fifty fixes are told one by one") {
    Fixture f(std::string(1000, 'x'));
    for (std::uint32_t i = 0; i < 1000; ++i) {
        f.add({f.edit(i, i + 1, "y")});
    }
    CHECK(f.apply() == std::string(1000, 'y'));
    CHECK(f.fixed.fix_count == 1000);
    CHECK(f.fixed.lines.size() == kMaxFixLines);
}
