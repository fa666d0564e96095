// SPDX-License-Identifier: MIT
// RepairAttempt: one attempt of `lsc check --fix`. Finds doubtful statements, whose repair is wrong
// or ambiguous; fixes.cpp repeats the attempt without them.
#pragma once

#include "grammar/base/diagnostic.h"
#include "grammar/base/result.h"
#include "grammar/base/source.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/pipeline/project.h"
#include "runtime/repair/chosen_fixes.h"
#include "runtime/repair/edited_file.h"
#include "runtime/repair/fixes.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace lsys::repair {

inline constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// A statement of the original text: path of its file and index in EditedFile::statements().
using StatementKey = std::pair<std::string, std::size_t>;

struct AppliedFix {
    DiagnosticCode code{};
    std::string path;         // file of the first edit
    std::uint32_t place = 0;  // offset of the first edit in the original text
    char added = '\0';        // the sign that the fix adds; 0 if it does anything else
    bool may_be_slip = false; // the mistake may be one mistyped character
};

/// The grammar to repair, and the options of the repair.
struct RepairSubject {
    const std::string& path;
    const GrammarText& text;
    const GrammarOptions& options;
    const FixScope& scope;
    const Project& project;
    FixChoice choice = FixChoice::Certain;
};

/// Compiles the grammar with the files of `changed` in place of those on disk.
[[nodiscard]] Result<void> compile_changed(const RepairSubject& subject,
                                           const std::map<std::string, std::string>& changed,
                                           CompiledText& compiled);

/// Repairs a grammar except for the excluded statements. With `excludes_all` it applies no fix.
class RepairAttempt {
public:
    RepairAttempt(const RepairSubject& subject,
                  const std::set<StatementKey>& excluded,
                  bool excludes_all)
        : subject_(subject), excluded_(excluded), excludes_all_(excludes_all) {}

    /// Applies fixes until none is left that may be applied.
    [[nodiscard]] Result<void> run();
    /// Repaired statements with errors after the repair; with FixChoice::Offered only new errors
    /// count.
    [[nodiscard]] std::set<StatementKey> wrong_statements() const;
    /// Repaired statements with plausible alternatives (repair_attempt_ambiguous.cpp).
    [[nodiscard]] std::set<StatementKey> ambiguous_statements() const;
    /// Turns the fixes of `diagnostics`, which belong to the original text, into offers unless this
    /// attempt has applied them.
    void offer_doubtful(Diagnostics& diagnostics, const SourceMap& sources) const;
    [[nodiscard]] FixedGrammar take() { return std::move(fixed_); }

private:
    using Errors = std::set<std::pair<DiagnosticCode, std::string>>; // codes and messages

    void read_files();           // adds files read for the first time to files_
    void read_syntax_errors();   // sets with_syntax_errors_
    void read_original_errors(); // sets original_errors_ and original_counts_
    /// Edits the files and notes what was fixed.
    void apply(const ChosenFixes& chosen);
    /// Whether scope, message levels and excluded statements allow a fix; notes files out of scope.
    [[nodiscard]] bool may_apply(const Diagnostic& diagnostic, const Fix& fix);
    /// Statements that the span touches.
    [[nodiscard]] std::vector<StatementKey> statements_at(SourceSpan span) const;
    [[nodiscard]] std::vector<StatementKey> statements_of(const Fix& fix) const;
    [[nodiscard]] bool
    has_alternative(const StatementKey& key, const AppliedFix& fix, bool is_single) const;
    [[nodiscard]] bool may_be_mistyped(const AppliedFix& fix) const; // the sign that the fix added
    /// The codes of which the original has exactly one repaired mistake.
    [[nodiscard]] std::set<DiagnosticCode> codes_of_single_mistakes() const;
    /// Compiles the repaired grammar with `text` in place of one file. Returns nullopt if that
    /// gives more errors, more warnings or the same program.
    [[nodiscard]] std::optional<CompiledText> compile_other(const std::string& path,
                                                            std::string_view text) const;
    /// The place of a statement now; nullopt if the fixes split or removed it.
    [[nodiscard]] std::optional<TextPlace> place_after_fixes(const StatementKey& key) const;
    [[nodiscard]] const SourceFile* find_source(const std::string& path) const;

    const RepairSubject& subject_;
    const std::set<StatementKey>& excluded_;
    bool excludes_all_;
    FixedGrammar fixed_;
    std::map<std::string, EditedFile> files_;   // by path
    std::set<StatementKey> with_syntax_errors_; // statements with syntax errors in the last round
    std::map<StatementKey, Errors> original_errors_; // errors of the original text, by statement
    /// Number of diagnostics of the original text, by code.
    std::map<DiagnosticCode, std::size_t> original_counts_;
    std::map<StatementKey, std::vector<AppliedFix>> applied_; // by statement
    /// Path, offset and code of each repair, which FixChoice::Offered does not repeat.
    std::set<std::tuple<std::string, std::uint32_t, DiagnosticCode>> repaired_places_;
};

} // namespace lsys::repair
