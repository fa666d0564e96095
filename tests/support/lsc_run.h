// `lsc` run in-process by tests, and small things that such tests share.
#pragma once

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

/// The number in a row of `lsc export --stats`; -1: no such row.
[[nodiscard]] long stated(const std::string& stats, const std::string& row);

/// The whole file; it must be there.
[[nodiscard]] std::string read_text(const std::filesystem::path& path);
void write_text(const std::filesystem::path& path, std::string_view text);

/// A folder for what a test writes, gone in the end.
class ScratchFolder {
public:
    ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    ~ScratchFolder();
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    /// The name of a file in it, as an argument.
    [[nodiscard]] std::string operator/(std::string_view name) const;

private:
    std::filesystem::path path_;
};

/// A sample of the gallery: samples/NAME/NAME.lsys.
struct Sample {
    std::filesystem::path file;
    std::vector<std::vector<std::string>> runs; // with the file's name put in
    std::string counts;                         // one a line, as --all --count prints them
    std::size_t count_count = 0;
    bool declares_warnings = false;
};
[[nodiscard]] std::vector<Sample> all_samples();

} // namespace lsys::tests
