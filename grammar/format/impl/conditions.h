// SPDX-License-Identifier: MIT
// The lines of a condition that is too long for the line of its production: each operand of its
// loosest operator, `||` or else `&&`, is a line. The lines depend on the tokens alone, so
// formatting again changes nothing.
#pragma once

#include "grammar/format/impl/pieces.h"

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace lsys {

class ConditionLines {
public:
    /// The lines of the condition of the production that begins at byte `begin`, in column
    /// `column`. None if the condition ends within kColumns, holds a comment of several lines, or
    /// has neither `||` nor `&&` outside of parentheses.
    ConditionLines(std::string_view text, std::size_t begin, std::uint32_t column);
    /// No lines.
    ConditionLines() = default;

    /// Lets piece number `index` of the production begin a line if it begins a line of the
    /// condition or the local values behind it.
    void place(std::size_t index, Piece& piece) const;

private:
    struct Place {
        bool begins_line = false;
        std::uint32_t depth = 0; // levels of indentation beyond that of the successor
    };

    std::size_t first_ = 0; // number of the first piece of the condition
    std::vector<Place> places_;
};

} // namespace lsys
