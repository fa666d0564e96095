// What went wrong while a word was derived, as messages to the grammar's author. Made from facts
// and bytecode alone, so that they are the same for a source file and for a .lsb file.
#pragma once

#include "compiler/bytecode.h"
#include "grammar/diagnostic.h"
#include "grammar/result.h"
#include "runtime/derive.h"
#include "runtime/limits.h"

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

/// `subject`, such as "its mesh", needs more memory than the `left` bytes that may still be used
/// for what is read from files; of ErrorKind::Limit.
[[nodiscard]] Error memory_error(std::string_view subject, std::uint64_t left);

/// 1,234,567
[[nodiscard]] std::string grouped_digits(std::uint64_t value);
/// 640 B, 1.5 KiB, 3.2 GiB
[[nodiscard]] std::string byte_size_text(std::uint64_t bytes);

} // namespace lsys
