// SPDX-License-Identifier: MIT
// The scanned text of a file, and the map from its offsets to offsets of the file. Typographic
// characters are reported and replaced before the scan, so that later stages read ASCII; a TextMap
// maps offsets of the scanned text to offsets of the file.
#pragma once

#include "grammar/ast/translation.h"
#include "grammar/base/chunked_vector.h"
#include "grammar/base/source.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace lsys {

/// A text with replacements and its map to the source. Replacements are added in order.
class TextMap {
public:
    explicit TextMap(std::string_view source) : source_(source) {}

    /// Replaces the bytes [begin, end) of the source. Precondition: `begin` is not before the end
    /// of the last replacement.
    void replace(std::uint32_t begin, std::uint32_t end, std::string_view replacement);
    /// Appends the source after the last replacement to text(). Call finish() once, after the last
    /// replacement.
    void finish();

    [[nodiscard]] const std::string& text() const { return text_; }
    /// Whether nothing is replaced, so that text() equals the source.
    [[nodiscard]] bool empty() const { return edits_.empty(); }
    /// The offset in the source where the character at `offset` of text() begins.
    [[nodiscard]] std::uint32_t source_begin(std::uint32_t offset) const;
    /// The offset in the source where the character that ends at `offset` of text() ends.
    [[nodiscard]] std::uint32_t source_end(std::uint32_t offset) const;

private:
    struct Edit {
        std::uint32_t source_begin = 0;
        std::uint32_t source_end = 0;
        std::uint32_t text_end = 0; // end of the replacement in text_
    };
    [[nodiscard]] std::size_t edits_ending_by(std::uint32_t offset) const;

    std::string_view source_;
    std::string text_;
    std::uint32_t consumed_ = 0; // number of bytes of source_ copied or replaced so far
    ChunkedVector<Edit> edits_;
    // Last result of edits_ending_by(), a start for the next search: offsets mostly ascend.
    mutable std::size_t hint_ = 0;
};

/// The scanned text of a file. Only this struct converts offsets in the text to places in the file.
struct ScannedText {
    FileId file = kNoFile;
    std::string_view text;
    const TextMap* map = nullptr;             // null if the text is the file's own
    const Translation* translation = nullptr; // replaces `map` for a file of another dialect

    [[nodiscard]] std::uint32_t source_begin(std::uint32_t offset) const {
        if (translation != nullptr) {
            return translation->origin(offset, offset + 1).begin;
        }
        return map == nullptr ? offset : map->source_begin(offset);
    }
    [[nodiscard]] std::uint32_t source_end(std::uint32_t offset) const {
        if (translation != nullptr) {
            return offset == 0 ? 0 : translation->origin(offset - 1, offset).end;
        }
        return map == nullptr ? offset : map->source_end(offset);
    }
    [[nodiscard]] SourceSpan span(std::uint32_t begin, std::uint32_t end) const {
        if (translation != nullptr) {
            return translation->origin(begin, end);
        }
        if (map == nullptr) {
            return {file, begin, end};
        }
        return begin == end ? after(end)
                            : SourceSpan{file, map->source_begin(begin), map->source_end(end)};
    }
    /// The empty span just after the character that ends at `offset`.
    [[nodiscard]] SourceSpan after(std::uint32_t offset) const {
        if (translation != nullptr) {
            return translation->origin(offset, offset);
        }
        const std::uint32_t end = source_end(offset);
        return {file, end, end};
    }
};

} // namespace lsys
