// SPDX-License-Identifier: MIT
#include "runtime/repair/fix_scope.h"

#include "grammar/base/paths.h"
#include "runtime/pipeline/grammar.h"

#include <algorithm>
#include <system_error>

namespace lsys::repair {

namespace {

/// The path without symbolic links and `..`; empty if the file does not exist.
std::filesystem::path real_path(const std::filesystem::path& path) {
    std::error_code error;
    std::filesystem::path real = std::filesystem::canonical(path, error);
    return error ? std::filesystem::path() : real;
}

} // namespace

FixScope::FixScope(const std::string& path, std::span<const std::string> named)
    : root_(shown_path(path)) {
    const std::filesystem::path folder = path_of(path).parent_path();
    folder_ = real_path(folder.empty() ? std::filesystem::path(".") : folder);
    for (const std::string& each : named) {
        named_.insert(real_path(path_of(each)));
    }
}

bool FixScope::contains(const std::string& path) const {
    if (path == root_) {
        return true;
    }
    const std::filesystem::path real = real_path(path_of(path));
    if (real.empty() || folder_.empty()) {
        return false;
    }
    const auto [inner, rest] =
        std::mismatch(folder_.begin(), folder_.end(), real.begin(), real.end());
    return inner == folder_.end() || named_.contains(real);
}

} // namespace lsys::repair
