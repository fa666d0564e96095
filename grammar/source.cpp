#include "grammar/source.h"

#include "grammar/contract.h"

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
    return {first.file, std::min(first.begin, last.begin), std::max(first.end, last.end)};
}

SourceFile::SourceFile(std::string path, std::string bytes)
    : path_(std::move(path)), text_(std::move(bytes)) {
    if (text_.starts_with("\xEF\xBB\xBF")) {
        has_byte_order_mark_ = true;
        text_.erase(0, 3);
    }
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

/// Length of the valid UTF-8 sequence at the start of `text`, or 1 where there is none.
std::size_t code_point_length(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char lead = byte(0);
    const std::size_t length = lead < 0x80   ? 1
                               : lead < 0xC2 ? 0
                               : lead < 0xE0 ? 2
                               : lead < 0xF0 ? 3
                               : lead < 0xF5 ? 4
                                             : 0;
    if (length <= 1 || text.size() < length) {
        return 1;
    }
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xC0) != 0x80) {
            return 1;
        }
    }
    return length;
}

} // namespace

LineColumn SourceFile::line_column(std::uint32_t offset) const {
    LSYS_CHECK(offset <= text_.size(), offset, text_.size());
    const auto after = std::upper_bound(line_begins_.begin(), line_begins_.end(), offset);
    LineColumn place;
    place.line = static_cast<std::uint32_t>(after - line_begins_.begin());
    std::string_view before = std::string_view(text_).substr(*(after - 1), offset - *(after - 1));
    while (!before.empty()) {
        before.remove_prefix(code_point_length(before));
        ++place.column;
    }
    return place;
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

std::string_view SourceMap::text(SourceSpan span) const {
    const std::string_view text = file(span.file).text();
    LSYS_CHECK(span.begin <= span.end && span.end <= text.size(), span.begin, span.end);
    return text.substr(span.begin, span.end - span.begin);
}

} // namespace lsys
