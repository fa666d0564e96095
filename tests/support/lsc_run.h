// SPDX-License-Identifier: MIT
// Runs `lsc` in-process; helpers of tests that do so.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace lsys::tests {

struct LscRun {
    int status = 0;
    std::string out;
    std::string err;
};

/// Runs `lsc ARGUMENTS` with `input` as standard input.
[[nodiscard]] LscRun run_lsc(const std::vector<std::string>& arguments, const std::string& input);

/// The number in the row `row` of the output of `lsc export --stats`; -1 if the row is missing.
[[nodiscard]] long stated_number(const std::string& stats, const std::string& row);

/// The bytes of a file. Fails the test if the file does not exist.
[[nodiscard]] std::string read_text(const std::filesystem::path& path);
void write_text(const std::filesystem::path& path, std::string_view text);

/// A temporary folder, removed by the destructor.
class ScratchFolder {
public:
    ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    ~ScratchFolder();
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    /// The path of a file in the folder, as an argument of a command.
    [[nodiscard]] std::string operator/(std::string_view name) const;
    /// Number of files and folders that lie directly in the folder.
    [[nodiscard]] std::size_t file_count() const;

private:
    std::filesystem::path path_;
};

/// A sample of the gallery, samples/NAME/NAME.lsys or samples/species/NAME/NAME.lsys.
struct Sample {
    std::filesystem::path file;
    std::vector<std::vector<std::string>> runs; // arguments of lsc, by `run:` line
    std::string counts;                         // one count per line, as --all --count prints them
    std::size_t counts_size = 0;                // number of counts
    bool declares_warnings = false; // the grammar is as its source printed it, with warnings
};
[[nodiscard]] std::vector<Sample> all_samples();

} // namespace lsys::tests
