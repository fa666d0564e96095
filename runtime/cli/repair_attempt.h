// One attempt of `lsc check --fix` to repair a grammar, and what it finds to be wrong with it. Made
// by fixes.cpp, which tries again without the statements that were not repaired well.
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
#include <utility>
#include <vector>

namespace lsys::lsc {

inline constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// A statement of the text before all fixes: path and number.
using StatementKey = std::pair<std::string, std::size_t>;

struct AppliedFix {
    DiagnosticCode code{};
    std::string path;        // of the first edit
    std::uint32_t place = 0; // of the first edit, in the text before all fixes
};

/// What is repaired, and how it is read.
struct RepairSubject {
    const std::string& path;
    const GrammarText& text;
    const GrammarOptions& options;
    const FixScope& scope;
    const Project& project;
};

/// Compiles the grammar with the files of `changed` in place of those on the disk.
[[nodiscard]] Result<void> compile_changed(const RepairSubject& subject,
                                           const std::map<std::string, std::string>& changed,
                                           CompiledText& compiled);

/// The repair of a grammar without the fixes of some statements.
class RepairAttempt {
public:
    RepairAttempt(const RepairSubject& subject, const std::set<StatementKey>& kept, bool keeps_all)
        : subject_(subject), kept_(kept), keeps_all_(keeps_all) {}

    /// Applies fixes until none is left.
    [[nodiscard]] Result<void> run();
    /// Repaired statements that are still wrong.
    [[nodiscard]] std::set<StatementKey> wrong() const;
    /// Repaired statements that may have been meant otherwise (repair_rivals.cpp).
    [[nodiscard]] std::set<StatementKey> ambiguous() const;
    /// Offers the fixes of `diagnostics`, those of the text before all fixes, that were not
    /// applied.
    void offer_doubtful(Diagnostics& diagnostics, const SourceMap& sources) const;
    [[nodiscard]] FixedGrammar take() { return std::move(fixed_); }

private:
    using Errors = std::set<std::pair<DiagnosticCode, std::string>>;

    void read_files();
    void read_syntax_errors();
    void read_first_errors();
    void apply(const ChosenFixes& chosen);
    [[nodiscard]] bool may_apply(const Diagnostic& diagnostic, const Fix& fix);
    [[nodiscard]] std::vector<StatementKey> statements_at(SourceSpan span) const;
    [[nodiscard]] std::vector<StatementKey> statements_of(const Fix& fix) const;
    [[nodiscard]] bool has_rival(const StatementKey& key, const AppliedFix& fix) const;
    [[nodiscard]] std::optional<TextPlace> present_place(const StatementKey& key) const;
    [[nodiscard]] const SourceFile* find_source(const std::string& path) const;

    const RepairSubject& subject_;
    const std::set<StatementKey>& kept_;
    bool keeps_all_;
    FixedGrammar fixed_;
    std::map<std::string, EditedFile> files_;
    std::set<StatementKey> with_syntax_errors_; // of the last round
    std::map<StatementKey, Errors> first_errors_;
    std::map<StatementKey, std::vector<AppliedFix>> applied_;
};

} // namespace lsys::lsc
