// SPDX-License-Identifier: MIT
// Translation: a grammar of another dialect as .lsys text, with the source span of each part. Made
// by the front ends of other dialects and parsed by the .lsys front end with places of the original
// file, so that diagnostics point there. `lsc import` writes the text.
#pragma once

#include "grammar/base/diagnostic.h"
#include "grammar/base/source.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

class Translation {
public:
    /// `file`: the original; parts without a span get the place of its first byte.
    explicit Translation(FileId file) : Translation(file, kMaxSourceBytes) {}
    /// Limits the text to `max_bytes` instead of kMaxSourceBytes.
    Translation(FileId file, std::uint64_t max_bytes) : file_(file), max_bytes_(max_bytes) {}

    /// Appends the bytes of `span` unchanged.
    void copy(SourceSpan span, const SourceMap& sources);
    /// Appends `text`, whose bytes correspond one to one to the bytes of `span`.
    void copy_as(std::string_view text, SourceSpan span);
    /// Appends `text`, which corresponds to `span` as a whole.
    void put(std::string_view text, SourceSpan span);
    /// Appends text that the original does not have; its place is the end of the last part.
    void put(std::string_view text);

    /// Makes messages write `original` for modules `name` of the text.
    void replace_name(std::string_view name, std::string_view original) {
        replaced_names_.insert_or_assign(std::string(name), std::string(original));
    }

    /// The first part beyond the limit; it and all parts after it are missing.
    [[nodiscard]] const std::optional<SourceSpan>& overflow() const { return overflow_; }
    /// Reports overflow(); returns whether there is one.
    [[nodiscard]] bool report_overflow(Diagnostics& diagnostics) const;

    [[nodiscard]] const std::string& text() const { return text_; }
    /// Original name of each replaced name.
    [[nodiscard]] const std::map<std::string, std::string>& replaced_names() const {
        return replaced_names_;
    }
    [[nodiscard]] FileId file() const { return file_; }
    /// All files with parts, file() first.
    [[nodiscard]] std::vector<FileId> files() const;
    /// The span of the bytes [begin, end) of the text, in one file.
    [[nodiscard]] SourceSpan origin(std::uint32_t begin, std::uint32_t end) const;

private:
    struct Part {
        std::uint32_t end = 0; // index in text_
        bool verbatim = false; // corresponds to span byte by byte
        SourceSpan span;
    };
    /// The part with the byte at `offset`; the last part beyond the end.
    [[nodiscard]] const Part& part_at(std::uint32_t offset) const;
    /// Whether `text` still fits into max_bytes_; records the first place where it does not.
    [[nodiscard]] bool claim_room(std::string_view text, SourceSpan span);

    FileId file_;
    std::uint64_t max_bytes_ = 0;
    std::optional<SourceSpan> overflow_; // first place whose text does not fit
    std::string text_;                   // at most max_bytes_
    std::vector<Part> parts_;
    std::map<std::string, std::string> replaced_names_;
    mutable std::size_t hint_ = 0; // last part_at(), a start for the next search
};

} // namespace lsys
