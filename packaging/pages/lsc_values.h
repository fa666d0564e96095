// SPDX-License-Identifier: MIT
// The command line of lsc as data, with words and extensions for completion.
#pragma once

#include "packaging/pages/command_text.h"

#include <string_view>

namespace lsys::pages {

[[nodiscard]] ProgramText describe_lsc();
/// Adds the words and extensions of an option of `lsc COMMAND`.
void add_lsc_values(std::string_view command, OptionText& option);

} // namespace lsys::pages
