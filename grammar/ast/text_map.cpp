// SPDX-License-Identifier: MIT
#include "grammar/ast/text_map.h"

namespace lsys {

void TextMap::replace(std::uint32_t begin, std::uint32_t end, std::string_view replacement) {
    LSYS_CHECK(begin >= consumed_ && begin <= end && end <= source_.size(), begin, end, consumed_);
    text_.append(source_.substr(consumed_, begin - consumed_));
    text_.append(replacement);
    consumed_ = end;
    edits_.push_back({begin, end, static_cast<std::uint32_t>(text_.size())});
}

void TextMap::finish() {
    text_.append(source_.substr(consumed_));
    consumed_ = static_cast<std::uint32_t>(source_.size());
}

/// The number of edits whose replacement ends at or before `offset`.
std::size_t TextMap::edits_ending_by(std::uint32_t offset) const {
    const auto ends_by = [&](std::size_t index) { return edits_[index].text_end <= offset; };
    // Tries a few steps from the last result, then bisects.
    for (int step = 0; step < 4; ++step) {
        if (hint_ > 0 && !ends_by(hint_ - 1)) {
            --hint_;
        } else if (hint_ < edits_.size() && ends_by(hint_)) {
            ++hint_;
        } else {
            return hint_;
        }
    }
    return hint_ = edits_.partition_point(
               [offset](const Edit& edit) { return edit.text_end <= offset; });
}

std::uint32_t TextMap::source_begin(std::uint32_t offset) const {
    const std::size_t before = edits_ending_by(offset);
    const std::uint32_t source =
        before == 0 ? offset : offset - edits_[before - 1].text_end + edits_[before - 1].source_end;
    const bool inside = before < edits_.size() && source >= edits_[before].source_begin;
    return inside ? edits_[before].source_begin : source;
}

std::uint32_t TextMap::source_end(std::uint32_t offset) const {
    if (offset == 0) {
        return 0;
    }
    // The end of the character before `offset`; within a replacement, the end of the replaced text.
    const std::uint32_t last = offset - 1;
    const std::size_t before = edits_ending_by(last);
    const std::uint32_t source =
        before == 0 ? last : last - edits_[before - 1].text_end + edits_[before - 1].source_end;
    const bool inside = before < edits_.size() && source >= edits_[before].source_begin;
    return inside ? edits_[before].source_end : source + 1;
}

} // namespace lsys
