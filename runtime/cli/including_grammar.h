// SPDX-License-Identifier: MIT
// Finds a grammar that includes a file. If there is one, the file is only a part of a grammar.
#pragma once

#include <optional>
#include <string>

namespace lsys::lsc {

/// The path of the first .lsys file, in order of names, that includes `path`. Searches the folder
/// of `path` and the folder above. Unreadable and large files are skipped.
[[nodiscard]] std::optional<std::string> find_including_grammar(const std::string& path);

} // namespace lsys::lsc
