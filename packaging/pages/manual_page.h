// SPDX-License-Identifier: MIT
// Man pages in the language of man(7), from the texts of --help.
#pragma once

#include "packaging/pages/command_text.h"

#include <string>
#include <utility>
#include <vector>

namespace lsys::pages {

struct PageInfo {
    std::string date;    // 2026-11-25
    std::string version; // 0.1.0
    /// Numbers and meanings of the exit status.
    std::vector<std::pair<std::string, std::string>> statuses;
    std::vector<std::string> see_also; // names of pages of section 1
};

/// The page of a program: NAME.1.
[[nodiscard]] std::string program_page(const ProgramText& program, const PageInfo& info);
/// The page of a command: PROGRAM-COMMAND.1.
[[nodiscard]] std::string
command_page(const std::string& program, const CommandText& command, const PageInfo& info);

} // namespace lsys::pages
