// SPDX-License-Identifier: MIT
#include "viewer/app/output_path.h"

#include "grammar/base/paths.h"
#include "runtime/platform/file.h"

#include <fmt/format.h>

namespace lsys::view {

std::string problem_of_output(const std::string& path) {
    const std::string before(folder_of_path(path));
    const std::string folder = before.empty() ? "." : before;
    const platform::FileType type = platform::facts_of(folder).type;
    if (type == platform::FileType::Missing) {
        return fmt::format("there is no folder `{}`", folder);
    }
    if (type != platform::FileType::Directory) {
        return fmt::format("`{}` is not a folder", folder);
    }
    if (name_of_path(path).empty()) {
        return "the file has no name";
    }
    if (platform::facts_of(path).type == platform::FileType::Directory) {
        return fmt::format("`{}` is a folder", path);
    }
    if (platform::check_writable(folder) != 0) {
        return fmt::format("no file can be written in the folder `{}`", folder);
    }
    return {};
}

} // namespace lsys::view
