// Random grammars through every way the runtime can cut a derivation into pieces: threads, chunks
// of a few modules, streaming. The words of the oracle are small, so `lsc` itself never cuts them.

#include "compiler/compile.h"
#include "grammar/parse.h"
#include "grammar/render_diagnostic.h"
#include "tests/reference/generate.h"
#include "tests/reference/print.h"
#include "tests/support/derived.h"

#include <catch2/catch.hpp>

#include <filesystem>
#include <map>
#include <optional>

namespace lsys::reference {

namespace {

// Compiles a case from memory. `messages` gets what the compiler says.
std::optional<Bytecode> compiled(const Case& made, std::string& messages) {
    std::map<std::string, std::string> texts;
    const std::vector<TextFile> files = print_grammar(made.grammar, made.layout_seed);
    for (const TextFile& file : files) {
        texts[file.path] = file.text;
    }
    const FileLoader load = [&](const std::string& path) -> lsys::Result<std::string> {
        const auto found = texts.find(std::filesystem::path(path).lexically_normal().string());
        if (found == texts.end()) {
            return lsys::Error{"no such file"};
        }
        return found->second;
    };
    SourceMap sources;
    Names names;
    Diagnostics diagnostics;
    const FileId root = sources.add(files[0].path, files[0].text);
    CompileOptions options;
    for (const auto& [name, value] : made.request.definitions) {
        options.definitions.push_back({name, value});
    }
    Ast ast = parse_lsys(root, ParseContext{sources, names, diagnostics, load});
    std::optional<Bytecode> bytecode =
        compile(std::move(ast), names, sources, options, diagnostics).bytecode;
    render_all(diagnostics, sources, {.format = MessageFormat::Human}, messages);
    return bytecode;
}

} // namespace

TEST_CASE("random grammars give the same word in pieces of any size") {
    for (std::uint64_t seed = 2001; seed <= 2300; ++seed) {
        const Case made = generate(seed);
        const Derivation derivation = derive(made.grammar, made.request);
        std::string messages;
        const std::optional<Bytecode> bytecode = compiled(made, messages);
        INFO("seed " << seed << "\n" << messages);
        REQUIRE(bytecode);
        if (!derivation.error) {
            const std::string word =
                print_word(derivation.words.back(), made.grammar.files[0].letters);
            CHECK(test::derived_every_way(*bytecode, derivation.generations, derivation.seed) ==
                  word);
        } else if (derivation.error->failure != Failure::UnmatchedBracket) {
            const RuntimeError error =
                test::error_every_way(*bytecode, derivation.generations, derivation.seed);
            CHECK(error.position == derivation.error->position);
            CHECK(error.generation == derivation.error->generation);
            CHECK(error.parameters == derivation.error->module.values);
            CHECK(bytecode->productions[static_cast<std::size_t>(error.production)].name ==
                  derivation.error->production);
        }
    }
}

} // namespace lsys::reference
