// SPDX-License-Identifier: MIT
// Diagnostics: messages to the author of a grammar, as data. Checks append them; the renderer
// prints them as frames, lines or JSON. They hold no line numbers, no colours and no text of the
// file.
#pragma once

#include "grammar/base/source.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace lsys {

enum class Severity : std::uint8_t { Note, Warning, Error };

/// One enumerator per row of diagnostics.def.
enum class DiagnosticCode : std::uint16_t {
#define LSYS_DIAGNOSTIC(identifier, severity, name, meaning) identifier,
#include "grammar/base/diagnostics.def"
#undef LSYS_DIAGNOSTIC
};

/// A row of diagnostics.def: usual severity, stable name (`unknown-name`) and one-line meaning.
struct DiagnosticInfo {
    Severity severity;
    std::string_view name;
    std::string_view meaning;
};

[[nodiscard]] const DiagnosticInfo& info(DiagnosticCode code);
[[nodiscard]] std::uint32_t diagnostic_code_count();
[[nodiscard]] std::optional<DiagnosticCode> find_diagnostic_code(std::string_view name);
[[nodiscard]] std::string_view severity_name(Severity severity);

/// A further place of a diagnostic, with an explanation.
struct Label {
    SourceSpan span;
    std::string text;
};

/// A replacement of the bytes of `span`.
struct Edit {
    SourceSpan span;
    std::string replacement;
};

/// A repair. It is machine applicable if no other repair is plausible; `lsc check --fix` applies it
/// under the conditions of runtime/repair/fixes.h. Other repairs are offers, shown as help. The
/// edits do not overlap and are applied together.
struct Fix {
    std::string title;
    std::vector<Edit> edits;
    bool machine_applicable = true;
};

/// A named value of a diagnostic for programs that read JSON: `generation`, 3.
struct Fact {
    std::string name;
    std::variant<bool, std::uint64_t, double, std::string> value;
};

/// Texts begin in lower case, have no final stop and put names in back quotes. `message` states the
/// mistake, `help` the remedy.
struct Diagnostic {
    DiagnosticCode code{};
    Severity severity = Severity::Error;
    SourceSpan span;
    std::string message;
    std::string label;         // under the caret; may be empty
    std::vector<Label> labels; // other places
    std::vector<std::string> notes;
    std::vector<std::string> help;
    std::vector<Fix> fixes;
    std::vector<Fact> facts; // shown in JSON only; the texts state the same facts
};

/// Adds a fix of one edit, which replaces `span`.
void add_fix(Diagnostic& diagnostic,
             std::string title,
             SourceSpan span,
             std::string replacement,
             bool is_machine_applicable);
/// Whether a fix of the diagnostic is machine applicable.
[[nodiscard]] bool has_certain_fix(const Diagnostic& diagnostic);
/// Turns all fixes of the diagnostic into offers.
void offer_fixes(Diagnostic& diagnostic);

/// A diagnostic with its code's usual severity.
[[nodiscard]] Diagnostic make_diagnostic(DiagnosticCode code, SourceSpan span, std::string message);

/// An append-only list in order of discovery. It stores the first kMaxStored diagnostics and counts
/// the rest, which bounds the memory for files with millions of mistakes.
class Diagnostics {
public:
    static constexpr std::size_t kMaxStored = 100'000;

    /// The reference is valid until the next add().
    Diagnostic& add(Diagnostic diagnostic);
    Diagnostic& add(DiagnosticCode code, SourceSpan span, std::string message);

    /// Whether one more diagnostic would be stored. If not, it is counted with the code's usual
    /// severity, and the caller need not compose its message.
    [[nodiscard]] bool admits(DiagnosticCode code);

    [[nodiscard]] const std::vector<Diagnostic>& all() const { return all_; }
    /// The number of diagnostics added, stored or not.
    [[nodiscard]] std::uint64_t count(Severity severity) const {
        return counts_[static_cast<std::size_t>(severity)];
    }
    [[nodiscard]] bool has_errors() const { return count(Severity::Error) != 0; }

    /// Sorts by file id, begin of the span and severity, errors first; stable. Drops duplicates.
    void sort_by_place();
    /// Whether an error from index `first` on has no certain fix.
    [[nodiscard]] bool has_doubtful_error_from(std::size_t first) const;
    /// Turns the fixes of all diagnostics from index `first` on into offers.
    void offer_fixes_from(std::size_t first);
    /// Turns the fixes of the diagnostics that satisfy `is_doubtful` into offers.
    template <typename Predicate>
    void offer_fixes_where(const Predicate& is_doubtful) {
        for (Diagnostic& diagnostic : all_) {
            if (is_doubtful(diagnostic)) {
                offer_fixes(diagnostic);
            }
        }
    }
    /// Removes repairs that propose .lsys text, for a file of a dialect: help texts that contain
    /// `pattern`, and all fixes except those whose replacements are names of two or more
    /// characters without `_`. The remaining fixes become offers.
    void drop_repairs(std::string_view pattern);
    /// Gives each diagnostic the severity that `severity_of` returns for it, or removes it.
    template <typename SeverityOf>
    void reassign_severities(const SeverityOf& severity_of) {
        std::size_t kept_count = 0;
        for (std::size_t i = 0; i < all_.size(); ++i) {
            const std::optional<Severity> severity = severity_of(std::as_const(all_[i]));
            --counts_[static_cast<std::size_t>(all_[i].severity)];
            if (!severity) {
                continue;
            }
            ++counts_[static_cast<std::size_t>(*severity)];
            all_[i].severity = *severity;
            if (kept_count != i) {
                all_[kept_count] = std::move(all_[i]);
            }
            ++kept_count;
        }
        all_.erase(all_.begin() + static_cast<std::ptrdiff_t>(kept_count), all_.end());
    }
    /// Adds the warnings beyond kMaxStored to the count of errors.
    void promote_unstored_warnings();

private:
    std::vector<Diagnostic> all_;
    Diagnostic overflow_; // returned by add() when no more are stored
    std::array<std::uint64_t, 3> counts_{};
};

/// The first candidate that differs from `wanted` only in letter case; else the candidate nearest
/// by edit distance, if at most a third of the letters of the shorter name differ, and the first of
/// equally near ones. Names of more than 64 letters are compared without letter case only, because
/// the time of edit distances grows with the square of the length. Skips candidates that equal
/// `wanted`.
[[nodiscard]] std::optional<std::string_view>
nearest_name(std::string_view wanted, const std::vector<std::string_view>& candidates);

} // namespace lsys
