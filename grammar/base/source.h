// SPDX-License-Identifier: MIT
// Source text and places in it. A SourceMap owns the files of a compilation; all stages name places
// as SourceSpan, a file and two byte offsets. Lines and columns are computed only for output and
// for the places that bytecode stores.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

enum class FileId : std::uint32_t {};
inline constexpr FileId kNoFile{0xFFFFFFFFu};

/// Bytes [begin, end) of a file. An empty span is a place between two characters.
struct SourceSpan {
    FileId file = kNoFile;
    std::uint32_t begin = 0;
    std::uint32_t end = 0;

    friend bool operator==(const SourceSpan&, const SourceSpan&) = default;
};

/// The smallest span that covers both spans; `first` if the spans are in different files. If one of
/// the spans has no file, the other span.
[[nodiscard]] SourceSpan join(SourceSpan first, SourceSpan last);

/// A line and a column, both from 1. A column is one Unicode code point, or one byte that is not
/// valid UTF-8.
struct LineColumn {
    std::uint32_t line = 1;
    std::uint32_t column = 1;
    std::uint32_t utf16_column = 1; // like `column`, in UTF-16 code units
};

/// The path and text of a file, immutable. A byte order mark is not part of the text.
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
    /// A known column within a long line, from which the columns after it are counted.
    struct Checkpoint {
        std::uint32_t offset = 0;
        std::uint32_t column = 1;
        std::uint32_t utf16_column = 1;
    };
    /// Moves `place` over one character of `text`.
    static void step(std::string_view text, Checkpoint& place);
    void find_lines();
    void find_checkpoints();

    std::string path_;
    std::string text_;
    bool has_byte_order_mark_ = false;
    std::vector<std::uint32_t> line_begins_;
    std::vector<Checkpoint> checkpoints_; // ascending by offset
};

/// Maximum size of a file: offsets have 32 bits.
inline constexpr std::uint64_t kMaxSourceBytes = (std::uint64_t{1} << 31) - 16;

/// The files of a compilation. References stay valid when files are added.
class SourceMap {
public:
    /// Precondition: bytes.size() <= kMaxSourceBytes.
    FileId add(std::string path, std::string bytes);

    [[nodiscard]] const SourceFile& file(FileId id) const;
    [[nodiscard]] std::uint32_t file_count() const {
        return static_cast<std::uint32_t>(files_.size());
    }
    [[nodiscard]] std::string_view text(SourceSpan span) const;

    /// Allows diagnostics of a code within a statement: `/* lsc: allow CODE */`. Statements of a
    /// file do not overlap.
    void allow(SourceSpan statement, std::string_view code);
    /// Whether a diagnostic of `code` at `place` is allowed.
    [[nodiscard]] bool allows(SourceSpan place, std::string_view code) const;

private:
    struct Allowance {
        SourceSpan statement;
        std::string code;
    };

    std::deque<SourceFile> files_;
    std::map<FileId, std::vector<Allowance>> allowances_; // ascending by begin of the statement
};

} // namespace lsys
