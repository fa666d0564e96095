// SPDX-License-Identifier: MIT
// FilePosition: the place in a grammar that wrote a module.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "runtime/derive/origin.h"

#include <cstdint>
#include <optional>
#include <string>

namespace lsys {

/// A place in a grammar or an included file; line and column from 1.
struct FilePosition {
    std::string file;
    std::uint32_t line = 1;
    std::uint32_t column = 1;
};

/// The place that wrote a module with this origin; empty if the bytecode does not know it.
[[nodiscard]] std::optional<FilePosition> position_of(const Origin& origin,
                                                      const Bytecode& bytecode);

} // namespace lsys
