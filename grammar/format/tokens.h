// SPDX-License-Identifier: MIT
// The tokens of a file as text, for `lsc dump --stage tokens`: place, kind and text of each token
// and comment.
#pragma once

#include "grammar/base/source.h"

#include <string>

namespace lsys {

[[nodiscard]] std::string dump_tokens(const SourceFile& file);

} // namespace lsys
