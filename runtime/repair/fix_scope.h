// SPDX-License-Identifier: MIT
// The files that `lsc check --fix` may write.
#pragma once

#include <filesystem>
#include <set>
#include <span>
#include <string>

namespace lsys::repair {

/// The files that may be written: files named by the user, and files in the folder of the grammar
/// or below. Other included files stay unchanged. Symbolic links and `..` are resolved.
class FixScope {
public:
    /// `named`: the files of the command line, including `path`. Standard input (`-`) counts as
    /// a file of the current folder.
    FixScope(const std::string& path, std::span<const std::string> named);
    /// Whether the existing file at `path` may be written.
    [[nodiscard]] bool contains(const std::string& path) const;

private:
    std::string root_;                      // path of the grammar, as shown_path()
    std::filesystem::path folder_;          // the folder of the grammar, without links
    std::set<std::filesystem::path> named_; // the named files, without links
};

} // namespace lsys::repair
