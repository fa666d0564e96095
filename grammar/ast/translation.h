// Translation: a grammar of another dialect as .lsys text, with the place of the original that each
// part stands for. The front ends of other dialects make one; the .lsys front end then parses it as
// if it stood in the original file, so that every later stage, and every caret, is of that file.
// `lsc import` writes the text itself: what it writes derives what the original derives.
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
    /// `file`: the original, where parts without a place of their own are shown.
    explicit Translation(FileId file) : Translation(file, kMaxSourceBytes) {}
    /// With less room than a file has.
    Translation(FileId file, std::uint64_t most_bytes) : file_(file), most_bytes_(most_bytes) {}

    /// Appends the bytes of `span`, as they are: each stands for itself.
    void copy(SourceSpan span, const SourceMap& sources);
    /// Appends `text`, whose bytes stand for those of `span` one by one.
    void copy_as(std::string_view text, SourceSpan span);
    /// Appends `text`, which stands for `span` as a whole.
    void put(std::string_view text, SourceSpan span);
    /// Appends what nothing in the original says: it stands where the last part ended.
    void put(std::string_view text);

    /// Says that modules `name` of the text stand for `original`: messages write that.
    void replace_name(std::string_view name, std::string_view original) {
        replaced_names_.insert_or_assign(std::string(name), std::string(original));
    }

    /// The first part that the text has no room for; it and all behind it are left out.
    [[nodiscard]] const std::optional<SourceSpan>& overflow() const { return overflow_; }
    /// Reports that part. Returns whether there is one.
    [[nodiscard]] bool report_overflow(Diagnostics& diagnostics) const;

    [[nodiscard]] const std::string& text() const { return text_; }
    /// Originals by names of the text, where they are not the same.
    [[nodiscard]] const std::map<std::string, std::string>& replaced_names() const {
        return replaced_names_;
    }
    [[nodiscard]] FileId file() const { return file_; }
    /// All files that parts stand in, file() first.
    [[nodiscard]] std::vector<FileId> files() const;
    /// Where the bytes [begin, end) of the text come from; of one file.
    [[nodiscard]] SourceSpan origin(std::uint32_t begin, std::uint32_t end) const;

private:
    struct Part {
        std::uint32_t end = 0; // in text_
        bool verbatim = false; // byte for byte
        SourceSpan span;
    };
    [[nodiscard]] const Part& part_at(std::uint32_t offset) const;
    [[nodiscard]] bool has_room(std::string_view text, SourceSpan span);

    FileId file_;
    std::uint64_t most_bytes_ = 0;
    std::optional<SourceSpan> overflow_;
    std::string text_; // offsets into it have 32 bits
    std::vector<Part> parts_;
    std::map<std::string, std::string> replaced_names_;
    mutable std::size_t hint_ = 0; // the last answer; questions come in ascending order, nearly
};

} // namespace lsys
