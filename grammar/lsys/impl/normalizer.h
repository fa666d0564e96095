// SPDX-License-Identifier: MIT
// Normalizer: replaces characters beyond ASCII of a file by the text that the author most likely
// meant.
#pragma once

#include "grammar/ast/text_map.h"
#include "grammar/base/diagnostic.h"
#include "grammar/base/utf8.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace lsys {

/// A character beyond ASCII in a place where only ASCII has a meaning.
struct StrayCharacter {
    std::uint32_t begin = 0; // offset in the source
    bool in_quotes = false;  // whether it is in back quotes: only confusables are replaced
    bool in_value = false;   // whether it is in an expression or a setting, not among modules

    friend auto operator<=>(const StrayCharacter&, const StrayCharacter&) = default;
};

/// The replacement of `point`: ASCII for a confusable, `_` and the code point for a letter, else a
/// blank.
[[nodiscard]] std::string normalized_form(char32_t point);

class Normalizer {
public:
    /// `diagnostics`: null if nothing is to be reported.
    Normalizer(FileId file, std::string_view text, TextMap& map, Diagnostics* diagnostics)
        : file_(file), text_(text), map_(map), diagnostics_(diagnostics) {}

    /// Replaces the characters, which ascend without duplicates, and completes the map.
    void replace_all(std::span<const StrayCharacter> strays);

private:
    /// Adjacent confusables, reported as one mistake.
    struct Group {
        std::uint32_t begin = 0;
        std::uint32_t end = 0;
        std::string ascii;       // text that replaces the characters
        std::string code_points; // numbers of the characters, for the message
        std::string_view name;   // name of all characters; empty if their names differ
        std::uint32_t count = 0; // number of characters
    };

    /// Replaces the character by `ascii` and adds it to group_; reports a group that it does not
    /// continue.
    void replace_confusable(std::uint32_t begin,
                            const CodePoint& point,
                            std::string_view ascii,
                            std::string_view name);
    /// Reports a superscript after a module.
    void report_superscript(std::uint32_t begin, const CodePoint& point);
    /// Bytes [begin, end) of the text.
    struct TextPart {
        std::uint32_t begin = 0;
        std::uint32_t end = 0;
    };
    /// Returns whether `word` is a single Greek letter; reports the first occurrence of each
    /// letter.
    bool report_greek(std::uint32_t begin, TextPart word, const CodePoint& point);
    /// Reports a character beyond ASCII that looks like no ASCII character.
    void report_unknown(std::uint32_t begin, const CodePoint& point);
    /// Reports and clears group_.
    void report_group();
    /// Whether the character of byte `at` can belong to a word.
    [[nodiscard]] bool is_word_at(std::uint32_t at) const;

    FileId file_;
    std::string_view text_;
    TextMap& map_;
    Diagnostics* diagnostics_;
    Group group_;
    std::uint32_t word_end_ = 0;    // end of the last word with an unknown letter
    std::u32string reported_greek_; // letters that have been reported
    bool explained_ = false;        // a message has the note about text copied from a PDF
};

} // namespace lsys
