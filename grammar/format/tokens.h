// The tokens of one file as text: `lsc dump --stage tokens`. Place, kind and text of each, comments
// included.
#pragma once

#include "grammar/base/source.h"

#include <string>

namespace lsys {

[[nodiscard]] std::string dump_tokens(const SourceFile& file);

} // namespace lsys
