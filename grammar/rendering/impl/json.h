// A diagnostic as a JSON object, for editors and other tools. Byte offsets are those of the file on
// disk, a byte order mark included, so that edits can be applied to it as it is.
#pragma once

#include "grammar/base/diagnostic.h"
#include "grammar/base/source.h"

#include <cstdint>
#include <string>

namespace lsys::rendering {

/// Appends one line.
void append_json(const Diagnostic& diagnostic, const SourceMap& sources, std::string& out);

/// Appends one line that says how many more there are.
void append_json_rest(std::uint64_t errors,
                      std::uint64_t warnings,
                      std::uint64_t notes,
                      std::string& out);

} // namespace lsys::rendering
