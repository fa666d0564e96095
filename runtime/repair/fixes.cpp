// SPDX-License-Identifier: MIT
#include "runtime/repair/fixes.h"

#include "runtime/repair/impl/repair_attempt.h"

#include <algorithm>
#include <set>
#include <utility>

namespace lsys::repair {

namespace {

/// Max number of attempts that apply fixes, each with more statements excluded. One further attempt
/// applies no fixes.
constexpr int kMaxAttempts = 20;

/// Repeats attempts until all applied fixes are certain, then calls `finish` with the last attempt.
template <typename Finish>
Result<void> repair(const RepairSubject& subject, const Finish& finish) {
    std::set<StatementKey> excluded;
    for (int number = 0;; ++number) {
        RepairAttempt attempt(subject, excluded, number == kMaxAttempts);
        Result<void> done = attempt.run();
        if (!done) {
            return done;
        }
        std::set<StatementKey> doubtful = attempt.wrong_statements();
        if (doubtful.empty()) {
            doubtful = attempt.ambiguous_statements();
        }
        if (doubtful.empty() || subject.project.is_cancelled()) {
            finish(attempt);
            return {};
        }
        excluded.merge(doubtful);
    }
}

} // namespace

Result<void> fix_text(const std::string& path,
                      const GrammarText& text,
                      const GrammarOptions& options,
                      const FixScope& scope,
                      const Project& project,
                      FixChoice choice,
                      FixedGrammar& fixed) {
    return repair({path, text, options, scope, project, choice}, [&](RepairAttempt& attempt) {
        fixed = attempt.take();
        fixed.compiled.diagnostics.offer_fixes_where([](const Diagnostic&) { return true; });
    });
}

Result<void> offer_doubtful_fixes(const std::string& path,
                                  const GrammarText& text,
                                  const GrammarOptions& options,
                                  const FixScope& scope,
                                  const Project& project,
                                  CompiledText& compiled) {
    const std::vector<Diagnostic>& all = compiled.diagnostics.all();
    if (std::none_of(all.begin(), all.end(), has_certain_fix)) {
        return {};
    }
    return repair({path, text, options, scope, project, FixChoice::Certain},
                  [&](RepairAttempt& attempt) {
                      attempt.offer_doubtful(compiled.diagnostics, *compiled.grammar.sources);
                  });
}

} // namespace lsys::repair
