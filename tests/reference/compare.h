// Holds `lsc` against the oracle: writes the files of a case into a temporary folder, runs the
// program in-process and compares every generation as text.

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

// `lsc ARGUMENTS...`
Run run_lsc(const std::vector<std::string>& arguments);

// A folder of its own, removed at the end.
class TemporaryFolder {
public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    // Writes the files of a grammar; the result is the path of the first.
    std::string write(const Grammar& grammar, std::uint64_t layout_seed) const;

private:
    std::filesystem::path path_;
};

// The options that say the same as the request of `made`.
std::vector<std::string> options_of(const Request& request);

// Every generation on a line, as `dump --all` prints it.
std::string all_generations(const Grammar& grammar, const Derivation& derivation);

// The words from generation `first` on, each with its modules as `dump --all --origins` prints them
// for the files in `folder`. Modules as old as `saved`, which must not be after `first`, come from
// a saved state.
std::string all_origins(const Case& made,
                        const Derivation& derivation,
                        const std::filesystem::path& folder,
                        std::uint32_t first,
                        std::optional<std::uint32_t> saved);

// Derives `made` with the oracle and in several ways with `lsc`. Empty if all agree, else what to
// print: the command, the grammar and the first difference.
std::string difference(const Case& made);

} // namespace lsys::reference
