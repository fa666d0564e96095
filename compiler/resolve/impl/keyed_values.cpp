// SPDX-License-Identifier: MIT
#include "compiler/resolve/impl/keyed_values.h"

#include "grammar/base/counted_text.h"
#include "grammar/base/paths.h"

#include <fmt/format.h>

namespace lsys {

void report_bare_constant(Resolution& resolution, DiagnosticCode code, const SetValue& word) {
    const std::string_view name = resolution.text(word.word);
    Diagnostic& error = resolution.diagnostics.add(
        code, word.span, fmt::format("a constant is in parentheses here: `({})`", name));
    add_fix(error, fmt::format("write `({})`", name), word.span, fmt::format("({})", name), true);
}

Diagnostic& report_value_count(Resolution& resolution,
                               DiagnosticCode code,
                               const KeyedValues& key,
                               std::string_view wanted) {
    const std::string_view name = resolution.text(key.key);
    return resolution.diagnostics.add(code, key.span,
                                      key.values.count == 0
                                          ? fmt::format("`{}` takes {}", name, wanted)
                                          : fmt::format("`{}` takes {}; found {}", name, wanted,
                                                        counted(key.values.count, "value")));
}

std::string path_from_root(const Resolution& resolution, const SetValue& file) {
    std::string name(resolution.text(file.word));
    const FileId root = resolution.ast.files[0].file;
    const auto folder_of = [&](FileId id) {
        return std::string(folder_of_path(resolution.sources.file(id).path()));
    };
    if (is_absolute_path(name) || file.span.file == root) {
        return name;
    }
    const std::string folder = folder_of(file.span.file);
    const std::string root_folder = folder_of(root);
    return folder.starts_with(root_folder) ? folder.substr(root_folder.size()) + name
                                           : folder + name;
}

} // namespace lsys
