// SPDX-License-Identifier: MIT
#include "runtime/pipeline/file_position.h"

namespace lsys {

std::optional<FilePosition> position_of(const Origin& origin, const Bytecode& bytecode) {
    const std::optional<Site> site =
        origin.place == kNone ? std::nullopt : place_of(bytecode, origin.place);
    if (!site) {
        return std::nullopt;
    }
    return FilePosition{bytecode.files[static_cast<std::size_t>(site->span.file)], site->line,
                        site->column};
}

} // namespace lsys
