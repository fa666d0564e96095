// SPDX-License-Identifier: MIT
// A golden case: a grammar or scene whose first lines state its runs, and whose annotations state
// its diagnostics. tests/README.md describes the format.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace lsys::tests {

/// A run: the line `// run: dump -n 3`, and the line `// exit: 1` that follows it.
struct UiRun {
    std::vector<std::string> words; // words of the command, with `%` and `%t` unreplaced
    std::string input;              // file for standard input, after `<`; may be empty
    int exit_status = 0;
};

/// An annotation: `//~ error: part of the text [code]`.
struct UiAnnotation {
    std::uint32_t line = 0;       // line of the diagnostic; 0: any line
    std::uint32_t written_at = 0; // line of the annotation
    std::string severity;
    std::string text; // part of the message; may be empty
    std::string code; // may be empty
};

struct UiCase {
    std::filesystem::path file;
    std::vector<UiRun> runs;
    std::vector<UiAnnotation> annotations;
    bool needs_posix = false;          // skipped on Windows
    std::vector<std::string> mistakes; // mistakes in the first lines or in annotations
};

/// Reads the runs and annotations of a case.
[[nodiscard]] UiCase parse_ui_case(const std::filesystem::path& file, std::string_view text);

/// A diagnostic that was printed, in any format.
struct UiDiagnostic {
    std::string file; // empty: the diagnostic has no place
    std::uint32_t line = 0;
    std::string severity;
    std::string message;
    std::string code;
};

/// The diagnostics that `text`, output to standard error in any format, contains. Only the first
/// line of each message is read.
[[nodiscard]] std::vector<UiDiagnostic> parse_diagnostics(std::string_view text);

/// Whether the annotation matches the diagnostic. `name`: the file name of the case.
[[nodiscard]] bool
matches(const UiAnnotation& annotation, const UiDiagnostic& diagnostic, std::string_view name);

/// The words of a text, separated by blanks; single quotes keep blanks in a word.
[[nodiscard]] std::vector<std::string> split_words(std::string_view text);

} // namespace lsys::tests
