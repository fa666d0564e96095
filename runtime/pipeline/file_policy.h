// SPDX-License-Identifier: MIT
// FilePolicy: which files grammars and scenes may name. SECURITY.md is the threat model.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace lsys {

struct FilePolicy {
    /// Files that grammars and scenes name must lie in `root` or below: no absolute path, no `..`
    /// and no symbolic link leads out, and only regular files are read. Programs of environments
    /// are not started.
    bool is_untrusted = false;
    /// The folder of the files; empty: the folders of `named`. The current folder is ".".
    std::string root;
    /// Files that the user names, which may lie anywhere.
    std::vector<std::string> named;
    /// The option that sets `root`, for messages.
    std::string root_option = "--root";
    /// Max number and max bytes of the files that one grammar includes.
    std::uint64_t max_included_files = ~std::uint64_t{0};
    std::uint64_t max_included_bytes = ~std::uint64_t{0};

    friend bool operator==(const FilePolicy&, const FilePolicy&) = default;
};

/// The default limits of files for grammars that are not trusted.
inline constexpr std::uint64_t kUntrustedIncludedFiles = 1000;
inline constexpr std::uint64_t kUntrustedIncludedBytes = std::uint64_t{64} << 20U;

} // namespace lsys
