// SPDX-License-Identifier: MIT
// Facts about a grammar that need no derivation: lengths of words, and the ages from which
// productions can apply. Found in bounded time for every grammar.
#pragma once

#include "compiler/program/program.h"
#include "runtime/pipeline/grammar.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lsys {

/// The number of modules of the last generation: `generation 6: 4,181 modules`, or of the last one
/// that could be predicted. Empty if nothing is known, for example because of errors.
[[nodiscard]] std::string predicted_length(const CompiledText& compiled);

/// Per production: the first age of a word at which it can apply, if all conditions hold. Nullopt
/// if one of its modules is never written, and for the productions of #interpret.
[[nodiscard]] std::vector<std::optional<std::uint32_t>> first_ages(const Program& program);

} // namespace lsys
