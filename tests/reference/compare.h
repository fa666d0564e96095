// SPDX-License-Identifier: MIT
// Compares `lsc` with the oracle: writes the files of a case into a temporary folder, runs `lsc`
// in-process, and compares every generation as text.

#pragma once

#include "tests/reference/derive.h"
#include "tests/reference/generate.h"

#include <filesystem>
#include <string>
#include <vector>

namespace lsys::reference {

struct Run {
    int status = 0;
    std::string out;
    std::string err;
};

// Runs `lsc ARGUMENTS...` in-process.
Run run_lsc(const std::vector<std::string>& arguments);

// A temporary folder, removed by the destructor.
class TemporaryFolder {
public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    // Writes the files of a grammar. Returns the path of the first file.
    std::string write(const Grammar& grammar, std::uint64_t layout_seed) const;

private:
    std::filesystem::path path_;
};

// The options of `lsc` with the same effect as a request.
std::vector<std::string> options_of(const Request& request);

// The expected output of `dump --all`: one generation per line.
std::string all_generations(const Grammar& grammar, const Derivation& derivation);

// The expected output of `dump --all --origins`, from generation `first` on, for the files in
// `folder`; empty: for a compiled grammar, whose files have names relative to the first one. `saved`:
// generation of a saved state, at most `first`. The saved state is the origin of
// all modules that were written up to this generation.
std::string all_origins(const Case& test_case,
                        const Derivation& derivation,
                        const std::filesystem::path& folder,
                        std::uint32_t first,
                        std::optional<std::uint32_t> saved);

// Derives `test_case` with the oracle, and in several ways with `lsc`. Returns an empty text if all
// words agree; else a message with the command, the grammar and the first difference.
std::string difference(const Case& test_case);

// The same for a plant that senses: every generation with one, two and five threads, from a `.lsb`,
// and continued from a saved state.
std::string difference_of_plant(const Case& test_case, const Derivation& derivation);

} // namespace lsys::reference
