// What went wrong while a word was derived, as messages to the grammar's author. Made from facts
// and bytecode alone, so that they are the same for a source file and for a .lsb file.
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

/// Spans refer to Bytecode::files, which are the files of the SourceMap when the bytecode was just
/// compiled. Where there is no source (`sources_loaded` false), a note names the place instead.
[[nodiscard]] Diagnostic
runtime_diagnostic(const RuntimeError& error, const Bytecode& bytecode, bool sources_loaded);

/// What a derivation that ended as Limit or OutOfMemory tells, with the largest number of
/// generations that fits, as far as it is known.
[[nodiscard]] Diagnostic limit_diagnostic(const LimitReport& report,
                                          const Limits& limits,
                                          const Bytecode& bytecode,
                                          bool sources_loaded);

} // namespace lsys
