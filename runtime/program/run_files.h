// SPDX-License-Identifier: MIT
// RunFiles: the files that a run reads and writes, so that no output replaces an input, or another
// output, by mistake.
#pragma once

#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

/// The reason to refuse to write a file that the run has read.
constexpr std::string_view kIsInput = "it is an input of this command";

/// Files by their paths with symbolic links resolved. Thread-safe.
class RunFiles {
public:
    /// Records that the run reads a file.
    void note_read(const std::string& path);
    /// Whether the run has read a file.
    [[nodiscard]] bool is_read(const std::string& path);
    /// Records that the run writes a file. Returns the reason to refuse it, or nothing: the run
    /// has read the file, or has written it before.
    [[nodiscard]] std::string_view begin_write(const std::string& path);

private:
    std::mutex mutex_; // guards all members
    std::set<std::string> read_;
    std::set<std::string> written_;
};

/// Records that the run reads these files, whether or not it does; null: nowhere.
void note_read(RunFiles* files, const std::vector<std::string>& paths);

} // namespace lsys
