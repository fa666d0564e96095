// `lsc check --fix`: applies the certain fixes of a grammar and of the files it includes, in
// memory, until none is left. It never makes another grammar than the author meant:
//
// 1. A fix is certain (Fix::machine_applicable) where its diagnostic knows of no other repair.
// 2. A statement with a syntax error that has no certain fix keeps all its errors
//    (ParseSession::judge_fixes).
// 3. Warnings wait until no error is left, since an error may be their cause.
// 4. The fixes of a statement hold together: if it still has a syntax error after them, or an error
//    that it had not before, all are taken back; where a bracket or comma is repaired, because of
//    any error. But typographic characters are replaced in any
//    case, one by one: the error of another character does not make them doubtful.
// 5. A bracket or comma is repaired where no other repair is as good: each of them gives a
//    statement that does not parse or reads the same, or a grammar with more warnings
//    (other_repairs.h).
//
// What is not applied is offered: shown as help, and not machine applicable in JSON.
#pragma once

#include "grammar/base/result.h"
#include "runtime/cli/fix_scope.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/pipeline/project.h"

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace lsys::lsc {

struct FixedGrammar {
    /// The new bytes of every file that changed, by path.
    std::map<std::string, std::string> changed;
    /// One line a fix: `tree.lsys:7:26: fixed: write A S(1) [code]`; the first kMaxFixLines.
    std::vector<std::string> lines;
    std::uint64_t fix_count = 0;
    /// Files outside the scope that have certain fixes left.
    std::set<std::string> left;
    /// What the mended text compiles to, with the diagnostics that are left; their fixes are
    /// offers.
    CompiledText compiled;
};
inline constexpr std::size_t kMaxFixLines = 50;

/// Mends `text`, that of `path`, and the files that it includes as far as `scope` has them. A byte
/// order mark and CRLF line ends stay.
[[nodiscard]] Result<void> fix_text(const std::string& path,
                                    const GrammarText& text,
                                    const GrammarOptions& options,
                                    const FixScope& scope,
                                    const Project& project,
                                    FixedGrammar& fixed);

/// Turns the fixes of `compiled`, which `text` was compiled to, that fix_text() does not apply into
/// offers.
[[nodiscard]] Result<void> offer_doubtful_fixes(const std::string& path,
                                                const GrammarText& text,
                                                const GrammarOptions& options,
                                                const FixScope& scope,
                                                const Project& project,
                                                CompiledText& compiled);

} // namespace lsys::lsc
