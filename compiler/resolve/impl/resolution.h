// SPDX-License-Identifier: MIT
// The state shared by all parts of the resolution (Ast to Program). One per compilation, owned by
// resolve().
#pragma once

#include "compiler/program/compile_options.h"
#include "compiler/program/message_words.h"
#include "compiler/program/program.h"
#include "grammar/ast/ast.h"
#include "grammar/base/diagnostic.h"
#include "grammar/base/names.h"
#include "grammar/base/source.h"
#include "grammar/base/suggestions.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

struct Resolution {
    Ast& ast; // modules are released when consumed
    Names& names;
    const SourceMap& sources;
    const CompileOptions& options;
    Diagnostics& diagnostics;
    Program& program;
    std::vector<FileId> letter_files; // files with `names letters` or `names characters`

    [[nodiscard]] std::string_view text(NameId name) const { return names.text(name); }
};

[[nodiscard]] constexpr std::size_t index_of(NameId name) {
    return static_cast<std::size_t>(name);
}

/// Adds "did you mean `name`?" to a message, with a fix that is not machine-applicable.
void suggest(Diagnostic& diagnostic, SourceSpan span, std::string_view name);

} // namespace lsys
