// SPDX-License-Identifier: MIT
// Derives words as text by all methods of the runtime: with any number of threads and any size of
// chunks, stored or streamed, with and without folding of reachable modules. All words must be
// equal.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "runtime/derive/derive.h"

#include <cstdint>
#include <string>

namespace lsys::test {

/// The text of a word. Checks that the number of parameters fits the codes.
[[nodiscard]] std::string text_of(const Bytecode& bytecode, const Word& word);

/// The word after `generations`, derived with one thread and chunks of default size. Fails the test
/// if there is no word.
[[nodiscard]] std::string
derived(const Bytecode& bytecode, std::uint32_t generations, std::uint64_t seed);

/// The word after `generations`. Checks that all numbers of threads, sizes of chunks, and streaming
/// give the same word, with and without origins, and the same origins.
[[nodiscard]] std::string
derived_every_way(const Bytecode& bytecode, std::uint32_t generations, std::uint64_t seed);

/// The error of a derivation that must fail. Checks that the error does not depend on threads and
/// chunks.
[[nodiscard]] RuntimeError
error_every_way(const Bytecode& bytecode, std::uint32_t generations, std::uint64_t seed);

} // namespace lsys::test
