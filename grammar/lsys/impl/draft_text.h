// SPDX-License-Identifier: MIT
// The step before the scan of a file: finds pasted text and forms of other languages, reports each
// once and replaces it by the intended .lsys in a copy of the text, so that it causes no further
// diagnostics. A replacement has the length of the text that it replaces, so places do not change.
// A text without mistakes is never changed: every form that is searched for is an error of the
// language.
#pragma once

#include "grammar/base/diagnostic.h"
#include "grammar/base/source.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lsys::lsys_grammar {

/// A line that does not begin inside a statement or a comment.
struct FreeLine {
    std::size_t begin = 0;
    std::size_t end = 0;   // end of the line, without its line end
    std::string_view text; // text of the line without blanks at its ends
};

/// A copy of the text of a file that is being repaired.
struct DraftText {
    FileId file = kNoFile;
    std::string text;
    Diagnostics& diagnostics;
    /// The text with comments replaced by blanks and text in back quotes replaced by letters.
    std::string masked;
    bool is_changed = false;     // `text` differs from the file
    bool is_incomplete = false;  // a statement is left out
    std::vector<FreeLine> lines; // result of free_lines()
    bool has_free_lines = false; // `lines` is up to date with `text`

    [[nodiscard]] SourceSpan span(std::size_t begin, std::size_t end) const {
        return {file, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)};
    }
    Diagnostic& report(DiagnosticCode code, SourceSpan span, std::string message) {
        return diagnostics.add(code, span, std::move(message));
    }
    /// Replaces the character at `at`.
    void put(std::size_t at, char c) {
        text[at] = c;
        masked[at] = c;
        is_changed = true;
        has_free_lines = false;
    }
    /// Updates `masked` from `text`.
    void mask();
    /// Writes blanks over [begin, end), except for line ends.
    void blank(std::size_t begin, std::size_t end);
    /// Writes `replacement` and blanks over [begin, end) if it fits; returns whether it does.
    bool replace(std::size_t begin, std::size_t end, std::string_view replacement);
    /// The lines between statements, in order. The list stays valid until the next call. A change
    /// of `text` does not update the list, but FreeLine::text shows the changed bytes.
    [[nodiscard]] const std::vector<FreeLine>& free_lines();
};

/// The text of a statement, from its `#` to its `;` or, without one, to the next statement.
struct StatementText {
    std::size_t begin = 0;
    std::size_t end = 0; // offset of the `;`, else of the next statement or the end of the text
};

/// Whether blanks, a `#` and a word follow `at`.
[[nodiscard]] bool is_statement_start(std::string_view text, std::size_t at);
/// The statement whose `#` is at `at`.
[[nodiscard]] StatementText statement_at(std::string_view text, std::size_t at);
/// `text` without blanks at its ends.
[[nodiscard]] std::string_view stripped(std::string_view text);
/// The offset of the line end at or after `at`; the size of the text in the last line.
[[nodiscard]] std::size_t end_of_line(std::string_view text, std::size_t at);
/// The offset of the first character of the line of `at`.
[[nodiscard]] std::size_t start_of_line(std::string_view text, std::size_t at);

/// Repairs pasted text: markers of a merge conflict, a diff, a Markdown fence, line numbers, HTML,
/// line ends of old Macs, and lines in the notation of books and other programs.
void repair_pasted_text(DraftText& draft);
/// Repairs statement forms of other languages: `{ return x; }`, `c ? a : b`, `A(l, w = 1)`.
void repair_foreign_forms(DraftText& draft);

} // namespace lsys::lsys_grammar
