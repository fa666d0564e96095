// Reads the characters beyond ASCII of one file: each becomes what its author most likely meant.
#pragma once

#include "grammar/ast/text_map.h"
#include "grammar/base/diagnostic.h"
#include "grammar/base/utf8.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace lsys {

/// The scanner of the first pass calls read() in the order of the file; finish() ends it.
class PlainReader {
public:
    /// Without diagnostics nothing is reported.
    PlainReader(FileId file, std::string_view text, TextMap& map, Diagnostics* diagnostics)
        : file_(file), text_(text), map_(map), diagnostics_(diagnostics) {}

    /// The valid character that lies at `begin` of the text and at `buffer` in the scanner's copy.
    /// Its last bytes there are overwritten by the plain text; returns the offset of that.
    int read(std::uint32_t begin, char* buffer, int length, bool in_object);
    /// A character between back quotes: only look-alikes are replaced.
    void read_quoted(std::uint32_t begin, std::uint32_t length);
    void finish();

private:
    /// Look-alikes that stand side by side are one mistake.
    struct Group {
        std::uint32_t begin = 0;
        std::uint32_t end = 0;
        std::string plain;
        std::string code_points;
        std::string_view name;
        std::uint32_t count = 0;
    };

    void replace(std::uint32_t begin,
                 std::uint32_t length,
                 char32_t character,
                 std::string_view plain,
                 std::string_view name);
    void close_quotes(std::uint32_t after, char* buffer);
    std::string read_unknown(std::uint32_t begin, const CodePoint& point);
    void report_group();
    [[nodiscard]] bool is_word_at(std::uint32_t at) const;

    FileId file_;
    std::string_view text_;
    TextMap& map_;
    Diagnostics* diagnostics_;
    Group group_;
    std::uint32_t word_end_ = 0; // of the last word with an unknown letter
    bool explained_ = false;
};

} // namespace lsys
