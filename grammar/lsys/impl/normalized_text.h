// SPDX-License-Identifier: MIT
// The step before the parse of a file. It reports pasted text and forms of other languages
// (draft_text.h), invalid UTF-8 and typographic characters, and makes a normalized text with ASCII
// in their place. Comments and file names do not change.
#pragma once

#include "grammar/ast/text_map.h"
#include "grammar/lsys/impl/parse_session.h"

#include <memory>
#include <string>

namespace lsys {

/// The text for the scan of a file. `scanned` refers to `draft`, `valid_utf8` and `map`.
struct NormalizedText {
    /// Copy with pasted text and forms of other languages replaced; null if the file has none.
    std::unique_ptr<std::string> draft;
    /// Copy with invalid UTF-8 replaced by blanks; null or empty if the file has none.
    std::unique_ptr<std::string> valid_utf8;
    std::unique_ptr<TextMap> map; // null if no character is replaced
    ScannedText scanned;
    /// Value of the first `#set names` of the file.
    ModuleNames names = ModuleNames::Words;
    bool is_incomplete = false; // a statement was left out
};

/// Normalizes a file; reports to the diagnostics of `context`. The result refers to the text of the
/// file and has characters beyond ASCII only in comments, file names and back quotes.
[[nodiscard]] NormalizedText normalize_source(FileId file, const ParseContext& context);

/// The text of a translation, which already is ASCII outside of back quotes.
[[nodiscard]] NormalizedText normalize_source(const Translation& translation,
                                              const ParseContext& context);

namespace lsys_grammar {

/// Handles a character beyond ASCII in the scanner. A scan before the parse records the character
/// and overwrites its last bytes with its normalized form; the parse reports the character. Returns
/// the number of bytes to skip.
int normalize_character(ParseSession& session, char* character, int length);
/// Records a letter beyond ASCII that continues the current word, for example the ligature U+FB01
/// (fi) in a `#define` copied from a PDF.
void normalize_after_word(ParseSession& session);
/// Records the confusables of the current name in back quotes. In a translation they are errors,
/// because .lsys would read the name as a different one.
void normalize_quoted(ParseSession& session, std::string_view text);

} // namespace lsys_grammar
} // namespace lsys
