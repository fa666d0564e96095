// RepairAttempt: one attempt of `lsc check --fix`. Finds doubtful statements, whose repair is wrong
// or ambiguous; fixes.cpp repeats the attempt without them.
#pragma once

#include "grammar/base/diagnostic.h"
#include "grammar/base/result.h"
#include "grammar/base/source.h"
#include "runtime/cli/chosen_fixes.h"
#include "runtime/cli/edited_file.h"
#include "runtime/cli/fixes.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/pipeline/project.h"

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace lsys::lsc {

inline constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// A statement of the original text: path and index.
using StatementKey = std::pair<std::string, std::size_t>;

struct AppliedFix {
    DiagnosticCode code{};
    std::string path;        // of the first edit
    std::uint32_t place = 0; // of the first edit, in the original text
};

/// The grammar to repair and its options.
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

/// The repair of a grammar without its excluded statements.
class RepairAttempt {
public:
    RepairAttempt(const RepairSubject& subject,
                  const std::set<StatementKey>& excluded,
                  bool excludes_all)
        : subject_(subject), excluded_(excluded), excludes_all_(excludes_all) {}

    /// Applies fixes until none is left.
    [[nodiscard]] Result<void> run();
    /// Repaired statements that are still wrong.
    [[nodiscard]] std::set<StatementKey> wrong_statements() const;
    /// Repaired statements with plausible alternatives (repair_attempt_ambiguous.cpp).
    [[nodiscard]] std::set<StatementKey> ambiguous_statements() const;
    /// Turns the fixes of `diagnostics`, of the original text, into offers unless they were
    /// applied.
    void offer_doubtful(Diagnostics& diagnostics, const SourceMap& sources) const;
    [[nodiscard]] FixedGrammar take() { return std::move(fixed_); }

private:
    using Errors = std::set<std::pair<DiagnosticCode, std::string>>;

    void read_files();
    void read_syntax_errors();
    void read_original_errors();
    void apply(const ChosenFixes& chosen);
    [[nodiscard]] bool may_apply(const Diagnostic& diagnostic, const Fix& fix);
    [[nodiscard]] std::vector<StatementKey> statements_at(SourceSpan span) const;
    [[nodiscard]] std::vector<StatementKey> statements_of(const Fix& fix) const;
    [[nodiscard]] bool has_alternative(const StatementKey& key, const AppliedFix& fix) const;
    [[nodiscard]] std::optional<TextPlace> place_after_fixes(const StatementKey& key) const;
    [[nodiscard]] const SourceFile* find_source(const std::string& path) const;

    const RepairSubject& subject_;
    const std::set<StatementKey>& excluded_;
    bool excludes_all_;
    FixedGrammar fixed_;
    std::map<std::string, EditedFile> files_;
    std::set<StatementKey> with_syntax_errors_; // of the last round
    std::map<StatementKey, Errors> original_errors_;
    std::map<StatementKey, std::vector<AppliedFix>> applied_;
    std::set<std::tuple<std::string, std::uint32_t, DiagnosticCode>> repaired_places_; // if offered
};

} // namespace lsys::lsc
