// SPDX-License-Identifier: MIT
// State files: derivations saved before their end (`--save-state`, `--from`). A file has the digest
// of the program, seed, number of generations, age, word, and the data that the environments of
// sense modules keep, with magic, versions and a checksum; state_file.cpp shows the layout.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "grammar/base/result.h"
#include "runtime/derive/word.h"

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace lsys {

// Version history.
//   1  The first format. Its digest left out the source of random numbers.
//   2  Adds the version of the bytecode (kModuleFileVersion), on which the digest depends.
//   3  Adds the state of the environments, WordSense::state().
inline constexpr std::uint32_t kStateFileVersion = 3;

struct StateHeader {
    std::uint64_t program_digest = 0; // digest() of the bytecode
    std::uint64_t seed = 0;
    std::uint32_t generations = 0; // generations of the whole derivation
    std::uint32_t age = 0;
};

struct SavedState {
    StateHeader header;
    Word word;
    std::string sense_state; // Derivation::sense_state(), for Derivation::resume()
};

/// Passes the bytes of a state file to `flush`, in order and in few pieces, without copying the
/// word. Returns false as soon as flush does.
[[nodiscard]] bool write_state(const StateHeader& header,
                               const Word& word,
                               std::string_view sense_state,
                               const std::function<bool(std::string_view)>& flush);
/// Reads a state file. Errors: not a state file; another version; truncated or damaged bytes; a
/// state of another program; a word that the program cannot have. The message does not name the
/// file.
[[nodiscard]] Result<SavedState> read_state(std::string_view bytes, const Bytecode& bytecode);
/// Whether these bytes begin like a state file.
[[nodiscard]] bool is_state_file(std::string_view bytes);

} // namespace lsys
