// SPDX-License-Identifier: MIT
// IncludeChain: the files from the root to the innermost #include, and all files read so far.
// Decides whether one more file may be included.
#pragma once

#include "grammar/ast/parse_context.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace lsys {

inline constexpr std::uint32_t kMaxIncludeDepth = 32;
/// Maximum number of inclusions. Files that include others twice double the number at each level.
inline constexpr std::uint32_t kMaxInclusions = 65'536;

/// `path` without `.` and `..`, as far as possible without the file system.
[[nodiscard]] std::string normalised_path(std::string_view path);
/// `path` relative to the folder of `including`.
[[nodiscard]] std::string path_beside(std::string_view including, std::string_view path);

class IncludeChain {
public:
    IncludeChain(const ParseContext& context, FileId root);

    /// Loads the file that the #include at `path_span` names and makes it the innermost; reports a
    /// failure and returns kNoFile.
    [[nodiscard]] FileId enter(std::string_view path, SourceSpan path_span);
    /// Leaves the innermost file.
    void leave();

private:
    struct Link {
        std::string path;       // normalised
        SourceSpan included_at; // place of the path in the #include
    };
    const ParseContext& context_;
    std::vector<Link> chain_;                      // files from the root to the innermost
    std::unordered_map<std::string, FileId> read_; // files read so far, by normalised path
    std::uint32_t inclusions_ = 0;                 // number of inclusions so far
};

} // namespace lsys
