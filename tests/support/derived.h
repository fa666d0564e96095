// Derived words as text, by every way the runtime has: any number of threads, any size of chunks,
// stored or streamed, modules that can be reached folded or not. All must agree.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "runtime/derive/derive.h"

#include <cstdint>
#include <string>

namespace lsys::test {

/// The text of a word, after a check that its parameters are as many as its codes store.
[[nodiscard]] std::string text_of(const Bytecode& bytecode, const Word& word);

/// Derives `generations` generations with one thread and the usual chunks. Requires success.
[[nodiscard]] std::string
derived(const Bytecode& bytecode, std::uint32_t generations, std::uint64_t seed);

/// The same, and checks that all other ways give the same word, and with origins the same origins.
[[nodiscard]] std::string
derived_every_way(const Bytecode& bytecode, std::uint32_t generations, std::uint64_t seed);

/// The error of a derivation that must fail; checks that threads and chunks do not change it.
[[nodiscard]] RuntimeError
error_every_way(const Bytecode& bytecode, std::uint32_t generations, std::uint64_t seed);

} // namespace lsys::test
