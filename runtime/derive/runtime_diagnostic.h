// SPDX-License-Identifier: MIT
// Messages to the grammar's author about errors and limits of a derivation. They are made from a
// RuntimeError or LimitReport and the bytecode alone, so a source file and its .lsb file give the
// same messages.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "grammar/base/diagnostic.h"
#include "grammar/base/result.h"
#include "runtime/base/limits.h"
#include "runtime/base/size_text.h"
#include "runtime/derive/derive.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace lsys {

/// The message of a run-time error. Spans refer to Bytecode::files, which are the files of the
/// SourceMap if the bytecode was just compiled. Without sources a note names the place instead.
[[nodiscard]] Diagnostic
runtime_diagnostic(const RuntimeError& error, const Bytecode& bytecode, bool sources_loaded);

/// The message of a derivation that ended with Stop::Limit or Stop::OutOfMemory, with the largest
/// number of generations that fits, if known.
[[nodiscard]] Diagnostic limit_diagnostic(const LimitReport& report,
                                          const Limits& limits,
                                          const Bytecode& bytecode,
                                          bool sources_loaded);

} // namespace lsys
