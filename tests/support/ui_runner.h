// SPDX-License-Identifier: MIT
// Runs golden cases in-process, and compares their output with the golden files beside them.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace lsys::tests {

struct UiOptions {
    std::filesystem::path root;       // tests/ui
    std::vector<std::string> filters; // parts of `feature/fact`; empty: all cases run
    bool bless = false;               // rewrite the expected files
    bool verbose = false; // print the name of each case before it runs, to identify a crash
};

struct UiOutcome {
    std::size_t case_count = 0;
    std::vector<std::string> failures; // each names its case
    std::vector<std::string> blessed;  // files that were rewritten or removed
    std::set<std::string> codes;       // codes in all annotations
};

/// A case whose command is in a table and not in the case's file.
struct ListedCase {
    std::string name;
    std::filesystem::path file;
    std::vector<std::string> words; // words of the command; `%` and `%t` as in a case
};

/// Runs each listed case on a temporary copy of its files. Compares standard error with
/// `<file>.stderr`, and the text after `check --fix` with `<file>.fixed`.
[[nodiscard]] UiOutcome run_listed_cases(const std::vector<ListedCase>& cases,
                                         const UiOptions& options);

/// Runs those cases `<feature>/<fact>.lsys` and `<feature>/<fact>.toml` below `root` that a filter
/// selects.
[[nodiscard]] UiOutcome run_ui_cases(const UiOptions& options);

} // namespace lsys::tests
