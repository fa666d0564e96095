// SPDX-License-Identifier: MIT
#include "tests/reference/compile_case.h"

#include "compiler/compile.h"
#include "grammar/lsys/parse.h"
#include "grammar/rendering/render_diagnostic.h"
#include "tests/reference/print.h"

#include <filesystem>
#include <map>
#include <utility>
#include <vector>

namespace lsys::reference {

std::optional<Bytecode> compile_case(const Case& test_case, std::string& messages) {
    std::map<std::string, std::string> texts;
    const std::vector<TextFile> files = print_grammar(test_case.grammar, test_case.layout_seed);
    for (const TextFile& file : files) {
        texts[file.path] = file.text;
    }
    const FileLoader load = [&](const std::string& path) -> lsys::Result<std::string> {
        const auto found =
            texts.find(std::filesystem::path(path).lexically_normal().generic_string());
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
    for (const auto& [name, value] : test_case.request.definitions) {
        options.definitions.push_back({name, value});
    }
    Ast ast = parse_lsys(root, ParseContext{sources, names, diagnostics, load});
    std::optional<Bytecode> bytecode =
        compile(std::move(ast), names, sources, options, diagnostics).bytecode;
    render_all(diagnostics, sources, {.format = MessageFormat::Human}, messages);
    return bytecode;
}

} // namespace lsys::reference
