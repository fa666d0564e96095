// SPDX-License-Identifier: MIT
// tests_ui [--bless] [-v] [--root FOLDER] [FILTER...]: runs the golden cases whose
// `feature/fact.lsys` or `feature/fact.toml` contains a FILTER. tests_ui --codes: lists the
// diagnostics that no case shows, and fails if there are any.
#include "grammar/base/diagnostic.h"
#include "tests/support/ui_runner.h"

#include <cstdio>
#include <filesystem>
#include <string>

namespace {

/// Prints the codes for which no case has an annotation. Returns the exit status: 1 if there are
/// any.
int list_missing_codes(const lsys::tests::UiOutcome& outcome) {
    int missing = 0;
    for (std::uint32_t i = 0; i < lsys::diagnostic_code_count(); ++i) {
        const std::string name(lsys::info(static_cast<lsys::DiagnosticCode>(i)).name);
        // A case of this diagnostic would need a grammar of more than 100 MB.
        const bool is_exempt = name == "program-too-large";
        if (!is_exempt && !outcome.codes.contains(name)) {
            std::printf("no case in tests/ui shows %s\n", name.c_str());
            ++missing;
        }
    }
    return missing == 0 ? 0 : 1;
}

} // namespace

int main(int argc, char** argv) {
    lsys::tests::UiOptions options;
    options.root = LSYS_SOURCE_DIR "/tests/ui";
    bool codes = false;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (word == "--bless") {
            options.bless = true;
        } else if (word == "-v") {
            options.verbose = true;
        } else if (word == "--codes") {
            codes = true;
        } else if (word == "--root" && i + 1 < argc) {
            options.root = std::filesystem::absolute(argv[++i]);
        } else {
            options.filters.push_back(word);
        }
    }
    const lsys::tests::UiOutcome outcome = lsys::tests::run_ui_cases(options);
    for (const std::string& file : outcome.blessed) {
        std::printf("blessed %s\n", file.c_str());
    }
    if (codes) {
        return list_missing_codes(outcome);
    }
    for (const std::string& failure : outcome.failures) {
        std::printf("FAILED %s\n", failure.c_str());
    }
    std::printf("%zu cases, %zu failures\n", outcome.case_count, outcome.failures.size());
    return outcome.failures.empty() && outcome.case_count > 0 ? 0 : 1;
}
