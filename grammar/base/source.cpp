// SPDX-License-Identifier: MIT
#include "grammar/base/source.h"

#include "grammar/base/cancellation.h"
#include "grammar/base/contract.h"
#include "grammar/base/utf8.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace lsys {

SourceSpan join(SourceSpan first, SourceSpan last) {
    if (first.file == kNoFile) {
        return last;
    }
    if (last.file == kNoFile) {
        return first;
    }
    if (first.file != last.file) { // the text contains an included file
        return first;
    }
    return {first.file, std::min(first.begin, last.begin), std::max(first.end, last.end)};
}

SourceFile::SourceFile(std::string path, std::string bytes)
    : path_(std::move(path)), text_(std::move(bytes)) {
    if (text_.starts_with("\xEF\xBB\xBF")) {
        has_byte_order_mark_ = true;
        text_.erase(0, 3);
    }
    find_lines();
    find_checkpoints();
}

void SourceFile::find_lines() {
    line_begins_.push_back(0);
    const char* const base = text_.data();
    const char* cursor = base;
    const char* const end = base + text_.size();
    while (cursor != end) {
        const void* found = std::memchr(cursor, '\n', static_cast<std::size_t>(end - cursor));
        if (found == nullptr) {
            break;
        }
        cursor = static_cast<const char*>(found) + 1;
        line_begins_.push_back(static_cast<std::uint32_t>(cursor - base));
    }
}

namespace {

/// Bytes between two checkpoints of a line.
constexpr std::uint32_t kStride = 4096;

/// Advances by one character.
void step_over(std::string_view text, std::uint32_t& offset) {
    const bool ascii = static_cast<unsigned char>(text[offset]) < 0x80;
    offset += ascii ? 1 : decode_utf8(text.substr(offset)).length;
}

} // namespace

void SourceFile::step(std::string_view text, Checkpoint& place) {
    // UTF-8 bytes of a character that UTF-16 writes as a surrogate pair.
    constexpr std::uint32_t kLengthOfPairs = 4;
    const std::uint32_t begin = place.offset;
    step_over(text, place.offset);
    ++place.column;
    place.utf16_column += place.offset - begin == kLengthOfPairs ? 2 : 1;
}

void SourceFile::find_checkpoints() {
    for (std::size_t i = 0; i < line_begins_.size(); ++i) {
        const std::uint32_t end = i + 1 < line_begins_.size()
                                      ? line_begins_[i + 1]
                                      : static_cast<std::uint32_t>(text_.size());
        if (end - line_begins_[i] <= kStride) {
            continue;
        }
        Checkpoint place{line_begins_[i], 1, 1};
        std::uint32_t next = place.offset + kStride;
        while (place.offset < end) {
            step(text_, place);
            if (place.offset >= next) {
                stop_if_cancelled();
                checkpoints_.push_back(place);
                next = place.offset + kStride;
            }
        }
    }
}

LineColumn SourceFile::line_column(std::uint32_t offset) const {
    LSYS_CHECK(offset <= text_.size(), offset, text_.size());
    const auto after = std::upper_bound(line_begins_.begin(), line_begins_.end(), offset);
    Checkpoint place{*(after - 1), 1, 1};
    const auto later = std::upper_bound(
        checkpoints_.begin(), checkpoints_.end(), offset,
        [](std::uint32_t wanted, const Checkpoint& known) { return wanted < known.offset; });
    if (later != checkpoints_.begin() && (later - 1)->offset > place.offset) {
        place = *(later - 1);
    }
    const std::string_view before = std::string_view(text_).substr(0, offset);
    while (place.offset < offset) {
        step(before, place);
    }
    return {static_cast<std::uint32_t>(after - line_begins_.begin()), place.column,
            place.utf16_column};
}

std::uint32_t SourceFile::line_count() const {
    return static_cast<std::uint32_t>(line_begins_.size());
}

std::uint32_t SourceFile::line_begin(std::uint32_t line) const {
    LSYS_CHECK(line >= 1 && line <= line_begins_.size(), line);
    return line_begins_[line - 1];
}

std::string_view SourceFile::line_text(std::uint32_t line) const {
    const std::uint32_t begin = line_begin(line);
    std::size_t end = line < line_begins_.size() ? line_begins_[line] - 1 : text_.size();
    if (end > begin && text_[end - 1] == '\r') {
        --end;
    }
    return std::string_view(text_).substr(begin, end - begin);
}

FileId SourceMap::add(std::string path, std::string bytes) {
    LSYS_CHECK(bytes.size() <= kMaxSourceBytes, bytes.size());
    files_.emplace_back(std::move(path), std::move(bytes));
    return static_cast<FileId>(files_.size() - 1);
}

const SourceFile& SourceMap::file(FileId id) const {
    const auto index = static_cast<std::size_t>(id);
    LSYS_CHECK(index < files_.size(), index, files_.size());
    return files_[index];
}

void SourceMap::allow(SourceSpan statement, std::string_view code) {
    std::vector<Allowance>& list = allowances_[statement.file];
    const auto after = std::upper_bound(
        list.begin(), list.end(), statement.begin,
        [](std::uint32_t begin, const Allowance& row) { return begin < row.statement.begin; });
    list.insert(after, {statement, std::string(code)});
}

bool SourceMap::allows(SourceSpan place, std::string_view code) const {
    const auto list = allowances_.find(place.file);
    if (list == allowances_.end()) {
        return false;
    }
    const auto after = std::upper_bound(
        list->second.begin(), list->second.end(), place.begin,
        [](std::uint32_t begin, const Allowance& row) { return begin < row.statement.begin; });
    for (auto row = after; row != list->second.begin();) {
        --row;
        if (row->statement.end < place.begin) {
            return false; // statements do not overlap
        }
        if (row->code == code) {
            return true;
        }
    }
    return false;
}

std::string_view SourceMap::text(SourceSpan span) const {
    const std::string_view text = file(span.file).text();
    LSYS_CHECK(span.begin <= span.end && span.end <= text.size(), span.begin, span.end);
    return text.substr(span.begin, span.end - span.begin);
}

} // namespace lsys
