// SPDX-License-Identifier: MIT
// The L-systems of a cpfg file: the first is the main one, the others are sub-L-systems, or
// alternatives of the author.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

/// One L-system, from its line `Lsystem: name` to the next such line.
struct CpfgSystem {
    std::string name;      // the text after `Lsystem:`
    std::size_t begin = 0; // byte offset in the text
    std::size_t end = 0;
};

/// The L-systems of a text, in order.
[[nodiscard]] std::vector<CpfgSystem> cpfg_systems(std::string_view text);

} // namespace lsys
