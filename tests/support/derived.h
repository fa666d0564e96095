// SPDX-License-Identifier: MIT
// Derived words as text, by all methods of the runtime: any number of threads, any size of chunks,
// stored or streamed, with or without folding of reachable modules. All words must be equal.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "runtime/derive/derive.h"

#include <cstdint>
#include <string>

namespace lsys::test {

/// The text of a word; checks that the number of parameters fits the codes.
[[nodiscard]] std::string text_of(const Bytecode& bytecode, const Word& word);

/// Derives with one thread and default chunks. Requires success.
[[nodiscard]] std::string
derived(const Bytecode& bytecode, std::uint32_t generations, std::uint64_t seed);

/// Derives; checks that threads, chunks and streaming give the same word, with and without origins,
/// and the same origins.
[[nodiscard]] std::string
derived_every_way(const Bytecode& bytecode, std::uint32_t generations, std::uint64_t seed);

/// The error of a derivation that must fail; checks that threads and chunks do not change it.
[[nodiscard]] RuntimeError
error_every_way(const Bytecode& bytecode, std::uint32_t generations, std::uint64_t seed);

} // namespace lsys::test
