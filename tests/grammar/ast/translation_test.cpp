// SPDX-License-Identifier: MIT
// Translations: texts and places in the original.
#include "grammar/ast/translation.h"
#include "grammar/dialects/dialect.h"
#include "grammar/lsys/parse.h"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

namespace {

using namespace lsys;

struct Translated {
    explicit Translated(const std::vector<std::string>& parts, SourceSpan place) {
        const FileId file = sources.add("tree.foreign", "axiom F\n");
        Translation translation(file);
        for (const std::string& part : parts) {
            translation.put(part, {file, place.begin, place.end});
        }
        const FileLoader load = [](const std::string&) -> Result<std::string> {
            return Error{"no such file"};
        };
        ast = parse_translation(translation, {sources, names, diagnostics, load});
    }

    SourceMap sources;
    Names names;
    Diagnostics diagnostics;
    Ast ast;
};

} // namespace

TEST_CASE("a translation is parsed, whatever file its parts come from") {
    const std::vector<std::string> parts{
        "#set ", "names letters;", "\n#w : ", "F", ";\n#p1 : ", "F", " : * : FF;"};
    for (const SourceSpan place :
         {SourceSpan{kNoFile, 0, 1}, SourceSpan{kNoFile, 0, 0}, SourceSpan{kNoFile, 8, 8}}) {
        const Translated made(parts, place);
        CHECK(!made.diagnostics.has_errors());
        CHECK(!made.ast.incomplete);
        CHECK(made.ast.statements.size() == 3);
    }
}

TEST_CASE("an invalid translation is an error, whatever file its parts come from") {
    const std::vector<std::vector<std::string>> texts{
        {"#w : F", " : G;"},    {"#p1 : A", " : * : B", " : C;"}, {"#n = 3 4;"},
        {"#w : A(", ");", "]"}, {"#p : A : (1", " : B;"},
    };
    for (const std::vector<std::string>& parts : texts) {
        for (const SourceSpan place :
             {SourceSpan{kNoFile, 0, 1}, SourceSpan{kNoFile, 0, 0}, SourceSpan{kNoFile, 8, 8}}) {
            const Translated made(parts, place);
            INFO(parts.front());
            CHECK(made.diagnostics.has_errors());
        }
    }
}

TEST_CASE("a translation over the size limit is an error at the part that exceeds it") {
    SourceMap sources;
    const FileId file = sources.add("tree.foreign", "axiom F\n");
    Translation translation(file, 10);
    translation.put("#w : ", {file, 0, 5});
    translation.copy_as("FFFF", {file, 0, 4});
    translation.put("GG", {file, 6, 7});
    translation.put(";");
    translation.copy_as("FF", {file, 0, 2});
    // All parts from the first one that does not fit are omitted.
    CHECK(translation.text() == "#w : FFFF");
    CHECK(translation.origin(8, 20) == SourceSpan{file, 3, 4});
    Diagnostics diagnostics;
    REQUIRE(translation.report_overflow(diagnostics));
    REQUIRE(diagnostics.all().size() == 1);
    CHECK(diagnostics.all()[0].code == DiagnosticCode::ProgramTooLarge);
    CHECK(diagnostics.all()[0].span == SourceSpan{file, 6, 7});

    Translation fitting(file, 9);
    fitting.put("#w : ", {file, 0, 5});
    fitting.put("FFF;", {file, 0, 4});
    CHECK(!fitting.report_overflow(diagnostics));
}

TEST_CASE("modules of a translation stay in the file of their statement") {
    SourceMap sources;
    Names names;
    Diagnostics diagnostics;
    const FileId root = sources.add("root.foreign", "A B\n");
    const FileId other = sources.add("other.foreign", std::string(100, ' ') + "CD(1)");
    const FileLoader load = [](const std::string&) -> Result<std::string> {
        return Error{"no such file"};
    };
    Translation translation(root);
    translation.put("#set names letters;\n#w : ");
    translation.put("A", {root, 0, 1});
    translation.put("C", {other, 100, 101});
    translation.put("D(1)", {other, 101, 105});
    translation.put(";\n");
    translation.put("#p : ", {other, 100, 101});
    translation.put("A", {other, 100, 101});
    translation.put(" : * : B", {root, 2, 3});
    translation.put(";\n");
    const ParseContext context{sources, names, diagnostics, load};
    const Ast ast = parse_translation(translation, context);
    CHECK(!diagnostics.has_errors());
    REQUIRE(ast.files.size() == 2);
    CHECK(ast.files[1].file == other);
    const auto spans = [&](ModuleList list) {
        std::vector<SourceSpan> found;
        for (ModuleCursor at(ast, names, sources, list); !at.done(); at.next()) {
            found.push_back(at.view().name_span);
        }
        return found;
    };
    const SourceSpan a{root, 0, 1};
    CHECK(spans(ast.axioms[0].modules) == std::vector{a, a, a});
    const SourceSpan c{other, 100, 101};
    CHECK(spans(ast.productions[0].successor) == std::vector{c});
}

TEST_CASE("a choice among productions of cpfg needs a bounded count of random numbers") {
    // If several cpfg productions rewrite a module, the module has the random numbers of all these
    // productions as parameters.
    const auto errors_of = [](int count, const std::string& weight) {
        std::string text = "Lsystem: 1\nseed: 1\nderivation length: 1\nAxiom: A\n";
        for (int i = 0; i < count; ++i) {
            text += "A : ran(1) > 0.5 { x = ran(1); } --> B(x) : " + weight + "\n";
        }
        SourceMap sources;
        Names names;
        Diagnostics diagnostics;
        const FileLoader load = [](const std::string&) -> Result<std::string> {
            return Error{"no such file"};
        };
        const FileId root = sources.add("many.l", text + "endlsystem\n");
        static_cast<void>(parse_dialect(root, Dialect::Cpfg, {sources, names, diagnostics, load}));
        std::string messages;
        for (const Diagnostic& diagnostic : diagnostics.all()) {
            messages += diagnostic.message + "\n";
        }
        return messages;
    };
    CHECK(errors_of(20, "3") == "");
    CHECK(errors_of(3000, "3").find("more than 1000 random numbers") != std::string::npos);
    const std::string weight = "3" + std::string(200, '0');
    CHECK(errors_of(300, weight).find("the sum of their weights is too long") != std::string::npos);
}
