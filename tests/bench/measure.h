// What the benchmarks share: time, medians, and grammars compiled from text. A mistake ends the
// program.
#pragma once

#include "compiler/bytecode/bytecode.h"

#include <functional>
#include <string>
#include <vector>

namespace lsys::bench {

/// How long `work` takes.
[[nodiscard]] double seconds(const std::function<void()>& work);
/// Precondition: there are values.
[[nodiscard]] double median(std::vector<double> values);
[[noreturn]] void fail(const std::string& what);
[[nodiscard]] Bytecode compile_text(const std::string& text);

} // namespace lsys::bench
