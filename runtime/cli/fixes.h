// `lsc check --fix`: applies the machine-applicable fixes of a grammar and of the files it
// includes, in memory, until none is left.
#pragma once

#include "grammar/base/result.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/pipeline/project.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <span>
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
    CompiledText compiled; // the mended text, with the diagnostics that are left
};
inline constexpr std::size_t kMaxFixLines = 50;

/// The files that may be written: those that the user named, and those in the folder of the grammar
/// or below it. A grammar may include any file, which is not to be rewritten for that. Symbolic
/// links and `..` are resolved.
class FixScope {
public:
    /// `named`: the files of the command line, `path` one of them; `-` is in the current folder.
    FixScope(const std::string& path, std::span<const std::string> named);
    /// `path`: of a file that exists.
    [[nodiscard]] bool contains(const std::string& path) const;

private:
    std::string root_; // as messages name it
    std::filesystem::path folder_;
    std::set<std::filesystem::path> named_;
};

/// Mends `text`, that of `path`, and the files that it includes as far as `scope` has them. A byte
/// order mark and CRLF line ends stay.
[[nodiscard]] Result<Done> fix_text(const std::string& path,
                                    const GrammarText& text,
                                    const GrammarOptions& options,
                                    const FixScope& scope,
                                    const Project& project,
                                    FixedGrammar& fixed);

/// Chooses of `diagnostics` the first machine-applicable fix of each, leaving out those that touch
/// one before and those that `scope` does not allow; returns the edits of each file, by path and
/// place, and counts and describes them in `fixed`.
using FileEdits = std::map<std::string, std::vector<const Edit*>>;
[[nodiscard]] FileEdits choose_edits(const Diagnostics& diagnostics,
                                     const SourceMap& sources,
                                     const FixScope& scope,
                                     FixedGrammar& fixed);

/// `text` with the edits applied; they are in order of place and do not overlap. A line feed of a
/// replacement becomes CRLF where the text has CRLF.
[[nodiscard]] std::string apply_edits(std::string_view text, const std::vector<const Edit*>& edits);

} // namespace lsys::lsc
