// Texts of translations, and places in the original.
#include "grammar/ast/translation.h"
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

TEST_CASE("a translation is parsed wherever its parts stand") {
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

TEST_CASE("a translation that is no grammar is an error wherever its parts stand") {
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
