// SPDX-License-Identifier: MIT
// The command line of lsc as data, with words and extensions for completion.
#pragma once

#include "packaging/pages/command_text.h"

namespace lsys::pages {

[[nodiscard]] ProgramText describe_lsc();

} // namespace lsys::pages
