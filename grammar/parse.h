// The entry of the front ends: text to Ast. Reads no files itself: included ones come from the host
// through `FileLoader`.
#pragma once

#include "grammar/ast.h"
#include "grammar/diagnostic.h"
#include "grammar/names.h"
#include "grammar/result.h"
#include "grammar/source.h"
#include "grammar/translation.h"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

/// The bytes of a file by path; its Error is shown at the #include.
using FileLoader = std::function<Result<std::string>(const std::string& path)>;

/// What one parse works with; all outlive it.
struct ParseContext {
    SourceMap& sources;
    Names& names;
    Diagnostics& diagnostics;
    const FileLoader& load;
    /// Of dialects whose program has bugs: they are kept.
    bool bug_compatible = false;
    std::string_view system{}; // of a file that holds several, the one that is read
    /// Collects the place of every statement, of those with errors too; may be null.
    std::vector<SourceSpan>* statements = nullptr;
};

/// Parses the .lsys file `root` and, in place, the files it includes. Always yields an Ast; after
/// errors it holds the statements that parsed.
[[nodiscard]] Ast parse_lsys(FileId root, const ParseContext& context);

/// Parses the text of a translation as if it stood in the original, where all places are shown.
[[nodiscard]] Ast parse_translation(const Translation& translation, const ParseContext& context);

} // namespace lsys
