// SPDX-License-Identifier: MIT
// A diagnostic as a JSON object, for editors and other tools. Byte offsets count from the
// start of the file on disk, including a byte order mark, so that edits apply to it directly.
#pragma once

#include "grammar/base/diagnostic.h"
#include "grammar/base/source.h"

#include <cstdint>
#include <string>

namespace lsys::rendering {

/// Appends the diagnostic as one line.
void append_json(const Diagnostic& diagnostic, const SourceMap& sources, std::string& out);

/// Appends one line with the counts of the diagnostics that have no line of their own.
void append_json_omitted(std::uint64_t errors,
                         std::uint64_t warnings,
                         std::uint64_t notes,
                         std::string& out);

} // namespace lsys::rendering
