// The files that are being parsed, from the root to the innermost #include, and those that were
// read before: decides whether one more may be entered.
#pragma once

#include "grammar/ast/parse_context.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace lsys {

inline constexpr std::uint32_t kMaxIncludeDepth = 32;
/// Files may include others twice; 32 levels of that are four thousand million files.
inline constexpr std::uint32_t kMaxInclusions = 65'536;

/// `path` without `.` and `..` where that needs no file system.
[[nodiscard]] std::string normalised_path(std::string_view path);
/// `path` as seen from the folder of `including`.
[[nodiscard]] std::string path_beside(std::string_view including, std::string_view path);

class IncludeChain {
public:
    IncludeChain(const ParseContext& context, FileId root);

    /// Loads the file that `path_span` names and makes it the innermost; reports why not and
    /// returns kNoFile where it cannot.
    [[nodiscard]] FileId enter(std::string_view path, SourceSpan path_span);
    void leave();

private:
    struct Link {
        std::string path; // normalised
        SourceSpan included_at;
    };
    const ParseContext& context_;
    std::vector<Link> chain_;
    std::unordered_map<std::string, FileId> read_;
    std::uint32_t inclusions_ = 0;
};

} // namespace lsys
