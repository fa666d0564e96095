// SPDX-License-Identifier: MIT
#include "grammar/ast/translation.h"

#include "grammar/base/contract.h"

#include <algorithm>

namespace lsys {

bool Translation::claim_room(std::string_view text, SourceSpan span) {
    if (!overflow_ && text.size() > max_bytes_ - text_.size()) {
        overflow_ = span;
    }
    return !overflow_;
}

bool Translation::report_overflow(Diagnostics& diagnostics) const {
    if (overflow_) {
        diagnostics.add(DiagnosticCode::ProgramTooLarge, *overflow_,
                        "here the grammar outgrows 2 GiB of .lsys text");
    }
    return overflow_.has_value();
}

void Translation::copy(SourceSpan span, const SourceMap& sources) {
    copy_as(sources.text(span), span);
}

void Translation::copy_as(std::string_view text, SourceSpan span) {
    LSYS_CHECK(text.size() == span.end - span.begin);
    if (text.empty() || !claim_room(text, span)) {
        return;
    }
    text_ += text;
    const auto end = static_cast<std::uint32_t>(text_.size());
    if (!parts_.empty() && parts_.back().verbatim && parts_.back().span.file == span.file &&
        parts_.back().span.end == span.begin) {
        parts_.back().span.end = span.end;
        parts_.back().end = end;
    } else {
        parts_.push_back({end, true, span});
    }
}

void Translation::put(std::string_view text, SourceSpan span) {
    if (text.empty()) {
        return;
    }
    if (span.file == kNoFile) {
        span = {file_, 0, 0};
    }
    if (!claim_room(text, span)) {
        return;
    }
    text_ += text;
    const auto end = static_cast<std::uint32_t>(text_.size());
    if (!parts_.empty() && !parts_.back().verbatim && parts_.back().span == span) {
        parts_.back().end = end;
    } else {
        parts_.push_back({end, false, span});
    }
}

void Translation::put(std::string_view text) {
    SourceSpan here{file_, 0, 0};
    if (!parts_.empty()) {
        here = parts_.back().span;
        here.begin = here.end;
    }
    put(text, here);
}

std::vector<FileId> Translation::files() const {
    std::vector<FileId> files{file_};
    for (const Part& part : parts_) {
        if (part.span.file != files.back() &&
            std::find(files.begin(), files.end(), part.span.file) == files.end()) {
            files.push_back(part.span.file);
        }
    }
    return files;
}

const Translation::Part& Translation::part_at(std::uint32_t offset) const {
    LSYS_CHECK(!parts_.empty());
    if (hint_ >= parts_.size()) {
        hint_ = 0;
    }
    const auto begin_of = [&](std::size_t part) { return part == 0 ? 0 : parts_[part - 1].end; };
    for (int step = 0; step < 4; ++step) {
        if (offset < begin_of(hint_)) {
            --hint_;
        } else if (offset >= parts_[hint_].end && hint_ + 1 < parts_.size()) {
            ++hint_;
        } else {
            return parts_[hint_];
        }
    }
    const auto found =
        std::upper_bound(parts_.begin(), parts_.end(), offset,
                         [](std::uint32_t value, const Part& part) { return value < part.end; });
    hint_ = found == parts_.end() ? parts_.size() - 1
                                  : static_cast<std::size_t>(found - parts_.begin());
    return parts_[hint_];
}

SourceSpan Translation::origin(std::uint32_t begin, std::uint32_t end) const {
    if (parts_.empty()) {
        return {file_, 0, 0};
    }
    const Part& first = part_at(begin);
    SourceSpan span = first.span;
    if (first.verbatim) {
        span.begin = std::min(span.end - (first.end - std::min(begin, first.end)), span.end);
    }
    if (begin >= end) { // an empty span: at the end of the byte before
        if (begin != 0) {
            const SourceSpan before = origin(begin - 1, begin);
            return {before.file, before.end, before.end};
        }
        span.end = span.begin;
        return span;
    }
    const Part& last = part_at(end - 1);
    if (last.span.file != span.file) {
        return span;
    }
    const std::uint32_t to =
        last.verbatim ? last.span.end - (last.end - std::min(end, last.end)) : last.span.end;
    // Parts of a statement may have another order in the original.
    return {span.file, std::min(span.begin, to), std::max(span.begin, to)};
}

} // namespace lsys
