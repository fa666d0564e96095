// SPDX-License-Identifier: MIT
// Writes texts of a file of L3D as .lsys modules in back quotes, character by character, and warns
// of quirks of L3D.
#pragma once

#include "grammar/ast/parse_context.h"
#include "grammar/ast/translation.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace lsys {

class L3dWriter {
public:
    L3dWriter(const ParseContext& context, Translation& translation)
        : context_(context), translation_(translation) {}

    /// The line without its end and, unless bug-compatible, without a comment.
    [[nodiscard]] SourceSpan line(SourceSpan text);
    /// A left side; unless bug-compatible, without blanks at its end.
    [[nodiscard]] SourceSpan key(SourceSpan text);
    /// Writes an axiom or a right side.
    void write(SourceSpan text);
    /// True: reports no warnings; for an axiom that may be a broken rule.
    void set_quiet(bool is_quiet) { is_quiet_ = is_quiet; }
    /// Writes a left side without warnings.
    void write_key(SourceSpan text);

private:
    struct Parameter {
        std::uint32_t open = 0; // offset of the `(`
        std::uint32_t end = 0;  // one past the `)`
    };
    /// Writes the character at `at`; returns the offset of the next character.
    std::uint32_t put_character(std::uint32_t at, std::uint32_t end);
    void put_characters(std::uint32_t at, std::uint32_t end);
    /// Warns that L3D reads the bytes [begin, end) in an unexpected way.
    void warn(std::uint32_t begin, std::uint32_t end, const std::string& message);
    void warn_unclosed(std::uint32_t at);
    /// Warns of a parameter whose written value L3D does not use.
    void check_parameter(char command, Parameter parameter);
    /// Warns, once each, of a half turn and of a digit, which L3D treats in its own way.
    void check_command(char command, std::uint32_t at);

    const ParseContext& context_;
    Translation& translation_;
    FileId file_ = kNoFile;
    std::string_view source_; // text of file_
    bool is_quiet_ = false;
    bool has_warned_half_turn_ = false;
    bool has_warned_digit_ = false;
};

} // namespace lsys
