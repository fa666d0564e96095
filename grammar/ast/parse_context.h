// The inputs and outputs that every front end shares. Front ends read no files themselves: the host
// supplies included files through FileLoader.
#pragma once

#include "grammar/base/diagnostic.h"
#include "grammar/base/names.h"
#include "grammar/base/result.h"
#include "grammar/base/source.h"

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
    /// Reproduce the bugs of the dialect's original program.
    bool bug_compatible = false;
    std::string_view system{}; // the one to read, of a file that holds several
    /// Collects the place of every statement, of those with errors too; may be null.
    std::vector<SourceSpan>* statements = nullptr;
};

} // namespace lsys
