// SPDX-License-Identifier: MIT
#include "runtime/languageserver/text_positions.h"

#include "grammar/base/utf8.h"

#include <algorithm>

namespace lsys {

TextPositions::TextPositions(std::string_view text, PositionEncoding encoding)
    : text_(text), encoding_(encoding), line_begins_{0} {
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool is_end = text[i] == '\n' || (text[i] == '\r' && text.substr(i + 1, 1) != "\n");
        if (is_end) {
            line_begins_.push_back(i + 1);
        }
    }
}

TextPosition TextPositions::position(std::size_t offset) const {
    offset = std::min(offset, text_.size());
    const auto after = std::upper_bound(line_begins_.begin(), line_begins_.end(), offset);
    const std::size_t begin = *(after - 1);
    TextPosition found;
    found.line = static_cast<std::uint32_t>(after - line_begins_.begin() - 1);
    if (encoding_ == PositionEncoding::Utf8) {
        found.character = static_cast<std::uint32_t>(offset - begin);
        return found;
    }
    for (std::size_t at = begin; at < offset;) {
        const CodePoint point = decode_utf8(text_.substr(at));
        if (at + point.length > offset) {
            break;
        }
        found.character += point.value > 0xFFFF ? 2 : 1;
        at += point.length;
    }
    return found;
}

std::size_t TextPositions::offset(TextPosition position) const {
    if (position.line >= line_begins_.size()) {
        return text_.size();
    }
    const std::size_t begin = line_begins_[position.line];
    std::size_t end =
        position.line + 1 < line_begins_.size() ? line_begins_[position.line + 1] : text_.size();
    while (end > begin && (text_[end - 1] == '\n' || text_[end - 1] == '\r')) {
        --end;
    }
    std::size_t at = begin;
    for (std::uint32_t units = 0; at < end;) {
        const CodePoint point = decode_utf8(text_.substr(at, end - at));
        const std::uint32_t width =
            encoding_ == PositionEncoding::Utf8 ? point.length : (point.value > 0xFFFF ? 2 : 1);
        if (units + width > position.character) {
            break;
        }
        units += width;
        at += point.length;
    }
    return at;
}

} // namespace lsys
