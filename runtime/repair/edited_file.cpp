// SPDX-License-Identifier: MIT
#include "runtime/repair/edited_file.h"

#include <algorithm>
#include <utility>

namespace lsys::repair {

bool has_carriage_returns(std::string_view text) {
    const std::size_t end = text.find('\n');
    return end != std::string_view::npos && end > 0 && text[end - 1] == '\r';
}

EditedFile::EditedFile(std::string_view text, std::vector<TextPlace> statements)
    : original_(text), statements_(std::move(statements)) {
    // The statements of a file that is included twice are listed twice.
    std::sort(statements_.begin(), statements_.end());
    statements_.erase(std::unique(statements_.begin(), statements_.end()), statements_.end());
}

void EditedFile::add_round(std::string_view text, const std::vector<const Edit*>& edits) {
    const bool has_crlf = has_carriage_returns(text);
    std::vector<RoundEdit>& round = rounds_.emplace_back();
    round.reserve(edits.size());
    std::uint32_t before_end = 0;
    std::uint32_t after_end = 0;
    for (const Edit* edit : edits) {
        const std::string& inserted = edit->replacement;
        const auto line_count =
            has_crlf ? std::count(inserted.begin(), inserted.end(), '\n') : std::ptrdiff_t{0};
        const std::uint32_t begin = after_end + (edit->span.begin - before_end);
        const std::uint32_t end =
            begin +
            static_cast<std::uint32_t>(inserted.size() + static_cast<std::size_t>(line_count));
        round.push_back({{edit->span.begin, edit->span.end}, {begin, end}});
        before_end = edit->span.end;
        after_end = end;
    }
}

std::uint32_t EditedFile::original_place(std::uint32_t at) const {
    for (auto round = rounds_.rbegin(); round != rounds_.rend(); ++round) {
        const auto after = std::upper_bound(
            round->begin(), round->end(), at,
            [](std::uint32_t place, const RoundEdit& edit) { return place < edit.after.begin; });
        if (after == round->begin()) {
            continue;
        }
        const RoundEdit& edit = *std::prev(after);
        at = at >= edit.after.end ? edit.before.end + (at - edit.after.end) : edit.before.begin;
    }
    return at;
}

std::vector<std::size_t> EditedFile::statements_at(TextPlace place) const {
    const std::uint32_t begin = original_place(place.begin);
    return original_statements_at({begin, std::max(begin, original_place(place.end))});
}

std::vector<std::size_t> EditedFile::original_statements_at(TextPlace place) const {
    // Statements do not overlap, so their ends ascend too.
    auto statement =
        std::lower_bound(statements_.begin(), statements_.end(), place.begin,
                         [](const TextPlace& each, std::uint32_t from) { return each.end < from; });
    std::vector<std::size_t> found;
    for (; statement != statements_.end() && statement->begin <= place.end; ++statement) {
        found.push_back(static_cast<std::size_t>(statement - statements_.begin()));
    }
    return found;
}

} // namespace lsys::repair
