// SPDX-License-Identifier: MIT
// In-process runs of `lsc`, and helpers of their tests.
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

/// The number in a row of `lsc export --stats`; -1 if the row is missing.
[[nodiscard]] long stated_number(const std::string& stats, const std::string& row);

/// The bytes of a file, which must exist.
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
    /// The path of a file in it, as an argument.
    [[nodiscard]] std::string operator/(std::string_view name) const;
    /// Count of files and folders directly in it.
    [[nodiscard]] std::size_t file_count() const;

private:
    std::filesystem::path path_;
};

/// A sample of the gallery: samples/NAME/NAME.lsys or samples/species/NAME/NAME.lsys.
struct Sample {
    std::filesystem::path file;
    std::vector<std::vector<std::string>> runs; // with the name of the file inserted
    std::string counts;                         // one per line, as printed by --all --count
    std::size_t counts_size = 0;                // number of counts
    bool declares_warnings = false;
};
[[nodiscard]] std::vector<Sample> all_samples();

} // namespace lsys::tests
