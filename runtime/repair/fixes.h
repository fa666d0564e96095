// SPDX-License-Identifier: MIT
// `lsc check --fix`: applies the certain fixes of a grammar and its included files in memory until
// none is left. Rules that keep the meaning intended by the author:
//
// 1. A fix is certain (Fix::machine_applicable) if its diagnostic has no other plausible repair.
// 2. A statement is not changed if one of its syntax errors has no certain fix
//    (ParseSession::offer_doubtful_fixes).
// 3. Warnings are fixed after all errors, because errors may cause warnings.
// 4. The fixes of a statement are applied and undone together. They are undone if the repaired
//    statement has an error. Typographic characters are always replaced, each independently of
//    other fixes.
// 5. A bracket or comma is repaired only if each alternative gives errors, the same meaning or more
//    warnings (alternative_repairs.h).
// 6. A mistake that is made once may be a slip of the hand: one character typed for another. Then a
//    sign is added only if it cannot stand in place of a character beside it (mistyped_signs.h),
//    and a single character is neither removed, unless it is doubled, nor read as a longer operator
//    or a name. A mistake that is made twice is a habit and is repaired.
//
// With FixChoice::Offered the first repair of every message is applied, certain or not. Only rule 3
// applies, and repairs that cause new errors are undone. A place is repaired at most once for each
// code.
//
// Fixes that are not applied become offers: shown as help, and not machine-applicable in JSON.
#pragma once

#include "grammar/base/result.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/pipeline/project.h"
#include "runtime/repair/fix_scope.h"

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace lsys::repair {

struct FixedGrammar {
    /// The new bytes of each changed file, by path.
    std::map<std::string, std::string> changed;
    /// The first kMaxFixLines fixes, one per line: `tree.lsys:7:26: fixed: write A S(1) [code]`.
    std::vector<std::string> lines;
    /// All fixes as lines of JSON. Places refer to the text just before the fix was applied.
    std::string records;
    std::uint64_t fix_count = 0; // number of applied fixes
    /// Files with certain fixes that are outside the scope.
    std::set<std::string> out_of_scope;
    /// The compiled repaired text with the remaining diagnostics, whose fixes are not
    /// machine-applicable.
    CompiledText compiled;
};
inline constexpr std::size_t kMaxFixLines = 50;

/// The repairs that are applied: certain ones only, or the first one that each message offers.
enum class FixChoice : std::uint8_t { Certain, Offered };

/// Repairs `text`, the contents of the file `path`, and its included files within `scope`. Keeps
/// byte order marks and CRLF line ends. Error: the grammar cannot be compiled, for example because
/// of its options.
[[nodiscard]] Result<void> fix_text(const std::string& path,
                                    const GrammarText& text,
                                    const GrammarOptions& options,
                                    const FixScope& scope,
                                    const Project& project,
                                    FixChoice choice,
                                    FixedGrammar& fixed);

/// Clears Fix::machine_applicable of the fixes in `compiled`, the result of compiling `text`, that
/// fix_text() would not apply.
[[nodiscard]] Result<void> offer_doubtful_fixes(const std::string& path,
                                                const GrammarText& text,
                                                const GrammarOptions& options,
                                                const FixScope& scope,
                                                const Project& project,
                                                CompiledText& compiled);

} // namespace lsys::repair
