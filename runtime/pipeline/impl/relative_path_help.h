// SPDX-License-Identifier: MIT
// The help of messages about a file that a statement of a grammar names.
#pragma once

#include "grammar/base/paths.h"
#include "runtime/pipeline/grammar.h"

#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <string_view>

namespace lsys {

/// `statement`: "#sense"; `folder`: of the grammar.
[[nodiscard]] inline std::string relative_path_help(std::string_view statement,
                                                    const std::filesystem::path& folder,
                                                    const Grammar& grammar) {
    if (!grammar.is_module_file) {
        return fmt::format("the path is relative to the file that holds the `{}`", statement);
    }
    return fmt::format("the path is relative to the folder of the compiled grammar, `{}`",
                       folder.empty() ? "." : path_text(folder));
}

} // namespace lsys
