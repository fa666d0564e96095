// SPDX-License-Identifier: MIT
// A grammar parsed from strings, for tests of the front end.
#pragma once

#include "grammar/lsys/parse.h"

#include <map>
#include <string>
#include <utility>

namespace lsys {

/// Parses the file "main.lsys", and other files that it may include.
class Parsed {
public:
    explicit Parsed(std::string text, std::map<std::string, std::string> files = {})
        : files_(std::move(files)) {
        const FileId root = sources.add("main.lsys", std::move(text));
        const FileLoader load = [this](const std::string& path) -> Result<std::string> {
            const auto found = files_.find(path);
            if (found == files_.end()) {
                return Error{"no such file"};
            }
            return found->second;
        };
        const ParseContext context{sources, names, diagnostics, load};
        ast = parse_lsys(root, context);
    }

    /// "line:column code" of all diagnostics in order of place, separated by ", ".
    [[nodiscard]] std::string codes() {
        diagnostics.sort_by_place();
        std::string out;
        for (const Diagnostic& diagnostic : diagnostics.all()) {
            const LineColumn place =
                sources.file(diagnostic.span.file).line_column(diagnostic.span.begin);
            out += out.empty() ? "" : ", ";
            out += std::to_string(place.line) + ":" + std::to_string(place.column) + " " +
                   std::string(info(diagnostic.code).name);
        }
        return out;
    }

    /// The file after all machine-applicable fixes are applied.
    [[nodiscard]] std::string fixed() {
        diagnostics.sort_by_place();
        std::map<std::uint32_t, Edit> edits; // by place
        for (const Diagnostic& diagnostic : diagnostics.all()) {
            for (const Fix& fix : diagnostic.fixes) {
                for (const Edit& edit : fix.edits) {
                    if (fix.machine_applicable) {
                        edits.emplace(edit.span.begin, edit);
                    }
                }
            }
        }
        const std::string_view text = sources.file(FileId{0}).text();
        std::string out;
        std::uint32_t taken = 0;
        for (const auto& [begin, edit] : edits) {
            out.append(text.substr(taken, begin - taken));
            out += edit.replacement;
            taken = edit.span.end;
        }
        return out.append(text.substr(taken));
    }

    SourceMap sources;
    Names names;
    Diagnostics diagnostics;
    Ast ast;

private:
    std::map<std::string, std::string> files_;
};

} // namespace lsys
