// SPDX-License-Identifier: MIT
// Parses and compiles grammars from text, for tests of diagnostics and their places.
#pragma once

#include "compiler/compile.h"
#include "compiler/program/program_dump.h"
#include "grammar/lsys/parse.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace lsys::test {

struct Compiled {
    SourceMap sources;
    Names names;
    Diagnostics diagnostics;
    CompileOutcome outcome;

    /// "code line:column" of every diagnostic, in order of place.
    [[nodiscard]] std::vector<std::string> reports() const {
        std::vector<std::string> result;
        for (const Diagnostic& d : diagnostics.all()) {
            const LineColumn at = sources.file(d.span.file).line_column(d.span.begin);
            result.push_back(std::string(info(d.code).name) + " " + std::to_string(at.line) + ":" +
                             std::to_string(at.column));
        }
        return result;
    }
    /// "code line:column" of every error, in order of place.
    [[nodiscard]] std::vector<std::string> errors() const {
        std::vector<std::string> result = reports();
        for (std::size_t i = result.size(); i-- > 0;) {
            if (diagnostics.all()[i].severity != Severity::Error) {
                result.erase(result.begin() + static_cast<std::ptrdiff_t>(i));
            }
        }
        return result;
    }
    /// The first diagnostic with this code, or null.
    [[nodiscard]] const Diagnostic* find(DiagnosticCode code) const {
        for (const Diagnostic& d : diagnostics.all()) {
            if (d.code == code) {
                return &d;
            }
        }
        return nullptr;
    }
    /// The text that the span of the first diagnostic with this code covers.
    [[nodiscard]] std::string at(DiagnosticCode code) const {
        const Diagnostic* found = find(code);
        return found == nullptr ? "nothing" : std::string(sources.text(found->span));
    }
    [[nodiscard]] std::string message(DiagnosticCode code) const {
        const Diagnostic* found = find(code);
        return found == nullptr ? "nothing" : found->message;
    }
    [[nodiscard]] std::string dump() const {
        return outcome.program ? dump_program(*outcome.program, names) : "no program";
    }
    /// The root file after the first fix of the first diagnostic with this code is applied.
    [[nodiscard]] std::string fixed(DiagnosticCode code) const {
        const Diagnostic* found = find(code);
        std::string text(sources.file(FileId{0}).text());
        if (found == nullptr || found->fixes.empty()) {
            return text;
        }
        std::vector<Edit> edits = found->fixes[0].edits;
        std::sort(edits.begin(), edits.end(),
                  [](const Edit& a, const Edit& b) { return a.span.begin > b.span.begin; });
        for (const Edit& edit : edits) {
            text.replace(edit.span.begin, edit.span.end - edit.span.begin, edit.replacement);
        }
        return text;
    }
};

/// Compiles files["main.lsys"], which may include the other files. If `options.generations` is not
/// set, there are 4 generations, so that the grammar needs no `#n`.
inline Compiled compile_files(const std::map<std::string, std::string>& files,
                              CompileOptions options) {
    Compiled compiled;
    if (!options.generations) {
        options.generations = 4;
    }
    const FileId root = compiled.sources.add("main.lsys", files.at("main.lsys"));
    const FileLoader load = [&](const std::string& path) -> Result<std::string> {
        const auto found = files.find(path);
        if (found == files.end()) {
            return Error{"no such file"};
        }
        return found->second;
    };
    Ast ast = parse_lsys(root, {compiled.sources, compiled.names, compiled.diagnostics, load});
    compiled.outcome =
        compile(std::move(ast), compiled.names, compiled.sources, options, compiled.diagnostics);
    compiled.diagnostics.sort_by_place();
    return compiled;
}

inline Compiled compile_text(const std::string& text, CompileOptions options = {}) {
    return compile_files({{"main.lsys", text}}, std::move(options));
}

} // namespace lsys::test
