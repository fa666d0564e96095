// SPDX-License-Identifier: MIT
// Shared helpers of the benchmarks: measurement of time, medians, and compilation of grammars from
// text. A mistake in a grammar ends the program.
#pragma once

#include "compiler/bytecode/bytecode.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace lsys::bench {

/// Wall time in s that `work` takes.
[[nodiscard]] double seconds(const std::function<void()>& work);
/// Precondition: `values` is not empty.
[[nodiscard]] double median(std::vector<double> values);
[[noreturn]] void fail(const std::string& what);
/// Hash of the bits of all numbers.
[[nodiscard]] std::uint64_t hash(const std::vector<float>& numbers);
[[nodiscard]] Bytecode compile_text(const std::string& text);

} // namespace lsys::bench
