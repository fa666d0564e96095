// SPDX-License-Identifier: MIT
// Program to Bytecode: symbols and constant modules become codes, words become templates,
// expressions become instructions. The tables have the order that bytecode.h describes.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "compiler/program/program.h"
#include "grammar/base/names.h"
#include "grammar/base/source.h"

#include <optional>

namespace lsys {

/// Returns nothing if the number of a formal, draw, slot or global, or the length of a skip,
/// exceeds kMaxOperand. Precondition: program.is_valid.
[[nodiscard]] std::optional<Bytecode>
lower(const Program& program, const Names& names, const SourceMap& sources);

} // namespace lsys
