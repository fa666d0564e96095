// What all parts of the resolution (Ast to Program) work on. One per compilation; made and owned by
// resolve().
#pragma once

#include "compiler/program/compile_options.h"
#include "compiler/program/message_words.h"
#include "compiler/program/program.h"
#include "grammar/ast/ast.h"
#include "grammar/base/diagnostic.h"
#include "grammar/base/names.h"
#include "grammar/base/source.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

struct Resolution {
    Ast& ast; // its modules are released as they are consumed
    Names& names;
    const SourceMap& sources;
    const CompileOptions& options;
    Diagnostics& diagnostics;
    Program& program;
    std::vector<FileId> letter_files; // those with `names letters`

    [[nodiscard]] std::string_view text(NameId name) const { return names.text(name); }
};

[[nodiscard]] constexpr std::size_t index_of(NameId name) {
    return static_cast<std::size_t>(name);
}

/// Finds the nearest of some names for a name that is unknown, and stops looking when a file of a
/// million mistakes has used up its share of work.
class Suggestions {
public:
    /// The nearest candidate that is near enough, or an empty string.
    [[nodiscard]] std::string nearest(std::string_view wanted,
                                      const std::vector<std::string_view>& candidates);
    /// Whether comparing with `count` more candidates is still worth it.
    [[nodiscard]] bool may_compare(std::size_t count) const { return count <= work_left_; }

private:
    std::size_t work_left_ = 4'000'000;
};

/// Adds "did you mean `name`?" to a message, with a repair that an author should look at first.
void suggest(Diagnostic& diagnostic, SourceSpan span, std::string_view name);

} // namespace lsys
