// SPDX-License-Identifier: MIT
#include "runtime/cli/unified_diff.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace lsys::lsc {

namespace {

constexpr std::size_t kContext = 3; // equal lines shown before and after a difference
/// Max size of the table of common lines, in entries. Larger differences are shown as one
/// replacement.
constexpr std::size_t kMaxTable = std::size_t{1} << 24;

/// The lines of a text with their line ends. The last line may have no line end.
std::vector<std::string_view> lines_of(std::string_view text) {
    std::vector<std::string_view> lines;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size() - 1) + 1;
        lines.push_back(text.substr(at, end - at));
        at = end;
    }
    return lines;
}

enum class Side : std::uint8_t { Both, Before, After };

/// A line of the result, and which of the texts contain it.
struct DiffLine {
    Side side = Side::Both;
    std::string_view text;
};

/// Appends the lines of two texts whose common first and last lines have been removed.
void append_middle(const std::vector<std::string_view>& before,
                   const std::vector<std::string_view>& after,
                   std::vector<DiffLine>& out) {
    const std::size_t rows = before.size();
    const std::size_t columns = after.size();
    std::size_t i = 0;
    std::size_t j = 0;
    if (rows != 0 && columns != 0 && rows <= kMaxTable / columns) {
        // common[i][j]: length of the longest common subsequence of before[i...] and after[j...].
        std::vector<std::uint32_t> common((rows + 1) * (columns + 1));
        const auto at = [&](std::size_t row, std::size_t column) -> std::uint32_t& {
            return common[row * (columns + 1) + column];
        };
        for (std::size_t row = rows; row-- > 0;) {
            for (std::size_t column = columns; column-- > 0;) {
                at(row, column) = before[row] == after[column]
                                      ? at(row + 1, column + 1) + 1
                                      : std::max(at(row + 1, column), at(row, column + 1));
            }
        }
        while (i < rows && j < columns) {
            if (before[i] == after[j]) {
                out.push_back({Side::Both, before[i]});
                ++i;
                ++j;
            } else if (at(i + 1, j) >= at(i, j + 1)) {
                out.push_back({Side::Before, before[i++]});
            } else {
                out.push_back({Side::After, after[j++]});
            }
        }
    }
    for (; i < rows; ++i) {
        out.push_back({Side::Before, before[i]});
    }
    for (; j < columns; ++j) {
        out.push_back({Side::After, after[j]});
    }
}

std::vector<DiffLine> compare(std::string_view before, std::string_view after) {
    std::vector<std::string_view> old_lines = lines_of(before);
    std::vector<std::string_view> new_lines = lines_of(after);
    const std::size_t shorter = std::min(old_lines.size(), new_lines.size());
    std::size_t head = 0;
    while (head < shorter && old_lines[head] == new_lines[head]) {
        ++head;
    }
    std::size_t tail = 0;
    while (tail < shorter - head &&
           old_lines[old_lines.size() - 1 - tail] == new_lines[new_lines.size() - 1 - tail]) {
        ++tail;
    }
    std::vector<DiffLine> lines;
    for (std::size_t i = 0; i < head; ++i) {
        lines.push_back({Side::Both, old_lines[i]});
    }
    const auto middle = [&](const std::vector<std::string_view>& all) {
        return std::vector<std::string_view>(all.begin() + static_cast<std::ptrdiff_t>(head),
                                             all.end() - static_cast<std::ptrdiff_t>(tail));
    };
    append_middle(middle(old_lines), middle(new_lines), lines);
    for (std::size_t i = old_lines.size() - tail; i < old_lines.size(); ++i) {
        lines.push_back({Side::Both, old_lines[i]});
    }
    return lines;
}

/// A range as in the head of a hunk, `3,2`: first line and number of lines. An empty range names
/// the line before it.
std::string range_text(std::size_t first, std::size_t count) {
    return count == 1 ? std::to_string(first + 1)
                      : fmt::format("{},{}", first + (count == 0 ? 0 : 1), count);
}

} // namespace

std::string unified_diff(std::string_view path, std::string_view before, std::string_view after) {
    const std::vector<DiffLine> lines = compare(before, after);
    std::string out;
    std::size_t old_line = 0;
    std::size_t new_line = 0;
    const auto step = [&](Side side) {
        old_line += side == Side::After ? 0 : 1;
        new_line += side == Side::Before ? 0 : 1;
    };
    std::size_t done = 0; // lines counted so far
    for (std::size_t at = 0; at < lines.size();) {
        if (lines[at].side == Side::Both) {
            ++at;
            continue;
        }
        const std::size_t begin = std::max(done, at - std::min(at, kContext));
        std::size_t end = at;     // end of the hunk
        std::size_t changed = at; // the last line that differs
        while (end < lines.size() && end <= changed + 2 * kContext) {
            changed = lines[end].side == Side::Both ? changed : end;
            ++end;
        }
        end = std::min(lines.size(), changed + 1 + kContext);
        for (; done < begin; ++done) {
            step(lines[done].side);
        }
        const std::size_t old_begin = old_line;
        const std::size_t new_begin = new_line;
        std::string hunk;
        for (; done < end; ++done) {
            step(lines[done].side);
            hunk += lines[done].side == Side::Both     ? ' '
                    : lines[done].side == Side::Before ? '-'
                                                       : '+';
            hunk += lines[done].text;
            if (!lines[done].text.ends_with('\n')) {
                hunk += "\n\\ No newline at end of file\n";
            }
        }
        if (out.empty()) {
            out = fmt::format("--- {}\n+++ {}\n", path, path);
        }
        out += fmt::format("@@ -{} +{} @@\n", range_text(old_begin, old_line - old_begin),
                           range_text(new_begin, new_line - new_begin));
        out += hunk;
        at = end;
    }
    return out;
}

} // namespace lsys::lsc
