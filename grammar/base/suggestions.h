// SPDX-License-Identifier: MIT
// Suggestions: the nearest known names of many unknown ones.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

/// Suggests the nearest known name for an unknown one. A work limit bounds the time for files with
/// a million mistakes: about 0.2 s.
class Suggestions {
public:
    /// The nearest candidate that is similar enough, or an empty string.
    [[nodiscard]] std::string nearest(std::string_view wanted,
                                      const std::vector<std::string_view>& candidates);
    /// Whether the work limit allows comparing with `count` more candidates.
    [[nodiscard]] bool may_compare(std::size_t count) const { return count <= work_left_; }
    /// Counts `count` comparisons that the caller makes itself; false if they exceed the limit.
    [[nodiscard]] bool claim(std::size_t count) {
        const bool allowed = may_compare(count);
        work_left_ -= allowed ? count : 0;
        return allowed;
    }

private:
    std::size_t work_left_ = 4'000'000; // candidates that may still be compared
};

} // namespace lsys
