// The files that `lsc check --fix` may write.
#pragma once

#include <filesystem>
#include <set>
#include <span>
#include <string>

namespace lsys::lsc {

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

} // namespace lsys::lsc
