// SPDX-License-Identifier: MIT
// Inputs and outputs of every front end. Front ends read no files; the calling program supplies
// included files through FileLoader.
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

/// Returns the bytes of the file at a path; its Error is reported at the #include. For a path of
/// folder_list.h, returns the names of the files of a folder, sorted, one per line.
using FileLoader = std::function<Result<std::string>(const std::string& path)>;

/// Inputs and outputs of one parse. All references must outlive the parse.
struct ParseContext {
    SourceMap& sources;
    Names& names;
    Diagnostics& diagnostics;
    const FileLoader& load;
    /// Reproduce the bugs of the dialect's original program.
    bool bug_compatible = false;
    std::string_view system{}; // name of the system to read if a file has several
    /// Receives the spans of all statements, with and without errors; may be null.
    std::vector<SourceSpan>* statements = nullptr;
    std::string_view view{}; // path of the view file of a cpfg model; empty: found by its name
};

} // namespace lsys
