// The text that a front end scans, and where it stands in the file. Typographic characters are
// replaced before the scan (and reported then), so that all later stages read the file as if plain
// ones had been written; a TextMap leads from offsets of that text back to offsets of the file.
#pragma once

#include "grammar/ast/translation.h"
#include "grammar/base/chunked_vector.h"
#include "grammar/base/source.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace lsys {

/// Built from the front to the back: keep() and replace() in the order of the file.
class TextMap {
public:
    explicit TextMap(std::string_view source) : source_(source) {}

    /// The bytes [begin, end) of the source are read as `replacement`. Precondition: begin is not
    /// before the end of the last replacement.
    void replace(std::uint32_t begin, std::uint32_t end, std::string_view replacement);
    /// Takes over what is left of the source.
    void finish();

    [[nodiscard]] const std::string& text() const { return text_; }
    [[nodiscard]] bool empty() const { return edits_.empty(); }
    /// Where the character at `offset` of text() begins in the source.
    [[nodiscard]] std::uint32_t source_begin(std::uint32_t offset) const;
    /// Where the character that ends at `offset` of text() ends in the source.
    [[nodiscard]] std::uint32_t source_end(std::uint32_t offset) const;

private:
    struct Edit {
        std::uint32_t source_begin = 0;
        std::uint32_t source_end = 0;
        std::uint32_t text_end = 0;
    };
    [[nodiscard]] std::size_t edits_ending_by(std::uint32_t offset) const;

    std::string_view source_;
    std::string text_;
    std::uint32_t consumed_ = 0; // of source_
    ChunkedVector<Edit> edits_;
    mutable std::size_t hint_ = 0; // the last answer; questions come in ascending order, nearly
};

/// A file as it is scanned. Offsets of scanned text become places of the file here and nowhere
/// else.
struct ScannedText {
    FileId file = kNoFile;
    std::string_view text;        // what is scanned
    const TextMap* map = nullptr; // null where the text is the file's own
    // Of a file of another dialect: where the scanned text comes from; then there is no map.
    const Translation* translation = nullptr;

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
