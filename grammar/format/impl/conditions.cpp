// SPDX-License-Identifier: MIT
#include "grammar/format/impl/conditions.h"

#include "grammar/format/impl/lines.h"

#include <algorithm>
#include <string>

namespace lsys {

namespace {

constexpr std::uint32_t kOperandDepth = 1;

enum class Role : std::uint8_t { Other, Or, And, Weight };

/// A piece of a condition.
struct Part {
    Role role = Role::Other;
    std::uint32_t width = 0; // with the blank before it
};

Role role_of(const Piece& piece) {
    return piece.text == "||"   ? Role::Or
           : piece.text == "&&" ? Role::And
           : piece.text == "~"  ? Role::Weight
                                : Role::Other;
}

bool has(const std::vector<Part>& parts, Role role) {
    return std::any_of(parts.begin(), parts.end(),
                       [role](const Part& part) { return part.role == role; });
}

} // namespace

ConditionLines::ConditionLines(std::string_view text, std::size_t begin, std::uint32_t column) {
    PieceReader reader(text, begin);
    if (reader.shape() != StatementShape::Production) {
        return;
    }
    std::vector<Part> parts; // of the condition and the colon behind it
    std::uint32_t colons = 0;
    std::uint32_t end_column = column;
    std::size_t index = 0;
    bool has_locals = false;
    Piece piece;
    for (; reader.next(piece); ++index) {
        if (colons == 3) {
            has_locals = piece.text == "let" && !piece.is_in_list;
            break;
        }
        if (piece.has_several_lines) {
            return;
        }
        const std::uint32_t width = piece.width + (piece.has_blank_before ? 1U : 0U);
        end_column += width;
        if (colons == 2) {
            parts.push_back({role_of(piece), width});
        }
        if (piece.begins_cell) {
            ++colons;
            first_ = colons == 2 ? index + 1 : first_;
        }
    }
    const bool has_or = has(parts, Role::Or);
    if (end_column <= kColumns || colons < 3 || !(has_or || has(parts, Role::And))) {
        return;
    }
    const Role loosest = has_or ? Role::Or : Role::And;
    places_.assign(parts.size(), {false, kOperandDepth + 1});
    const std::uint32_t indent = line_indent(kOperandDepth);
    for (std::size_t at = 0; at < parts.size();) {
        std::size_t end = at + 1;
        std::uint32_t width = indent + parts[at].width - 1; // without the blank before it
        while (end < parts.size() && parts[end].role != loosest &&
               parts[end].role != Role::Weight) {
            width += parts[end].width;
            ++end;
        }
        places_[at] = {true, kOperandDepth};
        for (std::size_t i = at + 1; width > kColumns && i < end; ++i) {
            const bool begins_line = parts[i].role == Role::And;
            places_[i] = {begins_line, kOperandDepth + (begins_line ? 1U : 2U)};
        }
        at = end;
    }
    if (has_locals) {
        places_.push_back({true, 0});
    }
}

void ConditionLines::place(std::size_t index, Piece& piece) const {
    if (index >= first_ && index - first_ < places_.size()) {
        piece.begins_line = piece.begins_line || places_[index - first_].begins_line;
        piece.depth = places_[index - first_].depth;
    }
}

} // namespace lsys
