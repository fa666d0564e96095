// SPDX-License-Identifier: MIT
// Completions of shells: scripts that offer commands, options, values and files.
#pragma once

#include "packaging/pages/command_text.h"

#include <string>

namespace lsys::pages {

/// For bash 4 and later; needs no bash-completion.
[[nodiscard]] std::string bash_completion(const ProgramText& program);
/// For zsh: the file `_PROGRAM` of a folder of $fpath.
[[nodiscard]] std::string zsh_completion(const ProgramText& program);
[[nodiscard]] std::string fish_completion(const ProgramText& program);

/// A description as one short sentence: the text up to the first `;` or `:` outside of backquotes,
/// without backquotes.
[[nodiscard]] std::string short_text(const std::string& description);

/// A regular expression for names that end in one of the extensions; empty for any name.
[[nodiscard]] std::string name_pattern(const std::vector<std::string>& extensions);

} // namespace lsys::pages
