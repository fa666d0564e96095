// Source text and places in it. A SourceMap owns every file of one compilation; all stages speak of
// places as SourceSpan: a file and two byte offsets. Lines, columns, tabs and the width of
// characters are worked out only where a message is rendered.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

enum class FileId : std::uint32_t {};
inline constexpr FileId kNoFile{0xFFFFFFFFu};

/// Bytes [begin, end) of a file. Empty spans are allowed and stand between two characters.
struct SourceSpan {
    FileId file = kNoFile;
    std::uint32_t begin = 0;
    std::uint32_t end = 0;

    friend bool operator==(const SourceSpan&, const SourceSpan&) = default;
};

/// From the start of `first` to the end of `last`; `first` alone where they are of two files.
[[nodiscard]] SourceSpan join(SourceSpan first, SourceSpan last);

/// A line and a column as a reader counts them: from 1, a column being one Unicode code point
/// (a byte that is not part of valid UTF-8 counts as one).
struct LineColumn {
    std::uint32_t line = 1;
    std::uint32_t column = 1;
};

/// One file's name and bytes, never changed after creation. A byte order mark is not part of the
/// text.
class SourceFile {
public:
    SourceFile(std::string path, std::string bytes);

    [[nodiscard]] const std::string& path() const { return path_; }
    [[nodiscard]] std::string_view text() const { return text_; }
    [[nodiscard]] bool has_byte_order_mark() const { return has_byte_order_mark_; }

    [[nodiscard]] LineColumn line_column(std::uint32_t offset) const;
    /// The number of lines; an empty file has one.
    [[nodiscard]] std::uint32_t line_count() const;
    /// Line `line` (from 1) without its line end.
    [[nodiscard]] std::string_view line_text(std::uint32_t line) const;
    /// Offset of the first byte of line `line` (from 1).
    [[nodiscard]] std::uint32_t line_begin(std::uint32_t line) const;

private:
    /// A column within a long line, so that finding a place in it costs no more than in a short
    /// one.
    struct Checkpoint {
        std::uint32_t offset = 0;
        std::uint32_t column = 1;
    };
    void find_lines();
    void find_checkpoints();

    std::string path_;
    std::string text_;
    bool has_byte_order_mark_ = false;
    std::vector<std::uint32_t> line_begins_;
    std::vector<Checkpoint> checkpoints_; // ascending
};

/// The largest file that offsets can address.
inline constexpr std::uint64_t kMaxSourceBytes = (std::uint64_t{1} << 31) - 16;

/// Owns the files of a compilation; references stay valid as files are added.
class SourceMap {
public:
    /// Precondition: bytes.size() <= kMaxSourceBytes.
    FileId add(std::string path, std::string bytes);

    [[nodiscard]] const SourceFile& file(FileId id) const;
    [[nodiscard]] std::uint32_t file_count() const {
        return static_cast<std::uint32_t>(files_.size());
    }
    [[nodiscard]] std::string_view text(SourceSpan span) const;

private:
    std::deque<SourceFile> files_;
};

} // namespace lsys
