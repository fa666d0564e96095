// SPDX-License-Identifier: MIT
// Writes values that a user has set, in a window or on a command line, into the text of a .lsys
// grammar. All other bytes stay unchanged.
#pragma once

#include "compiler/program/compile_options.h"
#include "grammar/ast/parse_context.h"
#include "grammar/base/result.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lsys {

/// New values of statements of a grammar.
struct StatementValues {
    std::optional<std::uint32_t> generations; // #n
    std::vector<Definition> definitions;      // #define and #param, which exist
    std::vector<SettingText> settings;        // #set

    [[nodiscard]] bool empty() const {
        return !generations && definitions.empty() && settings.empty();
    }
};

/// The `bytes` of the .lsys grammar `path` with `values` in place of the values of its statements.
/// Adds a line for a setting without a statement: after the last `#set` and the constants that its
/// values use, or before the first statement if there are none. Adds a line for generations without
/// `#n` before the first statement. Line ends and a byte order mark stay unchanged. `load` reads
/// included files, which never change. Errors: a syntax error; a constant that does not exist or is
/// defined after its use; a statement that stands in an included file.
[[nodiscard]] Result<std::string> with_values(const std::string& path,
                                              const std::string& bytes,
                                              const StatementValues& values,
                                              const FileLoader& load);

} // namespace lsys
