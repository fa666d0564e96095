// SPDX-License-Identifier: MIT
// Writes the man pages and the completions of a program into folders as they are installed:
// man/NAME.1, bash/NAME, zsh/_NAME, fish/NAME.fish.
#pragma once

#include "packaging/pages/command_text.h"
#include "packaging/pages/manual_page.h"

namespace lsys::pages {

/// The main() of a writer. Arguments: the folder, the date, the version.
[[nodiscard]] int write_pages(int argc, char** argv, const ProgramText& program, PageInfo info);

/// Adds words and extensions of options that several programs have: codes of messages, grammar
/// files, pictures.
void add_common_values(OptionText& option);
/// Extensions of grammars in any dialect.
[[nodiscard]] std::vector<std::string> grammar_extensions();

} // namespace lsys::pages
