// Messages to a grammar's author, as data. Checks append Diagnostics; the renderer turns them into
// frames, lines or JSON. A diagnostic holds no line numbers, no colours and no text of the file.
#pragma once

#include "grammar/base/source.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

enum class Severity : std::uint8_t { Note, Warning, Error };

/// One enumerator for each row of diagnostics.def.
enum class DiagnosticCode : std::uint16_t {
#define LSYS_DIAGNOSTIC(identifier, severity, name, meaning) identifier,
#include "grammar/base/diagnostics.def"
#undef LSYS_DIAGNOSTIC
};

/// A row of diagnostics.def: the stable name (`unknown-name`), usual severity and one-line meaning.
struct DiagnosticInfo {
    Severity severity;
    std::string_view name;
    std::string_view meaning;
};

[[nodiscard]] const DiagnosticInfo& info(DiagnosticCode code);
[[nodiscard]] std::uint32_t diagnostic_code_count();
[[nodiscard]] std::optional<DiagnosticCode> find_diagnostic_code(std::string_view name);
[[nodiscard]] std::string_view severity_name(Severity severity);

/// A second place of a message, with what is to be seen there.
struct Label {
    SourceSpan span;
    std::string text;
};

/// Replace the bytes of `span` by `replacement`.
struct Edit {
    SourceSpan span;
    std::string replacement;
};

/// A repair. It is machine applicable where nothing else can have been meant: `lsc check --fix`
/// then applies it, under the conditions of runtime/cli/fixes.h. All others are offered: shown, for
/// the author to decide. The edits do not overlap and all belong together.
struct Fix {
    std::string title;
    std::vector<Edit> edits;
    bool machine_applicable = true;
};

/// lower case, no final stop, names in back quotes; `message` says what is wrong, `help` what to
/// do.
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
};

/// Adds a fix of one edit, which replaces `span`.
void add_fix(Diagnostic& diagnostic,
             std::string title,
             SourceSpan span,
             std::string replacement,
             bool is_machine_applicable);
/// Whether one of the fixes of a diagnostic is machine applicable.
[[nodiscard]] bool has_certain_fix(const Diagnostic& diagnostic);
/// Leaves all fixes of a diagnostic as offers.
void offer_fixes(Diagnostic& diagnostic);

/// A diagnostic with its code's usual severity.
[[nodiscard]] Diagnostic make_diagnostic(DiagnosticCode code, SourceSpan span, std::string message);

/// The sink: append only, in order of discovery. It stores the first kMaxStored and counts the
/// rest, so that a file of a hundred million mistakes is reported in little memory.
class Diagnostics {
public:
    static constexpr std::size_t kMaxStored = 100'000;

    /// The reference is valid until the next add().
    Diagnostic& add(Diagnostic diagnostic);
    Diagnostic& add(DiagnosticCode code, SourceSpan span, std::string message);

    /// Whether one more would be stored. If not, it is counted here and now with the code's usual
    /// severity, and the caller need not write a message that nobody reads.
    [[nodiscard]] bool admits(DiagnosticCode code);

    [[nodiscard]] const std::vector<Diagnostic>& all() const { return all_; }
    /// All that were added, stored or not.
    [[nodiscard]] std::uint64_t count(Severity severity) const {
        return counts_[static_cast<std::size_t>(severity)];
    }
    [[nodiscard]] bool has_errors() const { return count(Severity::Error) != 0; }

    /// Sorts by file (in order of ids), place, then severity, keeping discovery order among equals,
    /// and drops exact repetitions.
    void sort_by_place();
    /// Whether an error stored from number `first` on has no certain fix.
    [[nodiscard]] bool has_doubtful_error_from(std::size_t first) const;
    /// Offers the fixes of all diagnostics stored from number `first` on.
    void offer_fixes_from(std::size_t first);
    /// Offers the fixes of the diagnostics that `is_doubtful` holds for.
    template <typename Predicate>
    void offer_fixes_where(const Predicate& is_doubtful) {
        for (Diagnostic& diagnostic : all_) {
            if (is_doubtful(diagnostic)) {
                offer_fixes(diagnostic);
            }
        }
    }
    /// Forgets all repairs, and help that holds `language`: the text is of another language.
    void drop_repairs(std::string_view language);
    /// Turns every warning into an error (`--deny warnings`).
    void promote_warnings();

private:
    std::vector<Diagnostic> all_;
    Diagnostic overflow_; // what add() hands out when nothing more is stored
    std::array<std::uint64_t, 3> counts_{};
};

/// The candidate nearest to `wanted` by edit distance, if it is near enough to be meant; ties go to
/// the earlier candidate.
[[nodiscard]] std::optional<std::string_view>
nearest_name(std::string_view wanted, const std::vector<std::string_view>& candidates);

} // namespace lsys
